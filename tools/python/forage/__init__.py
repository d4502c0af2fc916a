"""Runs iqr brain models in a closed loop with a simulated robot.

    import forage

    with forage.open("systems/dac_foraging.iqr", world="systems/worlds/basic_arena.world", seed=1) as run:
        light = run.probe("Bug/Light", every=10)
        run.run(trials=30)
    print(light.to_pandas())
"""

from . import _forage
from ._errors import Diagnostic, InputError, InputWarning, RunError
from ._forage import Arborization, Connection, DistanceFunction, Film, Group, Manipulation, Parameters, Pattern, Probe, Run, System, edit_file, open, resume
from ._picture import Picture
from ._recording import Recording

__version__ = _forage.__version__

# Imported when they are used, as they need NumPy, so that the import of the package takes little time.
_LATER = {
    "_experiment": "Table experiment sweep",
    "_optimise": "Optimum optimise",
    "_types": "Cells Plugin Ports Synapses TypeInfo build_plugin feedback input module neuron output parameter state synapse types",
}

__all__ = [
    "Arborization",
    "Cells",
    "Connection",
    "Diagnostic",
    "DistanceFunction",
    "Film",
    "Group",
    "InputError",
    "InputWarning",
    "Manipulation",
    "Optimum",
    "Parameters",
    "Pattern",
    "Picture",
    "Plugin",
    "Ports",
    "Probe",
    "Recording",
    "Run",
    "RunError",
    "Synapses",
    "System",
    "Table",
    "TypeInfo",
    "build_plugin",
    "edit_file",
    "experiment",
    "feedback",
    "input",
    "module",
    "neuron",
    "open",
    "optimise",
    "output",
    "parameter",
    "resume",
    "state",
    "sweep",
    "synapse",
    "types",
]

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

    from ._experiment import Table, experiment, sweep
    from ._optimise import Optimum, optimise
    from ._types import Cells, Plugin, Ports, Synapses, TypeInfo, build_plugin, feedback, input, module, neuron, output, parameter, state, synapse, types

    SYSTEMS: Path
    """The folder of the systems and worlds that come with Forage."""


def __getattr__(name):
    """Imports what needs NumPy, or takes time, when it is used."""
    import importlib
    import pathlib

    if name == "SYSTEMS":
        return pathlib.Path(_forage._systems)
    for place, names in _LATER.items():
        if name in names.split():
            return getattr(importlib.import_module("." + place, __name__), name)
    raise AttributeError(f"module 'forage' has no attribute '{name}'")


def __dir__():
    return sorted({*globals(), *__all__})
