"""Runs iqr brain models in a closed loop with a simulated robot.

    import forage

    with forage.open("systems/dac_foraging.iqr", world="systems/worlds/basic_arena.world", seed=1) as run:
        run.run(trials=30)
        print(run["Bug/Light"].act)
"""

from ._errors import Diagnostic, InputError, InputWarning, RunError
from ._forage import Group, Run, __version__, open

__all__ = ["Diagnostic", "Group", "InputError", "InputWarning", "Run", "RunError", "open"]
