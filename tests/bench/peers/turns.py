"""Workers that are measured in turns. A worker is a process that answers lines: a number of seconds with its rate, which it
measures for about as long in its own processor time, and "check" with what is needed to compare it with others."""
import subprocess


class Worker:
    def __init__(self, command):
        self.process = subprocess.Popen([str(c) for c in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

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
