"""Does compiling `forage` take more processor time than recorded, as a ratio to a reference that is compiled in between?

    compile_time.py launch COMPILER ARGUMENTS...      compiles, and notes the processor time in compile_times.log
    compile_time.py check BUILD COMPILER [--record]   compares the program with the record

With CMAKE_CXX_COMPILER_LAUNCHER="python3;compile_time.py;launch" in the environment of cmake, a build notes its times, and those of
compile_reference.cpp beside every tenth file, so that other work on the machine slows both. More than 10 % above compile_time.json
is a failure; more than 10 % below needs a new record, which --record writes. Without notes of all files, or with another compiler
than the recorded one, the check is skipped.
"""
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
RECORD = HERE / "compile_time.json"
LOG = "compile_times.log"
TOLERANCE = 0.1
SKIPPED = 77


def processor_seconds(command):
    """The exit status of a command and its processor time."""
    child = subprocess.Popen(command)
    _, status, usage = os.wait4(child.pid, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime


def launch(command):
    status, seconds = processor_seconds(command)
    if status or "-c" not in command:
        return status
    log = pathlib.Path(LOG)
    lines = [f"{seconds:.2f} {command[command.index('-o') + 1]}\n"]
    if not log.exists() or log.read_text().count("\n") % 11 == 0:
        _, seconds = processor_seconds(
            [command[0], "-std=c++20", "-O1", "-isystem", "/usr/include/eigen3", "-c", HERE / "compile_reference.cpp", "-o", "/dev/null"]
        )
        lines.append(f"{seconds:.2f} reference\n")
    with log.open("a") as file:
        file.writelines(lines)
    return 0


def check(build, compiler, recording):
    commands = subprocess.run(["ninja", "-C", build, "-t", "commands", "bin/forage"], check=True, stdout=subprocess.PIPE, text=True).stdout
    objects = set(re.findall(r" -o (\S+\.o) -c ", commands))
    log = build / LOG
    times, references = {}, []
    for line in log.read_text().splitlines() if log.exists() else ():
        seconds, name = line.split(" ", 1)
        if name == "reference":
            references.append(float(seconds))
        else:
            times[name] = float(seconds)
    if not objects <= times.keys() or not references:
        print("SKIPPED: the build has not noted the processor time of every file")
        return SKIPPED
    record = json.loads(RECORD.read_text())
    ratio = sum(times[name] for name in objects) / statistics.median(references)
    change = ratio / record["ratio"] - 1
    for name in sorted(objects, key=times.get)[:-11:-1]:
        print(f"{times[name]:7.1f} s  {name}")
    print(
        f"{sum(times[name] for name in objects):7.1f} s of processor time in all, {ratio:.1f} times that of the reference, {100 * change:+.1f} % against the record"
    )
    if recording:
        RECORD.write_text(json.dumps({"compiler": compiler, "ratio": round(ratio, 1)}, indent=1) + "\n")
    elif record["compiler"] != compiler:
        print(f"SKIPPED: the record is of {record['compiler']}, this is {compiler}")
        return SKIPPED
    elif change > TOLERANCE:
        print("slower: include less, or say in the commit that records it what it buys")
        return 1
    elif change < -TOLERANCE:
        print("faster than recorded: write the new record with --record, so that it stays")
    return 0


if __name__ == "__main__":
    if sys.argv[1] == "launch":
        sys.exit(launch(sys.argv[2:]))
    sys.exit(check(pathlib.Path(sys.argv[2]), sys.argv[3], "--record" in sys.argv))
