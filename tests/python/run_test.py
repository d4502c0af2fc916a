"""Running: the same numbers as the command line."""
import forage
from conftest import SYSTEMS, WORLD


def state_after(printed):
    return next(line.split()[1] for line in printed.splitlines() if line.split()[:1] == ["state"])


def test_the_state_is_that_of_the_command_line(dac, command):
    dac.run(cycles=500)
    dac.step()
    printed = command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 501, "--hash", "-o", "")
    assert dac.digest() == state_after(printed)
    assert dac.cycle == 501


def test_a_view_shows_what_the_run_computes(dac):
    light = dac["Bug/Light"].act
    assert light.shape == (1, 32) and not light.flags.owndata and not light.flags.writeable
    before = light.copy()
    dac.run(cycles=200)
    assert (light != before).any()
    assert dac["Bug/Light"].act is light
