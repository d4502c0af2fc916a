#!/usr/bin/env python3
"""Reads the #include lines of the project and fails on an arrow that points up (docs/design.md).

usage: layering.py ROOT          checks the project at ROOT
       layering.py --self-test   checks the checker
"""
import pathlib
import re
import sys
import tempfile

# Each room, and the other rooms whose headers it may include. Tests may include anything.
ALLOWED = {
    'core/base': set(),
    'core/types': {'core/base'},
    'core/formula': {'core/base'},
    'core/model': {'core/base', 'core/formula', 'core/types'},
    'core/equations': {'core/base', 'core/formula', 'core/model', 'core/types'},
    'core/connectivity': {'core/base', 'core/model'},
    'core/engine': {'core/base', 'core/connectivity', 'core/model', 'core/types'},
    'core/xml': {'core/base', 'core/formula', 'core/model', 'core/types'},
    'core/observe': {'core/base', 'core/engine', 'core/model'},
    'core/run': {'core/base', 'core/types', 'core/formula', 'core/model', 'core/connectivity', 'core/engine', 'core/observe'},
    'core/plugin': {'core/base', 'core/types'},
    # Shipped types use only what a plugin can use, and do not use each other.
    'neurons': {'core/types'},
    'synapses': {'core/types'},
    'modules': {'core/base', 'core/types'},
    'bug_interface': {'core/base', 'core/types', 'core/xml', 'core/run'},
    'modules/devices': {'core/base', 'core/types', 'bug_interface'},
    # Pictures, and what other projects see.
    'tools/plot': {'core/base', 'core/model', 'core/connectivity', 'core/engine', 'core/observe', 'core/run', 'bug_interface'},
    'tools/api/open': {
        'core/base',
        'core/types',
        'core/model',
        'core/equations',
        'core/xml',
        'core/plugin',
        'core/observe',
        'core/run',
        'neurons',
        'synapses',
        'modules',
        'bug_interface',
        'modules/devices',
        'tools/plot',
    },
    'tools/api/describe': {
        'core/base',
        'core/types',
        'core/equations',
        'core/connectivity',
        'core/model',
        'core/engine',
        'core/xml',
        'core/run',
        'bug_interface',
        'tools/plot',
    },
    'tools/api/edit': {'core/base', 'core/types', 'core/model', 'core/equations', 'core/xml', 'core/run', 'bug_interface', 'tools/api/open'},
    'tools/api/experiment': {'core/base', 'core/xml', 'core/observe', 'core/run', 'tools/plot', 'tools/api/open'},
    'tools/api/agents': {'core/base', 'core/model', 'core/engine', 'core/observe', 'core/run', 'bug_interface', 'tools/plot', 'tools/api/open'},
    'tools/api': {
        'core/base',
        'core/types',
        'core/model',
        'core/equations',
        'core/xml',
        'core/plugin',
        'core/run',
        'tools/plot',
        'tools/api/open',
        'tools/api/describe',
        'tools/api/experiment',
    },
    'tools/cluster': {'core/base', 'core/run', 'tools/api/experiment'},
}
ALLOWED['tools'] = {
    'core/base',
    'core/model',
    'core/engine',
    'core/xml',
    'core/observe',
    'core/run',
    'bug_interface',
    'tools/plot',
    'tools/cluster',
    'tools/api/open',
    'tools/api/describe',
    'tools/api/edit',
    'tools/api/experiment',
}
ALLOWED['tools/python'] = {'core/base', 'core/observe', 'core/run', 'tools/api/open', 'tools/api/experiment', 'tools/api/agents'}
ALLOWED['tools/studio/server'] = {
    'core/base',
    'core/types',
    'core/model',
    'core/xml',
    'core/observe',
    'core/run',
    'modules/devices',
    'bug_interface',
    'tools/plot',
    'tools/api/open',
    'tools/api/describe',
    'tools/api/edit',
    'tools/api/experiment',
}
ALLOWED['tools/studio/wasm'] = {'core/run', 'tools/studio/server'}
ALLOWED['tools'].add('tools/studio/server')
ROOMS = set(ALLOWED)

# Libraries that belong to one room: the beginnings of their headers' names, and the rooms that may include them.
OWNED = [
    (r'tinyxml2\.h', {'core/xml'}),
    (r'Random123/', {'core/base'}),
    (r'(hdf5|H5\w*)(_hl)?\.h|zip\.h', {'core/observe'}),
    (r'(sha2\.h|fast_float/)', {'core/base'}),
    (r'cairo', {'tools/plot'}),
    (r'boost/', {'tools/studio/server'}),
    (r'emscripten', {'tools/studio/wasm'}),
    (r'(bullet/|bt[A-Z]\w*\.h|Bullet\w*/|LinearMath/|opencv2?/|png\.h)', {'bug_interface'}),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room that a path from the root lies in, or None."""
    return max((room for room in ROOMS if path == room or path.startswith(room + '/')), key=len, default=None)


def check_include(path, bracket, header):
    """The reason why `path` must not include `header`, or None. Both are paths from the root."""
    here = room_of(path)
    for pattern, owners in OWNED:
        if re.match(pattern, header) and here not in owners:
            return f'only {", ".join(sorted(owners))} may include <{header}>'
    there = room_of(header)
    if there is None:
        if bracket == '"':
            return f'"{header}" is in no room: ours are included by their path from the root'
        return None
    if there != here and there not in ALLOWED[here]:
        return f'{here} may not include {there}'
    return None


def check(root, used=None):
    """All faults of the project at `root`, as 'file:line: what'. Adds to `used` the permissions that its files need."""
    faults = []
    for room in sorted(ROOMS):
        for file in sorted((root / room).rglob('*')):
            if file.suffix not in {'.h', '.hpp', '.cpp', '.cc', '.inl'}:
                continue
            path = file.relative_to(root).as_posix()
            for number, line in enumerate(file.read_text(encoding='utf-8').splitlines(), 1):
                match = INCLUDE.match(line)
                fault = match and check_include(path, match[1], match[2])
                if match and used is not None:
                    used.add((room_of(path), room_of(match[2])))
                    used.update((room_of(path), pattern) for pattern, _ in OWNED if re.match(pattern, match[2]))
                if fault:
                    faults.append(f'{path}:{number}: {fault}')
    # A room that this script does not know would not be checked.
    for folder in sorted((root / 'core').iterdir()):
        if folder.is_dir() and f'core/{folder.name}' not in ROOMS:
            faults.append(f'core/{folder.name}: not in the table of rooms in tests/layering/layering.py')
    return faults


def unused(used):
    """Permissions that no file needs. They would later allow a wrong arrow without a message."""
    given = [(room, other) for room, others in ALLOWED.items() for other in others if room != other]
    given += [(room, pattern) for pattern, owners in OWNED for room in owners]
    return [f'tests/layering/layering.py: {room} may include {other}, and no file does' for room, other in sorted(given) if (room, other) not in used]


def self_test():
    bad = [
        ('core/types/a.h', '#include "core/model/system.h"'),
        ('core/model/a.h', '#include "core/connectivity/grid.h"'),
        ('core/connectivity/a.cpp', '#include "core/xml/reader.h"'),
        ('core/engine/a.cpp', '  #  include "core/xml/reader.h"'),
        ('core/xml/a.cpp', '#include "core/engine/plan/plan.h"'),
        ('core/observe/a.cpp', '#include "modules/replay.h"'),
        ('core/observe/a.cpp', '#include "core/plugin/load.h"'),
        ('neurons/a.cpp', '#include "synapses/fixed_weight.h"'),
        ('neurons/a.cpp', '#include "core/model/system.h"'),
        ('modules/x/a.cpp', '#include "bug_interface/world/png.h"'),
        ('bug_interface/a.cpp', '#include "core/engine/plan/plan.h"'),
        ('core/engine/a.cpp', '#include "tools/forage.h"'),
        ('core/model/a.cpp', '#include <tinyxml2.h>'),
        ('core/engine/a.cpp', '#include <Random123/philox.h>'),
        ('tools/a.cpp', '#include <opencv2/core.hpp>'),
        ('tools/a.cpp', '#include <hdf5_hl.h>'),
        ('core/observe/a.cpp', '#include <cairo-svg.h>'),
        ('modules/a.cpp', '#include <bullet/btBulletDynamicsCommon.h>'),
        ('core/observe/a.cpp', '#include <png.h>'),
        ('core/types/a.cpp', '#include "random.h"'),
    ]
    good = [
        ('tools/a.cpp', '#include "core/observe/record.h"'),
        ('core/engine/a.cpp', '#include "core/connectivity/connect.h"'),
        ('core/xml/a.cpp', '#include <tinyxml2.h>'),
        ('core/base/a.cpp', '#include <Random123/philox.h>'),
        ('bug_interface/a.cpp', '#include <sdf/sdf.hh>'),
        ('bug_interface/b/a.cpp', '#include "core/base/diagnostic.h"'),
        ('neurons/a.cpp', '#include "neurons/membrane.h"'),
        ('core/types/a.h', '#include <vector>'),
        ('core/model/a.h', '// #include "core/xml/reader.h"'),
    ]
    for lines, expected in ((bad, 1), (good, 0)):
        for path, line in lines:
            with tempfile.TemporaryDirectory() as folder:
                root = pathlib.Path(folder)
                (root / 'core').mkdir()
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text('#pragma once\n' + line + '\n', encoding='utf-8')
                faults = check(root)
                if len(faults) != expected or (faults and not faults[0].startswith(f'{path}:2: ')):
                    return [f'self-test: {path} with {line}: expected {expected} fault on line 2, got {faults}']
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / 'core' / 'cellar').mkdir(parents=True)
        if len(check(pathlib.Path(folder))) != 1:
            return ['self-test: an unknown room passes']
    everything = {(room, other) for room in ROOMS for other in ROOMS | {pattern for pattern, _ in OWNED}}
    if unused(everything) or len(unused(everything - {('core/xml', 'core/model')})) != 1:
        return ['self-test: a permission that is not needed passes, or one that is needed does not']
    return []


if __name__ == '__main__':
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if sys.argv[1] == '--self-test':
        found = self_test()
    else:
        needed = set()
        found = check(pathlib.Path(sys.argv[1]), needed) + unused(needed)
    for fault in found:
        print(fault)
    sys.exit(1 if found else 0)
