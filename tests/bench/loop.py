"""Measures the seconds from a changed source file to the result of its unit test, in the build tree of the preset dev.

    loop.py BUILD_DIRECTORY [--every N] [FILE...]

Each file is touched, the programs of its test are built, and the test is run. Without FILEs all sources are measured, or every
Nth of them. Prints the slowest files, the median and the maximum.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The test of a source is that of the longest path in this table that it begins with.
TESTS = {
    "core/base": "unit_base",
    "core/types": "unit_types",
    "core/model": "unit_model",
    "core/connectivity": "unit_connectivity",
    "core/formula": "unit_formula",
    "core/equations": "unit_equations",
    "core/xml": "unit_xml",
    "core/engine": "unit_engine",
    "core/plugin": "plugins",
    "core/observe": "unit_observe",
    "core/run": "unit_run",
    "neurons": "unit_engine",
    "synapses": "unit_engine",
    "modules": "unit_modules",
    "modules/devices": "unit_devices",
    "bug_interface": "unit_bug_motion",
    "bug_interface/sensing": "unit_bug_sensing",
    "bug_interface/world": "unit_bug_sensing",
    "tools/plot": "unit_plot",
    "tools/api": "unit_run",
    "tools/studio": "unit_studio",
    "tools/studio/main.cpp": "cli_studio",
    "tools/forage": "cli_pictures",
    "tools/python": "python_types",
    "tools/cluster": "cluster_slurm",
    "tools/cluster/mpi.cpp": "cluster_mpi",
}


def test_of(source):
    return TESTS[max((place for place in TESTS if source.startswith(place)), key=len)]


def run(*command):
    """What a command prints. Ends the program, with that, when the command fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{done.stdout[-4000:]}\nloop: failed: {' '.join(map(str, command))}")
    return done.stdout


def seconds(build, source):
    """The time of the whole loop."""
    test = f"^{test_of(source)}$"
    os.utime(ROOT / source)
    begun = time.monotonic()
    needed = run(sys.executable, ROOT / "tests/support/needed_files.py", build, "-R", test)
    run("ninja", "-C", build, *needed.split())
    run("ctest", "--test-dir", build, "-R", test, "--output-on-failure")
    return time.monotonic() - begun


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("files", nargs="*")
    options = parser.parse_args()
    build = options.build.resolve()
    listed = run("git", "-C", ROOT, "ls-files", *(f"{place}/*.cpp" for place in ("core", "neurons", "synapses", "modules", "bug_interface", "tools")))
    sources = options.files or listed.split()[:: options.every]
    for source in {test_of(source): source for source in sources}.values():
        seconds(build, source)  # builds what is missing
    found = {}
    for source in sources:
        found[source] = seconds(build, source)
        print(f"{found[source]:6.1f} s  {source} ({test_of(source)})", flush=True)
    slowest = max(found, key=found.get)
    median = statistics.median(found.values())
    print(f"\n{len(found)} files: median {median:.1f} s, maximum {found[slowest]:.1f} s ({slowest})")
    if "FORAGE_BENCH_JSON" in os.environ:
        with open(os.environ["FORAGE_BENCH_JSON"], "a") as file:
            for metric, value in (("median", median), ("maximum", found[slowest])):
                file.write(json.dumps({"subject": "loop", "metric": metric, "value": value, "unit": "s"}) + "\n")


if __name__ == "__main__":
    main()
