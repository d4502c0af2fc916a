"""Runs iqr brain models in a closed loop with a simulated robot.

    import forage

    with forage.open("systems/dac_foraging.iqr", world="systems/worlds/basic_arena.world", seed=1) as run:
        light = run.probe("Bug/Light", every=10)
        run.run(trials=30)
    print(light.to_pandas())
"""

from ._errors import Diagnostic, InputError, InputWarning, RunError
from ._forage import (Arborization, DistanceFunction, Film, Group, Manipulation, Parameters, Pattern, Probe, Run, System, __version__, open,
                      resume)
from ._picture import Picture
from ._recording import Recording

__all__ = ["Arborization", "Diagnostic", "DistanceFunction", "Film", "Group", "InputError", "InputWarning", "Manipulation", "Parameters",
           "Pattern", "Picture", "Probe", "Recording", "Run", "RunError", "System", "Table", "experiment", "open", "resume", "sweep"]

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ._experiment import Table, experiment, sweep


def __getattr__(name):
    """Imports what needs NumPy when it is used, so that the import of the package takes little time."""
    if name not in ("Table", "experiment", "sweep"):
        raise AttributeError(f"module 'forage' has no attribute '{name}'")
    from . import _experiment

    return getattr(_experiment, name)


def __dir__():
    return sorted({*globals(), *__all__})
