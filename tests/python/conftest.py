import os
import pathlib
import subprocess

import pytest
from hypothesis import HealthCheck, settings

import forage

PROJECT = pathlib.Path(__file__).parents[2]
SYSTEMS = PROJECT / "systems"
SMALL = SYSTEMS / "cookbook/oscillator.iqr"  # without a world
REACTIVE = SYSTEMS / "reactive_foraging.iqr"
WORLD = SYSTEMS / "worlds/basic_arena.world"

# The same examples in each run, so that a failure is that of a change. The health checks are about how fast examples are made:
# they fail by chance with few examples, and on a busy machine.
settings.register_profile("forage", deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
settings.load_profile("forage")


def outside():
    """The environment of the command line, which has a sanitizer of its own, if any."""
    return {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}


def open_dac(**options):
    """The DAC system in its arena."""
    return forage.open(SYSTEMS / "dac_foraging.iqr", world=WORLD, **options)


@pytest.fixture
def dac():
    with open_dac() as run:
        yield run


@pytest.fixture
def command(tmp_path):
    """Runs the command line, and returns what it prints."""

    def call(*arguments):
        done = subprocess.run([os.environ["FORAGE"], *map(str, arguments)], cwd=tmp_path, env=outside(), capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call


@pytest.fixture
def run():
    """A run of the reactive system in its arena."""
    with forage.open(REACTIVE, world=WORLD) as out:
        yield out
