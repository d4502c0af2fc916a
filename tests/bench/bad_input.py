"""The time to refuse each case of tests/diagnostics, as a multiple of the time to check a system without a mistake.

    bad_input.py FORAGE

Both are processor time, and the reference is measured again before each case. The slowest are measured again: the median of five.
"""
import pathlib
import statistics
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "diagnostics"))
import bad_input_test as corpus  # noqa: E402

KINDS = [p.name for p in sorted(corpus.HERE.glob("bad_*")) if p.is_dir()]


def ratio(make):
    reference = corpus.answer(lambda _: corpus.made_input.Case(corpus.SOUND[0])).seconds
    return corpus.answer(make).seconds / reference


cases = {f"{kind}/{name}": make for kind in KINDS for name, make in corpus.cases(kind).items()}
ratios = {name: ratio(make) for name, make in cases.items()}
print(f"{len(ratios)} commands; the median takes {statistics.median(ratios.values()):.2f} times as long as `forage {' '.join(corpus.SOUND[0])}`; the slowest:")
slowest = {name: statistics.median(ratio(cases[name]) for _ in range(5)) for name in sorted(ratios, key=ratios.get)[-10:]}
for name in sorted(slowest, key=slowest.get, reverse=True):
    print(f"{slowest[name]:8.1f}  {name}")
