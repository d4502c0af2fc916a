"""How many instructions does a cycle take? More than the recorded number is a slow-down, found without a clock.

    instructions.py FORAGE COMPILER [--record]

Runs each case of instructions.json twice under valgrind, for some cycles and for more, and counts the instructions of the
additional cycles. More than 5 % above the record is a failure; more than 5 % below needs a new record, which --record writes.
valgrind always simulates a processor with AVX2, so the numbers are the same on any machine. Another compiler than the
recorded one makes other code; then the test is skipped. The systems of the engine alone run with --hash, which demands
everything; otherwise all their groups would be pruned.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parents[1]
RECORD = HERE / "instructions.json"
TOLERANCE = 0.05
SKIPPED = 77


def instructions(forage, arguments, cycles):
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            [
                "valgrind",
                "--tool=cachegrind",
                "--cache-sim=no",
                "--cachegrind-out-file=/dev/null",
                forage,
                "run",
                *arguments,
                "--cycles",
                str(cycles),
                "-o",
                "",
                "--quiet",
            ],
            cwd=ROOT,
            capture_output=True,
            text=True,
            env={**os.environ, "TMPDIR": folder},
        )
    count = re.search(r"I\s+refs:\s+([\d,]+)", run.stderr)
    if run.returncode or not count:
        sys.exit(f"{' '.join(arguments)} failed:\n{run.stderr}")
    return int(count[1].replace(",", ""))


def main():
    forage, compiler = sys.argv[1:3]
    try:
        subprocess.run(["valgrind", "--version"], check=True, capture_output=True)
    except OSError:
        print("SKIPPED: there is no valgrind (Debian: apt-get install valgrind)")
        return SKIPPED
    record = json.loads(RECORD.read_text())
    recording = "--record" in sys.argv
    if record["compiler"] != compiler and not recording:
        print(f"SKIPPED: the record is of {record['compiler']}, this is {compiler}")
        return SKIPPED
    slower = []
    for case in record["cases"]:
        short, long = case["cycles"]
        per_cycle = (instructions(forage, case["run"], long) - instructions(forage, case["run"], short)) / (long - short)
        change = per_cycle / case["instructions"] - 1 if case["instructions"] else 0
        print(f"{case['name']:<40} {per_cycle:12.0f} instructions per cycle, {100 * change:+6.2f} % against the record")
        if change > TOLERANCE:
            slower.append(case["name"])
        elif change < -TOLERANCE:
            print("  faster than recorded: write the new record with --record, so that it stays")
        if recording:
            case["instructions"] = round(per_cycle)
    if recording:
        record["compiler"] = compiler
        RECORD.write_text(json.dumps(record, indent=1) + "\n")
        return 0
    if slower:
        print(f"slower: {', '.join(slower)}. If that has its price in what is gained, say so in the commit that records it.")
    return bool(slower)


if __name__ == "__main__":
    sys.exit(main())
