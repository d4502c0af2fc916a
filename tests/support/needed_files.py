"""Prints the files of a build tree that tests need: needed_files.py BUILD_DIRECTORY [ARGUMENTS_OF_CTEST...]

They are the files in the commands of the tests, and those in their property REQUIRED_FILES, that the build makes.
"""
import json
import pathlib
import subprocess
import sys

build = pathlib.Path(sys.argv[1]).resolve()


def output(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


made = {line.rsplit(": ", 1)[0] for line in output("ninja", "-C", build, "-t", "targets", "all").splitlines()}
needed = set()
for test in json.loads(output("ctest", "--test-dir", build, "--show-only=json-v1", *sys.argv[2:]))["tests"]:
    words = list(test.get("command", []))
    for entry in test.get("properties", []):
        if entry["name"] == "REQUIRED_FILES":
            words += entry["value"]
    for word in words:
        if word.startswith(f"{build}/") and word[len(f"{build}/") :] in made:
            needed.add(word[len(f"{build}/") :])
print("\n".join(sorted(needed)))
