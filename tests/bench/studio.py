#!/usr/bin/env python3
"""What watching costs: cycles per second with three pages as a ratio to none, and to three pages of another studio, which take the
machine's time, but not that of the engine; and the latency of a slow page.

usage: studio.py FORAGE [ROOT]    prints the ratios, whose cases alternate in one run
"""
import pathlib
import statistics
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / 'support'))
from studio_client import Page, Studio  # noqa: E402

SOURCES = ['world:poses', 'world:rays', 'world:camera']


class Watcher(threading.Thread):
    """A page that takes everything, and acknowledges after `delay` seconds."""

    def __init__(self, studio, groups, delay=0.0):
        super().__init__(daemon=True)
        self.page, self.delay, self.latencies, self.over = Page(studio), delay, [], False
        for source in [*SOURCES, *groups]:
            self.page.do('subscribe', source=source)
        self.page.do('subscribe', source=f'mean({groups[0]})', every=100, **{'class': 'append'})

    def run(self):
        while not self.over:
            self.page.receive(0.2)
            for frame in self.page.frames:
                time.sleep(self.delay)
                self.latencies.append(time.monotonic() - frame.at)
                self.page.acknowledge(frame.seq)
            self.page.frames.clear()
            self.page.messages.clear()
        self.page.close()


def rate(page, seconds=1.0):
    """Cycles per second."""
    first, begun = page.do('history')['now'], time.monotonic()
    time.sleep(seconds)
    return (page.do('history')['now'] - first) / (time.monotonic() - begun)


def main():
    forage = sys.argv[1]
    root = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parents[2])
    files = str(root / 'systems/dac_foraging.iqr'), '--world', str(root / 'systems/worlds/basic_arena.world')
    with Studio(forage, *files) as studio, Studio(forage, *files) as another:
        Page(another).do('run')
        control = Page(studio)
        control.do('pause')
        groups = [g['path'] for p in control.last('system')['processes'] for g in p['groups']][:20]
        control.do('speed', mode='free')
        control.do('run')
        rate(control)
        to_none, to_another = [], []
        cases = [None, another, studio]
        for i in range(18):
            # Which case comes first changes, as the speed of a machine drifts.
            rates = {}
            for case in cases[i % 3:] + cases[:i % 3]:
                watchers = [Watcher(case, groups) for _ in range(3)] if case else []
                for w in watchers:
                    w.start()
                time.sleep(0.3)
                rates[case] = rate(control)
                for w in watchers:
                    w.over = True
                    w.join()
            to_none.append(rates[studio] / rates[None])
            to_another.append(rates[studio] / rates[another])
        for what, values in (('none', to_none), ('three pages of another studio', to_another)):
            low, middle, high = statistics.quantiles(values, n=4)
            print(f'cycles per second with three pages / with {what}: {middle:.3f} (half of {len(values)} rounds from {low:.3f} to {high:.3f})')
        # The age of what a page that needs 80 ms per frame has just drawn, in real time.
        control.do('speed', mode='real')
        slow = Page(studio)
        slow.do('subscribe', source=groups[0])
        per_cycle, ages = control.last('system')['seconds_per_cycle'], []
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
