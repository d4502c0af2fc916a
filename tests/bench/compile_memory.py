"""Does compiling `forage` cost more than recorded? The cost is measured as the memory that the compiler allocates, which does not
depend on the machine or on other work there. Processor time does: even as a ratio to that of a reference it differs by a quarter.

    compile_memory.py launch COMPILER ARGUMENTS...      compiles, and notes memory and processor time in compile_memory.log
    compile_memory.py check BUILD COMPILER [--record]   compares the program with the record

A build notes them with CMAKE_CXX_COMPILER_LAUNCHER="python3;compile_memory.py;launch" in the environment of cmake. More than 5 %
above compile_memory.json is a failure; --record writes a new record. Without notes of all files, or with another compiler than the
recorded one, the check is skipped.
"""
import json
import os
import pathlib
import re
import subprocess
import sys

RECORD = pathlib.Path(__file__).with_suffix(".json")
LOG = "compile_memory.log"
TOLERANCE = 0.05
SKIPPED = 77
UNITS = {"": 1e-6, "k": 1 / 1024, "M": 1, "G": 1024}


def launch(command):
    if "-c" not in command:
        return subprocess.call(command)
    child = subprocess.Popen([*command, "-fmem-report"], stderr=subprocess.PIPE, text=True)
    # GCC's report follows what it says of the file.
    said, _, report = child.stderr.read().partition("\n####")
    sys.stderr.write(said)
    _, status, usage = os.wait4(child.pid, 0)
    taken = re.search(r"^Total +(\d+)([kMG]?) +\d+[kMG]? +\d+[kMG]?$", report, re.M)
    if status == 0 and taken:
        with open(LOG, "a") as log:
            seconds, name = usage.ru_utime + usage.ru_stime, command[command.index("-o") + 1]
            log.write(f"{int(taken[1]) * UNITS[taken[2]]:.1f} MB {seconds:.2f} s {name}\n")
    return os.waitstatus_to_exitcode(status)


def check(build, compiler, recording):
    commands = subprocess.run(["ninja", "-C", build, "-t", "commands", "bin/forage"], check=True, stdout=subprocess.PIPE, text=True).stdout
    objects = set(re.findall(r" -o (\S+\.o) -c ", commands))
    log = build / LOG
    notes = {}
    for line in log.read_text().splitlines() if log.exists() else ():
        memory, _, seconds, _, name = line.split(" ", 4)
        notes[name] = float(memory), float(seconds)
    if not objects <= notes.keys():
        print("SKIPPED: the build has not noted the memory of every file")
        return SKIPPED
    for name in sorted(objects, key=notes.get)[:-11:-1]:
        print("{:7.0f} MB {:5.1f} s  {}".format(*notes[name], name))
    memory = round(sum(notes[name][0] for name in objects))
    print(f"{memory:7} MB {sum(notes[name][1] for name in objects):5.1f} s of processor time in all")
    if recording:
        RECORD.write_text(json.dumps({"compiler": compiler, "megabytes": memory}, indent=1) + "\n")
        return 0
    record = json.loads(RECORD.read_text())
    if record["compiler"] != compiler:
        print(f"SKIPPED: the record is of {record['compiler']}, this is {compiler}")
        return SKIPPED
    print(f"{100 * (memory / record['megabytes'] - 1):+.1f} % against the record")
    if memory > record["megabytes"] * (1 + TOLERANCE):
        print("more work: include less, or say in the commit that records it what it buys")
        return 1
    return 0


if __name__ == "__main__":
    if sys.argv[1] == "launch":
        sys.exit(launch(sys.argv[2:]))
    sys.exit(check(pathlib.Path(sys.argv[2]), sys.argv[3], "--record" in sys.argv))
