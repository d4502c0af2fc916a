"""The package as it is installed: by CMake, and as the package python3-forage has it."""
import json
import os
import pathlib
import subprocess
import sys

import pytest

import forage

BUILD = pathlib.Path(os.environ["FORAGE"]).parents[1]


def python(code, path, folder=None):
    """What a program prints that finds the package in `path`."""
    environment = {**os.environ, "PYTHONPATH": str(path)}
    return subprocess.run([sys.executable, "-B", "-c", code], env=environment, capture_output=True, text=True, check=True, cwd=folder).stdout


@pytest.mark.parametrize("prefix", ["/usr", "/usr/local"])
def test_the_installed_package_is_where_the_interpreter_looks(tmp_path, prefix):
    if not (BUILD / "package/changelog.Debian.gz").exists():
        pytest.skip("the target package_files is not built")
    environment = {**os.environ, "DESTDIR": str(tmp_path)}
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", prefix], env=environment, check=True, capture_output=True)
    package = next(tmp_path.glob("**/forage/__init__.py")).parent
    assert not any(file.is_symlink() for file in package.iterdir())
    assert {"py.typed", "_forage.pyi"} <= {file.name for file in package.iterdir()}
    if sys.executable == "/usr/bin/python3":
        assert "/" + str(package.parent.relative_to(tmp_path)) in json.loads(python("import json, sys; print(json.dumps(sys.path))", ""))
    assert python("import forage; print(forage.__file__, forage.__version__)", package.parent).split() == [str(package / "__init__.py"), forage.__version__]


def test_a_world_in_any_folder_has_the_models_that_ship(tmp_path):
    (tmp_path / "own.world").write_text((forage.SYSTEMS / "worlds/basic_arena.world").read_text())
    code = "import forage; run = forage.open(forage.SYSTEMS / 'reactive_foraging.iqr', world='own.world'); run.run(trials=1); print(len(run.trials))"
    assert python(code, BUILD / "python", tmp_path) == "1\n"


def test_the_demo_says_what_the_robot_did_and_draws_it(tmp_path):
    said = python("import forage.demo; forage.demo.main()", BUILD / "python", tmp_path)
    assert "reached the light in 30 of them" in said and (tmp_path / "forage-out/trajectory.png").stat().st_size > 1000
