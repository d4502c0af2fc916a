"""How tests wait: for what they need, never for a time."""
import pathlib
import re
import signal
import time


def wait_for(condition, process=None):
    """Waits until something is true, while a program runs. Only a program that hangs takes as long as the limit."""
    end = time.monotonic() + 600
    while not condition():
        assert time.monotonic() < end, "it does not become true"
        assert process is None or process.poll() is None, f"the program has ended: {process.returncode}"
        time.sleep(0.002)


def wait_for_cycles(process):
    """Waits until a program has prepared its run: it catches Ctrl-C from then on."""

    def caught():
        return int(re.search(r"SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{process.pid}/status").read_text())[1], 16) >> (signal.SIGINT - 1) & 1

    wait_for(caught, process)
