#!/usr/bin/env python3
"""Makes a wheel run on other machines: puts the shared libraries that it needs beside the module, and gives it the tag of the glibc that it needs.

usage: wheel.py BUILT.whl TREE FOLDER

BUILT.whl is what pip made of the sources, in the build tree TREE. FOLDER gets the wheel. It is the same byte for byte when SOURCE_DATE_EPOCH is.
auditwheel does this for any wheel, but is not in the distribution.
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Every system has these, as NumPy needs them, too: PEP 600 lets wheels use them.
SYSTEM = re.compile(r"(lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+)|ld-linux[\w-]*)\.so[.\d]*")
CURL = re.compile(r"libcurl\b")
# The glibc of the oldest distributions with a version of libstdc++, as in the policies of auditwheel.
LIBSTDCXX = {"GLIBCXX_3.4.29": (2, 34), "GLIBCXX_3.4.30": (2, 35), "GLIBCXX_3.4.32": (2, 38), "GLIBCXX_3.4.33": (2, 39)}
FONTS = pathlib.Path("/usr/share/fonts/truetype/dejavu")
FONTS_CONF = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd">
<fontconfig>
  <include ignore_missing="yes">/etc/fonts/fonts.conf</include>
  <dir prefix="relative">.</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
</fontconfig>
"""
# Libraries of which all is in headers.
HEADERS = ["libeigen3-dev", "nlohmann-json3-dev", "librandom123-dev", "pybind11-dev"]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def names_needed(file):
    """The libraries that a file is linked with, without those of every system."""
    return [name for name in re.findall(r"NEEDED +(\S+)", output("objdump", "-p", file)) if not SYSTEM.fullmatch(name)]


def needed(file):
    """The same with where the loader finds them."""
    found = dict(re.findall(r"(\S+) => (\S+)", output("ldd", file)))
    return {name: pathlib.Path(found[name]) for name in names_needed(file)}


def stub(users, file):
    """Makes a library in place of curl, with functions that return 0. HDF5 calls them for files in the cloud only, and curl brings 20 more libraries."""
    used = sorted(set(re.findall(r"\*UND\*.*\((\w+)\) +(curl_\w+)", output("objdump", "-T", *users))))
    with tempfile.TemporaryDirectory() as place:
        source, script = pathlib.Path(place, "stub.c"), pathlib.Path(place, "stub.map")
        source.write_text("".join(f"long {name}(void) {{ return 0; }}\n" for _, name in used))
        script.write_text(f"{used[0][0]} {{ global: {' '.join(name + ';' for _, name in used)} local: *; }};\n")
        subprocess.run(
            ["cc", "-shared", "-fPIC", "-nostdlib", "-s", f"-Wl,--version-script={script}", f"-Wl,-soname={file.name}", "-o", file, source], check=True
        )


def bundle(module, folder):
    """Copies all libraries that the module needs to the folder, under names of their own, so no other copy in the process takes their place. Returns
    where they were."""
    libraries, users, todo = {}, {}, [module]
    while todo:
        file = todo.pop()
        users[file] = needed(file)
        for name, path in users[file].items():
            if name not in libraries:
                libraries[name] = path
                todo += [] if CURL.match(name) else [path]
    new = {name: re.sub(r"\.so", f"-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so", name, count=1) for name, path in libraries.items()}
    folder.mkdir()
    for name in filter(CURL.match, libraries):
        stub([file for file in users if name in users[file]], folder / new[name])
    for file in users:
        copy = module if file == module else folder / new[next(name for name, path in libraries.items() if path == file)]
        if copy != module:
            shutil.copyfile(file, copy)
            subprocess.run(["patchelf", "--set-soname", copy.name, copy], check=True)
        replaced = [word for name in sorted(users[file]) for word in ("--replace-needed", name, new[name])]
        if replaced:
            subprocess.run(["patchelf", *replaced, copy], check=True)  # patchelf 0.14 mixes up names and path when it changes both at once
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/../forage.libs" if copy == module else "$ORIGIN", copy], check=True)
    if missing := {name for file in [module, *folder.iterdir()] for name in names_needed(file)} - set(new.values()):
        sys.exit(f"wheel: {', '.join(sorted(missing))} would be taken from the system")
    return [path for path in users if path != module]


def platform(files):
    """The tag of the oldest glibc with all symbols that the files take from it, and from the libstdc++ of its time."""
    versions = {v for file in files for v in re.findall(r"\b(GLIBC_\d[\d.]*|GLIBCXX_[\d.]+)$", output("objdump", "-p", file), re.MULTILINE)}
    own = tuple(map(int, os.confstr("CS_GNU_LIBC_VERSION").split()[1].split(".")))
    glibc = [tuple(map(int, v[6:].split("."))) for v in versions if v.startswith("GLIBC_")]
    newest = max((v for v in versions if v.startswith("GLIBCXX_")), key=lambda v: int(v.split(".")[-1]))
    known = [tag for v, tag in LIBSTDCXX.items() if int(v.split(".")[-1]) >= int(newest.split(".")[-1])]
    oldest = max(max(glibc)[:2], known[0] if known else own)
    print(f"wheel: needs glibc {oldest[0]}.{oldest[1]}, as it uses GLIBC_{'.'.join(map(str, max(glibc)))} and {newest}")
    return f"manylinux_{oldest[0]}_{oldest[1]}_{os.uname().machine}"


def licences(files, folder):
    """Copies what the distribution says about the licences of the packages that the files are from."""
    folder.mkdir(parents=True)
    paths = ["*" + os.path.realpath(file).removeprefix("/usr") for file in files]  # some packages say /lib, others /usr/lib
    packages = {line.split(":")[0] for line in output("dpkg", "-S", *paths).splitlines()}
    for package in sorted({*packages, *HEADERS}):
        text = pathlib.Path("/usr/share/doc", package, "copyright")
        if not text.exists():
            sys.exit(f"wheel: the package {package} has no file {text}")
        shutil.copyfile(text, folder / package)


def archives(tree):
    """The static libraries of the distribution that are in the module."""
    link = output("ninja", "-C", tree, "-t", "commands", "forage_python").splitlines()[-1]
    return [word for word in link.split() if word.startswith("/usr/") and word.endswith(".a")]


def numpy_requirement(tree):
    """NumPy, before version 2 where the module is built with a pybind11 that does not know the layout of that."""
    folder = re.search(r"^FORAGE_PYBIND11_DIR:PATH=(.*)", pathlib.Path(tree, "CMakeCache.txt").read_text(), re.MULTILINE)[1]
    header = pathlib.Path(folder, "pybind11/detail/common.h").read_text()
    major, minor = (int(re.search(rf"define PYBIND11_VERSION_{part} (\d+)", header)[1]) for part in ("MAJOR", "MINOR"))
    return "Requires-Dist: numpy" if (major, minor) >= (2, 12) else "Requires-Dist: numpy<2"


def replace(file, old, new):
    text = file.read_text()
    if old not in text:
        sys.exit(f"wheel: there is no '{old}' in {file.name}")
    file.write_text(text.replace(old, new))


def main(built, tree, folder):
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place)
        shutil.unpack_archive(built, root, "zip")
        package, info = root / "forage", next(root.glob("*.dist-info"))
        (module,) = package.glob("_forage*.so")
        libraries = bundle(module, root / "forage.libs")
        fonts = package / "share/forage/fonts"
        fonts.mkdir()
        (fonts / "fonts.conf").write_text(FONTS_CONF)
        for name in ("DejaVuSans.ttf", "DejaVuSans-Bold.ttf"):
            shutil.copyfile(FONTS / name, fonts / name)
        licences([*libraries, *archives(tree), FONTS / "DejaVuSans.ttf"], info / "licenses/libraries")
        tag = platform([module, *(root / "forage.libs").iterdir()])
        built_for = "linux_" + os.uname().machine
        replace(info / "WHEEL", built_for, tag)
        replace(info / "METADATA", "Requires-Dist: numpy", numpy_requirement(tree))
        output(sys.executable, "-m", "wheel", "pack", root, "-d", folder)
        wheel = pathlib.Path(folder, pathlib.Path(built).name.replace(built_for, tag))
        print(f"wheel: {wheel.name} holds {len(libraries)} libraries and has {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main(*sys.argv[1:])
