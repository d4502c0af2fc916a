"""Collects the results of the benchmarks in one file and reports which targets are met.

    summary.py RESULTS.jsonl OUT.json
"""
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys


def processor():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def commit():
    root = pathlib.Path(__file__).parent
    if not shutil.which("git"):
        return ""
    run = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty"], capture_output=True, text=True)
    return run.stdout.strip() if run.returncode == 0 else ""


def main():
    results = [json.loads(line) for line in open(sys.argv[1])]
    measured = {(r["subject"], r["metric"]): r for r in results}
    print(f"\n{'target':<84} {'measured':>10} {'wanted':>12}")
    targets = json.loads((pathlib.Path(__file__).parent / "targets.json").read_text())
    for target in targets:
        least = "least" in target
        wanted = target["least" if least else "most"]
        found = measured.get((target["subject"], target["metric"]))
        target["measured"] = found and found["value"]
        target["met"] = found and (found["value"] >= wanted if least else found["value"] <= wanted)
        if not found:
            continue
        name = f"{target['subject']}: {target['metric']}"
        verdict = "" if target["met"] else "MISSED"
        if limit := measured.get((target["subject"], target.get("limit"))):
            target["possible"] = limit["value"]
            if not target["met"]:
                verdict += f": two separate runs, side by side, gained {limit['value']:.3g}"
        print(f"{name:<84} {found['value']:10.4g} {'>=' if least else '<='} {wanted:<9g} {verdict}")
    pathlib.Path(sys.argv[2]).write_text(
        json.dumps(
            {"commit": commit(), "processor": processor(), "cores": os.cpu_count(), "load": os.getloadavg()[0], "results": results, "targets": targets},
            indent=1,
        )
        + "\n"
    )
    met = sum(bool(t["met"]) for t in targets)
    missing = sum(t["measured"] is None for t in targets)
    if missing:
        print(f"\n{missing} more targets belong to parts that were not run, or lack the original's data")
    print(f"\n{met} of {len(targets) - missing} targets are met; everything that was measured is in {sys.argv[2]}")


if __name__ == "__main__":
    main()
