"""The Python package `forage` for pip: CMake builds it.

    pip install --no-build-isolation .

The packages that Forage is built with must be there (./tools/setup --tests). CMAKE_ARGS has further options for CMake. `./tools/package wheel`
makes of this a wheel for other machines.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"^project\(Forage VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


class Build(build_ext):
    """Builds with CMake in place of a compiler, in build/pip, where a second installation finds what is built."""

    def build_extension(self, extension):
        tree = PROJECT / "build/pip"
        options = [
            "-DFORAGE_PYTHON=ON",
            "-DFORAGE_TESTS=OFF",
            "-DFORAGE_BENCH=OFF",
            f"-DPython3_EXECUTABLE={sys.executable}",
            "-DCMAKE_MODULE_LINKER_FLAGS=-s",
            *shlex.split(os.environ.get("CMAKE_ARGS", "")),
        ]
        cmake = os.environ.get("CMAKE", "cmake")
        subprocess.run([cmake, "--preset", "release", "-S", PROJECT, "-B", tree, *options], check=True, cwd=PROJECT)
        subprocess.run([cmake, "--build", tree, "--target", "forage_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next((tree / "python/forage").glob(f"_forage*{target.suffix}")), target)
        if not self.inplace:
            systems = target.parent / "share/forage/systems"
            shutil.copytree(PROJECT / "systems", systems, ignore=shutil.ignore_patterns("__pycache__", "forage-out*"), dirs_exist_ok=True)


setup(
    name="forage",
    version=VERSION,
    description="Runs iqr brain models in a closed loop with a simulated robot",
    license="BSD-3-Clause",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["forage"],
    package_dir={"": "tools/python"},
    package_data={"forage": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("forage._forage", [])],
    cmdclass={"build_ext": Build},
)
