import os
import pathlib
import subprocess

import pytest

import forage

PROJECT = pathlib.Path(__file__).parents[2]
SYSTEMS = PROJECT / "systems"
WORLD = SYSTEMS / "worlds/basic_arena.world"


@pytest.fixture
def dac():
    """The DAC system in its arena."""
    with forage.open(SYSTEMS / "dac_foraging.iqr", world=WORLD) as run:
        yield run


@pytest.fixture
def command(tmp_path):
    """Runs the command line, and returns what it prints."""

    def call(*arguments):
        done = subprocess.run([os.environ["FORAGE"], *map(str, arguments)], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call
