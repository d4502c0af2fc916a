"""Types of neurons, synapses and modules that are classes of Python."""
from __future__ import annotations

import hashlib
import io
import math
import os
import re
import tempfile
import types as _python_types
import typing

import numpy
import numpy.typing

from . import _forage
from ._errors import InputError

_format: typing.Any = numpy.lib.format
_Column = numpy.typing.NDArray[numpy.float64]
_Class = typing.TypeVar("_Class", bound=type)
_T = typing.TypeVar("_T")
_Value = typing.Union[bool, int, float, str]
_V = typing.TypeVar("_V", bool, int, float, str)
_Path = typing.Union[str, "os.PathLike[str]"]


# What a class declares


class _Item:
    """One declaration of a class. The decorator reads it."""

    def __init__(self, what: str, initial: typing.Any, **about: typing.Any) -> None:
        self.what = what
        self.default = self.initial = initial
        self.name = ""
        self.label: str = about.pop("label", "")
        self.doc: str = about.pop("doc", "")
        self.about = about

    def __getattr__(self, name: str) -> typing.Any:
        try:
            return self.__dict__["about"][name]
        except KeyError:
            raise AttributeError(name) from None


def parameter(
    default: _V,
    *,
    min: float | None = None,
    max: float | None = None,
    unit: str = "",
    label: str = "",
    doc: str = "",
    path: bool = False,
    at_start: bool = False,
) -> _V:
    """Declares a parameter of a type: a bool, int, float or str, as its default is.

    In methods of the class, `self.NAME` is its present value. Systems set it like parameters of the types of Forage, and `run.params` sets it in a run.

    min, max: the usual range, inclusive. A value outside gives a warning.
    unit: of the value, such as "s"; empty without one.
    label, doc: how people call it, and a sentence about it.
    path: whether it names a file, relative to the file that sets it.
    at_start: whether it is read only when a run starts, so that it cannot be set later.
    """
    if not isinstance(default, (bool, int, float, str)):
        raise TypeError(f"parameter: the default is a bool, int, float or str, not a value of type {type(default).__name__}")
    span = None
    if min is not None or max is not None:
        if isinstance(default, (bool, str)):
            raise TypeError("parameter: a range is for numbers")
        span = (-math.inf if min is None else float(min), math.inf if max is None else float(max))
        if not span[0] <= default <= span[1]:
            raise ValueError(f"parameter: the default {default} is outside the range {span[0]} to {span[1]}")
    return typing.cast(_V, _Item("parameter", default, range=span, unit=unit, label=label, doc=doc, path=path, at_start=at_start))


def state(initial: typing.Any = 0.0, *, output: bool = False, feedback: bool = False, label: str = "", doc: str = "") -> typing.Any:
    """Declares what changes in a run.

    Of a neuron or a synapse: one number per cell or synapse, the column `cells.NAME` in update(); it begins with `initial`. Of a module: an attribute
    `self.NAME`, a number, text, bool or array, which begins with a copy of `initial`. States are saved with a run.

    output: whether connections and modules read this state of a neuron: its activity. Without one, it is `act`, also when that is not declared.
    feedback: whether synapses can read this state of their target.
    """
    return _Item("state", initial, output=output, feedback=feedback, label=label, doc=doc)


def feedback(*, required: bool = True, label: str = "", doc: str = "") -> typing.Any:
    """Declares a state of the target that a synapse type reads: the column `synapses.NAME`. The connection of a system names the state.

    required: whether a connection must name one. Otherwise the column is 0 without it.
    """
    return _Item("feedback", None, required=required, label=label, doc=doc)


def input(*, size: tuple[int, int] | None = None, optional: bool = False, label: str = "", doc: str = "") -> typing.Any:
    """Declares an input of a module type: `ports.NAME`, the activity of a group in this cycle, read-only.

    size: (width, height) that the group must have; any size without it.
    optional: whether a system may leave it out. It has no cells then.
    """
    return _Item("port", None, output=False, size=size, optional=optional, label=label, doc=doc)


def output(*, size: tuple[int, int] | None = None, optional: bool = False, label: str = "", doc: str = "") -> typing.Any:
    """Declares an output of a module type: `ports.NAME`, which a group receives as excitation in the next cycle.

    An output keeps its values in cycles in which update() does not touch it. size and optional are those of input().
    """
    return _Item("port", None, output=True, size=size, optional=optional, label=label, doc=doc)


# What update() gets


class _Columns:
    """Columns as attributes: arrays that are changed in place, or by assignment."""

    def __init__(self, columns: dict[str, _Column], size: int) -> None:
        self.__dict__.update(columns)
        self.__dict__["size"] = size

    size: int

    def _names(self, writable: bool) -> str:
        return ", ".join(n for n, c in self.__dict__.items() if isinstance(c, numpy.ndarray) and (c.flags.writeable or not writable))

    def __getattr__(self, name: str) -> _Column:
        raise AttributeError(f"there is no column '{name}'; there is {self._names(False)}")

    def __setattr__(self, name: str, value: numpy.typing.ArrayLike) -> None:
        column = self.__dict__.get(name)
        if not isinstance(column, numpy.ndarray):
            raise AttributeError(
                f"there is no state '{name}' to write; there is {self._names(True) or 'none'}; {name} = forage.state(0.0) in the class declares it"
            )
        if value is not column:
            _assign(column, value, name)


def _assign(column: _Column, value: numpy.typing.ArrayLike, name: str) -> None:
    if not column.flags.writeable:
        raise AttributeError(f"'{name}' is read-only")
    array = numpy.asarray(value)
    if array.shape not in ((), column.shape):
        raise ValueError(f"'{name}' has the shape {column.shape}, and gets an array of the shape {array.shape}")
    numpy.copyto(column, array, casting="same_kind")


class Cells(_Columns):
    """The cells of a group in one cycle, in update() of a neuron type.

    `exc`, `inh` and `mod` are the inputs, read-only arrays of shape (cells,) in the order of cells, row by row. Each state of the type is such an array,
    too, with the values of the last cycle. update() changes states in place (`cells.vm *= 0.9`) or assigns them (`cells.act = numbers`, which copies). When
    update() returns, the states are taken over; when it raises, nothing is. The arrays are copies and belong to the caller: they may be kept, and do
    not change later.
    """

    exc: _Column
    inh: _Column
    mod: _Column
    cycle: int
    _draws: _forage._Draws

    def __init__(self, columns: dict[str, _Column], size: int, draws: typing.Any, cycle: int) -> None:
        super().__init__(columns, size)
        self.__dict__.update(_draws=draws, cycle=cycle)

    def random(self, draw: int = 0) -> _Column:
        """One number per cell, uniform in [0, 1), new in each cycle, from the stream of the group: it depends on the seed of the run only.

        Another `draw`, from 0, gives other, independent numbers. Draws 0 to 3 are `Input::random` in C++. Raises RunError after the call of update().
        """
        return self._draws.uniform(draw)

    def normal(self, draw: int = 0) -> _Column:
        """One number per cell with the normal distribution of mean 0 and standard deviation 1: forage::normal() of draws `draw` and `draw` + 1."""
        return self._draws.normal(draw)

    def events(self, probability: float, draw: int = 0) -> _Column:
        """1 in each cell with this probability, else 0. Draw 0 is `Input::event` in C++."""
        return self._draws.events(probability, draw)


class Synapses(_Columns):
    """Some of the synapses of a connection in one cycle, in update() of a synapse type.

    `pre` is the activity of the sources, a read-only array of shape (synapses,); declared feedback is one as well. Each state is such an array, with the
    values of the last cycle; `synpot`, which update() writes, is the potential that the targets get. How many synapses come in a call is not defined, so
    an update treats each of them alone.
    """

    pre: _Column
    synpot: _Column


class Ports:
    """The groups of a module in one cycle, in update() and start() of a module type.

    Each input is a read-only array of the shape of its group, (rows, columns), or (cells,) of a sparse group. Each output is such an array, which begins
    with 0 when update() first uses it in a cycle, or is assigned. `cycle` is the number of the cycle.
    """

    def __init__(self, inputs: dict[str, _Column], shapes: dict[str, tuple[int, ...]], draws: typing.Any, cycle: int) -> None:
        self.__dict__.update(inputs, _shapes=shapes, _draws=draws, _written={}, cycle=cycle)

    cycle: int
    _shapes: dict[str, tuple[int, ...]]
    _draws: _forage._Draws
    _written: dict[str, _Column]

    def __getattr__(self, name: str) -> _Column:
        shape = self._shapes.get(name)
        if shape is None:
            raise AttributeError(f"the module has no port '{name}'; {name} = forage.output() in the class declares one")
        return self._written.setdefault(name, numpy.zeros(shape))

    def __setattr__(self, name: str, value: numpy.typing.ArrayLike) -> None:
        if name in self.__dict__:
            raise AttributeError(f"'{name}' is read-only")
        column = getattr(self, name)
        if value is not column:
            _assign(column, value, name)

    def random(self, size: int = 1, draw: int = 0) -> _Column:
        """An array of shape (size,) with numbers that are uniform in [0, 1), new in each cycle. It depends on the seed of the run only."""
        return self._draws.uniform_numbers(size, draw)


# The decorators


class _Declared:
    """What a class declares, and what the engine calls for an object of it."""

    def __init__(self, kind: str, cls: type, name: str | None, label: str | None, doc: str | None) -> None:
        self.cls, self.kind = cls, kind
        self.items: list[_Item] = []
        for base in reversed(cls.__mro__):
            for key, item in list(vars(base).items()):
                declared = item if isinstance(item, _Item) else vars(base).get("_forage_items", {}).get(key)
                if declared is not None:
                    declared.name, declared.label = key, declared.label or key
                    self.items = [i for i in self.items if i.name != key] + [declared]
        stem = re.sub(f"{kind}$", "", cls.__name__, flags=re.IGNORECASE) or cls.__name__
        self.name = name or (cls.__name__ if cls.__name__.startswith(kind) else kind + stem[0].upper() + stem[1:])
        self.label = label or stem
        self.doc = doc or re.sub(r"\s+", " ", cls.__doc__ or "").strip()
        if not callable(getattr(cls, "update", None)):
            raise InputError(f"error: {kind} type '{self.name}' has no method update(self, {dict(neuron='cells', synapse='synapses', module='ports')[kind]})")
        allowed = {"neuron": ("parameter", "state"), "synapse": ("parameter", "state", "feedback"), "module": ("parameter", "state", "port")}[kind]
        for item in self.items:
            if item.what not in allowed:
                raise InputError(f"error: {kind} type '{self.name}' declares '{item.name}', which such a type cannot have")
            place = {"neuron": Cells, "synapse": Synapses, "module": Ports}[kind]
            if item.what != "parameter" and (hasattr(place, item.name) or item.name in ("size", "cycle", "exc", "inh", "mod", "pre")):
                raise InputError(f"error: {kind} type '{self.name}': the name '{item.name}' is taken")
        self.parameters = self._of("parameter")
        self.states = self._of("state")
        self.feedback = self._of("feedback")
        self.ports = self._of("port")
        self.kept = {i.name for i in self.states} if kind == "module" else set()
        self.reads = [True, True, True]

    def _of(self, what: str) -> list[_Item]:
        return [i for i in self.items if i.what == what]

    def complete(self) -> None:
        """Adds the output, and gives the class the defaults as attributes."""
        if self.kind == "neuron" and not any(s.output for s in self.states):
            act = next((s for s in self.states if s.name == "act"), None)
            if act is None:
                act = _Item("state", 0.0, output=False, feedback=True, label="Activity")
                act.name = "act"
                self.states.append(act)
            act.about["output"] = True
        if self.kind == "synapse":
            potential = _Item("state", 0.0, output=True, feedback=False, label="Synaptic potential")
            potential.name = "synpot"
            self.states = [s for s in self.states if s.name != "synpot"] + [potential]
        for item in self.states if self.kind != "module" else []:
            if not isinstance(item.initial, (int, float)) or not math.isfinite(item.initial):
                raise InputError(f"error: {self.kind} type '{self.name}': state '{item.name}' begins with a finite number, not {item.initial!r}")
        self.version = _version(self.cls, [(i.what, i.name, repr(i.default), repr(i.about)) for i in self.items])
        cls: typing.Any = self.cls
        cls._forage_items = {**getattr(cls, "_forage_items", {}), **{i.name: i for i in self.items}}
        cls.type_name = self.name
        for item in self.items:
            if item.what in ("parameter", "state") and item.name in vars(cls):
                setattr(cls, item.name, item.default)
        kept, kind, own = self.kept, self.kind, cls.__setattr__

        def guarded(instance: typing.Any, name: str, value: typing.Any) -> None:
            if instance.__dict__.get("_forage_started") and name not in kept:
                hint = f"{name} = forage.state(...) in the class declares what a {kind} keeps"
                raise AttributeError(f"update() cannot set '{name}' of its object: it would not be saved with the run; {hint}")
            own(instance, name, value)

        cls.__setattr__ = guarded

    # Called by the engine, with the GIL.

    def make(self) -> typing.Any:
        made = self.cls()
        if self.kind == "module":
            for item in self.states:
                made.__dict__[item.name] = numpy.array(item.initial) if isinstance(item.initial, numpy.ndarray) else item.initial
        else:
            made.__dict__["_forage_started"] = True
        return made

    def update_cells(self, made: typing.Any, columns: dict[str, _Column], draws: typing.Any, size: int, cycle: int) -> None:
        made.update(Cells(columns, size, draws, cycle))

    def update_synapses(self, made: typing.Any, columns: dict[str, _Column], size: int) -> None:
        made.update(Synapses(columns, size))

    def start_module(self, made: typing.Any, *given: typing.Any) -> dict[str, _Column]:
        ports = Ports(*given)
        if hasattr(made, "start"):
            made.start(ports)
        made.__dict__["_forage_started"] = True
        return ports._written

    def update_module(self, made: typing.Any, *given: typing.Any) -> dict[str, _Column]:
        ports = Ports(*given)
        made.update(ports)
        return ports._written

    def kept_bytes(self, made: typing.Any) -> bytes:
        out = io.BytesIO()
        for item in self.states:
            value = made.__dict__[item.name]
            array = numpy.asarray(value)
            if array.dtype.kind not in "biufcU":
                raise TypeError(f"state '{item.name}' is saved as a number, a bool, a text or an array of them, not as a value of type {type(value).__name__}")
            out.write(b"a" if isinstance(value, numpy.ndarray) else b"s")
            _format.write_array(out, array, allow_pickle=False)
        return out.getvalue()

    def restore(self, made: typing.Any, content: bytes) -> None:
        source = io.BytesIO(content)
        for item in self.states:
            kind = source.read(1)
            array = _format.read_array(source, allow_pickle=False)
            made.__dict__[item.name] = array if kind == b"a" else array.item()


def _version(cls: type, declared: object) -> str:
    """A digest of what a class declares and computes; comments and places of lines do not matter."""
    digest = hashlib.sha256(repr(declared).encode())

    def add(code: _python_types.CodeType) -> None:
        digest.update(code.co_code + repr(code.co_names).encode())
        for constant in code.co_consts:
            if isinstance(constant, _python_types.CodeType):
                add(constant)
            else:
                digest.update(repr(constant).encode())

    for base in reversed(cls.__mro__):
        for key, value in sorted(vars(base).items(), key=lambda pair: pair[0]):
            if isinstance(value, _python_types.FunctionType) and key != "__setattr__":
                digest.update(key.encode())
                add(value.__code__)
    return digest.hexdigest()


def _decorator(kind: str, cls: typing.Any, name: str | None, label: str | None, doc: str | None, reads: typing.Sequence[str] | None = None) -> typing.Any:
    def declare(decorated: typing.Any) -> typing.Any:
        if not isinstance(decorated, type):
            raise TypeError(f"@forage.{kind} decorates a class")
        declared = _Declared(kind, decorated, name, label, doc)
        if reads is not None:
            kinds = ("exc", "inh", "mod")
            if set(reads) - set(kinds):
                raise ValueError(f"reads names inputs: {', '.join(kinds)}")
            declared.reads = [k in reads for k in kinds]
        declared.complete()
        getattr(_forage, f"_add_{kind}")(declared)
        return decorated

    return declare if cls is None else declare(cls)


@typing.overload
def neuron(cls: _Class) -> _Class:
    ...


@typing.overload
def neuron(
    cls: None = None, *, name: str | None = None, label: str | None = None, doc: str | None = None, reads: typing.Sequence[str] | None = None
) -> typing.Callable[[_Class], _Class]:
    ...


def neuron(
    cls: typing.Any = None, *, name: str | None = None, label: str | None = None, doc: str | None = None, reads: typing.Sequence[str] | None = None
) -> typing.Any:
    """Declares a class as a neuron type, for all systems that are opened from now on: @forage.neuron.

    Its method update(self, cells) computes one cycle of a group; see Cells. The class is called once per group, with the GIL, also in runs of several
    threads. A class with the name of an earlier one takes its place; runs that are open keep theirs.

    name: as systems write it. Without one, it is made from the class: "neuronLeaky" for Leaky and LeakyNeuron. `cls.type_name` is it.
    label, doc: how people call it, and what it is; the docstring without it.
    reads: the inputs that update() uses, of "exc", "inh", "mod"; all without it. Connections of another kind give a warning.

    Raises InputError when Forage has a type of this name, and for inconsistent declarations.
    """
    return _decorator("neuron", cls, name, label, doc, reads)


@typing.overload
def synapse(cls: _Class) -> _Class:
    ...


@typing.overload
def synapse(cls: None = None, *, name: str | None = None, label: str | None = None, doc: str | None = None) -> typing.Callable[[_Class], _Class]:
    ...


def synapse(cls: typing.Any = None, *, name: str | None = None, label: str | None = None, doc: str | None = None) -> typing.Any:
    """Declares a class as a synapse type, as neuron() does. Its method update(self, synapses) lets synapses learn and writes `synapses.synpot`; see Synapses."""
    return _decorator("synapse", cls, name, label, doc)


@typing.overload
def module(cls: _Class) -> _Class:
    ...


@typing.overload
def module(cls: None = None, *, name: str | None = None, label: str | None = None, doc: str | None = None) -> typing.Callable[[_Class], _Class]:
    ...


def module(cls: typing.Any = None, *, name: str | None = None, label: str | None = None, doc: str | None = None) -> typing.Any:
    """Declares a class as a module type, as neuron() does. Its method update(self, ports) reads inputs and writes outputs once per cycle; see Ports.

    A method start(self, ports), if there is one, is called before the first cycle, and again when a run is resumed. What it sets is not saved; what
    update() sets must be a state.
    """
    return _decorator("module", cls, name, label, doc)


# What there is, and plugins


class TypeInfo(typing.NamedTuple):
    """What a type declares. forage.types() makes it."""

    name: str
    kind: str
    """"neuron", "synapse" or "module"."""
    label: str
    doc: str
    parameters: dict[str, _Value]
    """The defaults, by name."""
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


def types(plugins: typing.Sequence[_Path] = ()) -> dict[str, TypeInfo]:
    """All types by name: those of Forage, of this program and of `plugins`. Raises InputError for mistakes in the plugins."""
    return {row[0]: TypeInfo(*row) for row in _forage._types(list(plugins))}


class Plugin:
    """A plugin that build_plugin() has made. It is a path: forage.open(..., plugins=[plugin])."""

    def __init__(self, path: str) -> None:
        self._path = path

    @property
    def path(self) -> str:
        """The path of the shared object."""
        return self._path

    @property
    def types(self) -> tuple[str, ...]:
        """The names of its types."""
        return tuple(name for name in types([self]) if name not in types())

    def __fspath__(self) -> str:
        return self._path

    def __repr__(self) -> str:
        return f"<forage.Plugin '{self._path}'>"


_folders: list[tempfile.TemporaryDirectory[str]] = []


def build_plugin(source: _Path, *, name: str = "plugin", directory: _Path | None = None, debug: bool = False) -> Plugin:
    """Compiles types in C++ to a plugin, as `forage build-plugin` does. It takes several seconds.

    source: a text in C++, or the path (a pathlib.Path) of a file.
    name: the name of the plugin's file, without its end, and of the source in messages.
    directory: the folder for the plugin, which is made and trusted, as `forage trust` does. Without it, the plugin is in a temporary folder and goes
        with this program.
    debug: whether it is made for a debugger, and checks each index.

    Raises InputError with the errors of the compiler, each with its line, and for types that do not work.
    """
    if directory is None:
        _folders.append(tempfile.TemporaryDirectory(prefix="forage-"))
    folder = os.path.abspath(_folders[-1].name if directory is None else directory)
    os.makedirs(folder, exist_ok=True)
    if isinstance(source, str):
        path = os.path.join(folder, f"{name}.cpp")
        with open(path, "w", encoding="utf-8") as file:
            file.write(source)
    else:
        path = os.fspath(source)
    return Plugin(_forage._build_plugin(path, os.path.join(folder, f"{name}.so"), debug, os.path.dirname(os.path.abspath(__file__)), directory is not None))
