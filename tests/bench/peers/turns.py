"""Workers that are measured in turns. A worker is a process that answers lines: a number of seconds with its rate, which it
measures for about as long in its own processor time, and "check" with what is needed to compare it with others."""
import subprocess
import sys
import time


class Worker:
    def __init__(self, command, environment=None):
        self.process = subprocess.Popen([str(c) for c in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        env=environment)

    def ask(self, request):
        """The worker's answer to a line, as numbers."""
        print(request, file=self.process.stdin, flush=True)
        answer = self.process.stdout.readline()
        if not answer:
            raise RuntimeError(f"{' '.join(self.process.args)} ended with status {self.process.wait()}")
        return [float(v) for v in answer.split()]

    def stop(self):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()


def in_turns(workers, turns, seconds):
    """The best rate of each worker in `turns` rounds."""
    rates = {name: [] for name in workers}
    for _ in range(turns):
        for name, worker in workers.items():
            rates[name] += worker.ask(seconds)
    return {name: max(values) for name, values in rates.items()}


def serve(rate, check):
    """Answers the requests of a Worker: with rate(seconds), and with 0 after check(file, ...) for "check file ..."."""
    for line in sys.stdin:
        words = line.split()
        if words[0] == "check":
            check(*words[1:])
        print(rate(float(line)) if words[0] != "check" else 0, flush=True)


class Rate:
    """The rate of run(n), which computes n units, without the time that run(1) takes to begin, if it `begins` slowly."""

    def __init__(self, run, begins=False):
        self.run, self.begins, self.count = run, begins, 100

    def __call__(self, seconds):
        while True:
            begin = self.timed(1) if self.begins else 0
            elapsed = self.timed(self.count) - begin
            if elapsed >= 0.7 * seconds:
                return self.count / elapsed
            self.count = 1 + int(self.count * min(10, seconds / max(elapsed, 1e-3)))

    def timed(self, count):
        begin = time.process_time()
        self.run(count)
        return time.process_time() - begin
