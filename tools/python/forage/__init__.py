"""Runs iqr brain models in a closed loop with a simulated robot.

    import forage

    with forage.open("systems/dac_foraging.iqr", world="systems/worlds/basic_arena.world", seed=1) as run:
        light = run.probe("Bug/Light", every=10)
        run.run(trials=30)
    print(light.to_pandas())
"""

from ._errors import Diagnostic, InputError, InputWarning, RunError
from ._forage import Film, Group, Manipulation, Parameters, Probe, Run, __version__, open, resume
from ._picture import Picture
from ._recording import Recording

__all__ = ["Diagnostic", "Film", "Group", "InputError", "InputWarning", "Manipulation", "Parameters", "Picture", "Probe", "Recording", "Run", "RunError",
           "open", "resume"]
