#!/usr/bin/env python3
"""Fails when a room has no README.md, when a README.md names a file that does not exist, or when a unit test is of no folder.

usage: readmes.py ROOT
"""
import pathlib
import re
import sys

import layering

LONGEST = 36  # lines
NAMED = re.compile(r'`([\w./-]+\.(?:h|cpp|py|pyi|ts|svelte|cmake))`')
LINK = re.compile(r'\]\((?!https?:)([^)#]+)')


def rooms(root):
    """The folders that must have a README.md: the rooms, and those of bug_interface; those of tools/api share one."""
    below = (f'bug_interface/{f.name}' for f in (root / 'bug_interface').iterdir() if f.is_dir())
    return sorted(
        {room for room in layering.ROOMS if room != 'tools' and not room.startswith('tools/api/')}
        | set(below)
        | {'tools', 'tools/forage', 'tools/studio/web', 'tests', 'systems'}
    )


def faults_of(root, room):
    readme = root / room / 'README.md'
    if not readme.exists():
        return [f'{room}: has no README.md']
    faults = []
    lines = readme.read_text(encoding='utf-8').splitlines()
    if room != 'systems' and len(lines) > LONGEST:
        faults.append(f'{room}/README.md: {len(lines)} lines, at most {LONGEST}')
    files = [f.relative_to(root).as_posix() for f in (root / room).rglob('*') if f.is_file()]
    for number, line in enumerate(lines, 1):
        for link in LINK.findall(line):
            if not (readme.parent / link).exists():
                faults.append(f'{room}/README.md:{number}: the link {link} leads nowhere')
        for name in NAMED.findall(line):
            if not ((root / name).exists() or (readme.parent / name).exists() or any(f.endswith('/' + name) for f in files)):
                faults.append(f'{room}/README.md:{number}: there is no file {name}')
    return faults


def check(root):
    faults = [fault for room in rooms(root) for fault in faults_of(root, room)]
    for test in sorted((root / 'tests/unit').rglob('*_test.cpp')):
        folder = test.parent.relative_to(root / 'tests/unit')
        if not (root / folder).is_dir():
            faults.append(f'{test.relative_to(root)}: there is no folder {folder} that it could test')
    return faults


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = check(pathlib.Path(sys.argv[1]))
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)
