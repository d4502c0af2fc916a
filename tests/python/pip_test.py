"""`pip install --no-build-isolation .` from a copy of the sources, into an environment of its own. It builds the library again."""
import shutil
import subprocess
import sys

import pytest

from conftest import PROJECT


def test_pip_installs_a_package_that_runs(tmp_path):
    for needed in ("setuptools", "wheel", "pip", "ensurepip"):
        pytest.importorskip(needed)
    sources = tmp_path / "forage"
    shutil.copytree(PROJECT, sources, ignore=shutil.ignore_patterns(".git", "build", "forage-out*", "__pycache__", "data"))
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv"], check=True)
    python = tmp_path / "venv/bin/python"
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--no-build-isolation", sources], check=True)
    code = "import forage; run = forage.open('systems/cookbook/oscillator.iqr'); run.run(cycles=10); print(forage.__file__, run.cycle)"
    out = subprocess.run([python, "-I", "-c", code], cwd=sources, check=True, capture_output=True, text=True).stdout.split()
    assert out[0].startswith(str(tmp_path / "venv")) and out[1] == "10"
    subprocess.run([python, "-m", "pip", "uninstall", "--quiet", "-y", "forage"], check=True)
