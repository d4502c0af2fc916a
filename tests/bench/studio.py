#!/usr/bin/env python3
"""What watching costs: cycles per second with three pages as a ratio to none, the engine's time for pages, and the latency of a
slow page.

usage: studio.py FORAGE [ROUNDS]    by default 400 rounds, in each of which the same cycles run with pages and without, 12 minutes

The speed of a shared machine changes by a tenth from one second to the next. Many short rounds average that better than few long
ones, and the interval of the ratio says what they show.
The engine's own time for pages is measured where it is spent, by the clock: it varies less, but other work beside it makes it longer.
"""
import contextlib
import pathlib
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / 'support'))
from studio_client import Page, Studio  # noqa: E402

SOURCES = ['world:poses', 'world:rays', 'world:camera']


class Watcher(threading.Thread):
    """A page that takes everything and acknowledges it."""

    def __init__(self, studio, groups):
        super().__init__(daemon=True)
        self.page, self.over = Page(studio), False
        for source in [*SOURCES, *groups]:
            self.page.do('subscribe', source=source)
        self.page.do('subscribe', source=f'mean({groups[0]})', every=100, delivery='append')

    def run(self):
        while not self.over:
            self.page.receive(0.2)
            for frame in self.page.frames:
                self.page.acknowledge(frame.seq)
            self.page.frames.clear()
            self.page.messages.clear()
        self.page.close()


@contextlib.contextmanager
def watched_by(pages, studio, groups):
    """So many pages watch the run."""
    watchers = [Watcher(studio, groups) for _ in range(pages)]
    for w in watchers:
        w.start()
    try:
        yield
    finally:
        for w in watchers:
            w.over = True
        for w in watchers:
            w.join()


def rate(control, start):
    """Cycles per second in a short time after `start`, a cycle of the past."""
    control.do('pause')
    control.do('seek', cycle=start)
    control.do('run')
    time.sleep(0.1)
    first, begun = control.do('history')['now'], time.monotonic()
    time.sleep(0.25)
    return (control.do('history')['now'] - first) / (time.monotonic() - begun)


def share(control, start):
    """The share of the engine's time that all pages take."""
    control.do('pause')
    control.do('seek', cycle=start)
    control.do('run')
    time.sleep(2)
    control.messages.clear()
    time.sleep(10)
    control.do('history')
    return statistics.mean(m['pages_share'] for m in control.messages if m['type'] == 'status')


def interval_of_median(values):
    """Where the median lies with 95 % probability, from the ranks of the binomial distribution."""
    values, half = sorted(values), 0.98 * len(values) ** 0.5
    return values[max(0, round(len(values) / 2 - half))], values[min(len(values) - 1, round(len(values) / 2 + half))]


def main():
    forage = sys.argv[1]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 400
    systems = pathlib.Path(__file__).parents[2] / 'systems'
    with Studio(forage, str(systems / 'dac_foraging.iqr'), '--world', str(systems / 'worlds/basic_arena.world')) as studio:
        control = Page(studio)
        control.do('pause')
        groups = [g['path'] for p in control.last('system')['processes'] for g in p['groups']][:20]
        control.do('speed', mode='free')
        control.do('run')
        time.sleep(3)
        start = control.do('history')['checkpoints'][-2]
        ratios = []
        for i in range(rounds):
            rates = {}
            for pages in ((0, 3), (3, 0))[i % 2]:
                with watched_by(pages, studio, groups):
                    rates[pages] = rate(control, start)
            ratios.append(rates[3] / rates[0])
        low, high = interval_of_median(ratios)
        print(
            f'cycles per second with three pages / with none: {statistics.median(ratios):.3f} '
            f'(95 % interval of the median of {rounds} rounds: {low:.3f} to {high:.3f})'
        )
        shares = []
        for pages in (0, 3):
            with watched_by(pages, studio, groups):
                shares.append(share(control, start))
        print(f"engine's time for three pages: {100 * (shares[1] - shares[0]):.2f} %")
        # The age of what a page that needs 80 ms per frame has just drawn, in real time.
        control.do('speed', mode='real')
        slow = Page(studio)
        slow.do('subscribe', source=groups[0])
        ages = []
        for _ in range(60):
            while not slow.frames:
                slow.receive()
            frame = slow.frames.pop(0)
            time.sleep(0.08)
            ages.append(time.monotonic() - frame.at)
            slow.acknowledge(frame.seq)
        p95 = sorted(ages)[int(0.95 * len(ages))]
        print(f'latency of a page that is slow by 80 ms, from arrival to drawn: p95 {1000 * p95:.0f} ms')


if __name__ == '__main__':
    main()
