"""What Forage raises."""
from __future__ import annotations

import operator

TYPE_CHECKING = False  # that of `typing`, whose import takes time
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any


class Diagnostic:
    """One mistake, or a warning, about a file or an argument. Its text is what `forage check` prints."""

    __slots__ = ("severity", "message", "hint", "file", "line", "column", "text")

    def __init__(
        self, severity: str, message: str, hint: str = "", file: str | None = None, line: int | None = None, column: int | None = None, text: str = ""
    ) -> None:
        self.severity = severity
        """"error" or "warning"."""
        self.message = message
        self.hint = hint
        """How to correct it; may be empty."""
        self.file = file
        """The file's path as it was given; None for mistakes in arguments."""
        self.line = line
        """Counted from 1; None for the file as a whole."""
        self.column = column
        """Counted from 1, in bytes."""
        self.text = text

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        place = ":".join(str(p) for p in (self.file, self.line, self.column) if p is not None)
        return f"<{self.severity}{' at ' + place if place else ''}: {self.message}>"


class InputError(ValueError):
    """Mistakes in a file, a system, a world, a plugin, an expression or an argument.

    The text lists all of them as `forage check` does. `diagnostics` has each of them, and the warnings about the same
    input; `file`, `line`, `column` and `hint` are those of the first mistake.
    """

    def __init__(self, text: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(text, diagnostics)
        self.diagnostics = list(diagnostics)
        first = next((d for d in self.diagnostics if d.severity == "error"), Diagnostic("error", text))
        self.file = first.file
        """The path of the file with the first mistake; None when it is in an argument."""
        self.line = first.line
        """The line of the first mistake, from 1; None when it is not in a line."""
        self.column = first.column
        """The column of the first mistake, from 1, in bytes; None like the line."""
        self.hint = first.hint
        """How to correct the first mistake; may be empty."""

    def __str__(self) -> str:
        return str(self.args[0]).rstrip("\n")


class InputWarning(UserWarning):
    """Something in a file or an argument is legal, and probably not what its author wants."""

    def __init__(self, text: str = "") -> None:
        super().__init__(text)


class RunError(RuntimeError):
    """A cycle of a run failed, a trial took too long, or a run was used in a way that is impossible."""

    def __init__(self, text: str = "") -> None:
        super().__init__(text)


_WORDS = {"int": "an integer", "float": "a number", "str": "a text", "bool": "True or False", "bytes": "bytes", "os.PathLike": "a path", "None": "None"}


def wrong_arguments(name: str, signature: str, given: tuple[Any, ...], named: dict[str, Any], constructor: bool, scope: str, fractions: bool = False) -> str:
    """What is wrong with the arguments of a compiled function, in one sentence. The signature is that of pybind11, with types.

    fractions: whether only fractions in the place of integers are wrong; otherwise the text is empty."""
    method = signature.startswith("(self")
    parameters = [_parameter(text) for text in _split(signature[1 : signature.rindex(")")])]
    names = [n for n, _, _ in parameters]
    positional = names[: next((i for i, n in enumerate(names) if n.startswith("*")), len(names))]
    what = f"{scope.rsplit('.', 1)[-1]}()" if constructor else "[...]" if name in ("__getitem__", "__setitem__", "__delitem__") else f"{name}()"
    values = dict(zip(positional, given))
    if fractions:
        values.update(named)
        integers = [n for n, t, _ in parameters if n in values and t in ("int", "Optional[int]") and not _fits(t, values[n])]
        return f"{what}: {integers[0]} is an integer, not {_short(values[integers[0]])}" if integers else ""
    if len(given) > len(positional) and "*args" not in names:
        count = len(positional) - method
        return f"{what} takes {count} positional argument{'' if count == 1 else 's'}, not {len(given) - method}"
    for n in named:
        if n in values:
            return f"{what} has two values for {n}"
        if n not in names and "**kwargs" not in names:
            from difflib import get_close_matches

            close = get_close_matches(n, names, 1)
            return f"{what} has no argument {n}" + (f"; did you mean {close[0]}?" if close else "")
    values.update(named)
    for n, _, default in parameters:
        if n not in values and not default and not n.startswith("*"):
            return f"{what} lacks the argument {n}"
    types = {n: t for n, t, _ in parameters if n in values}
    for fits in (_fits, _in_range):  # the first one that is wrong, whatever the others are
        for n, type_text in types.items():
            if n != "self" and not fits(type_text, values[n]):
                problem = f"is {_words(type_text)}, not" if fits is _fits else "cannot be"
                subject = f"{what}: {n}" if name else "the value"  # of an attribute
                return f"{subject} {problem} {_short(values[n])}"
    return f"{what} does not take {', '.join(f'{n}={_short(values[n])}' for n in types if n != 'self')}"


def _split(text: str) -> list[str]:
    """The parts of a list that is separated by commas, of which some are in brackets."""
    parts: list[str] = []
    depth = 0
    for piece in text.split(", ") if text else []:
        if depth:
            parts[-1] += ", " + piece
        else:
            parts.append(piece)
        depth += sum((c in "[({") - (c in "])}") for c in piece)
    return parts


def _parameter(text: str) -> tuple[str, str, bool]:
    """A parameter's name and type, and whether it has a default."""
    name, _, rest = text.partition(": ")
    type_text, equals, _ = rest.partition(" = ")
    return name, type_text, bool(equals)


def _inner(type_text: str) -> list[str]:
    return _split(type_text[type_text.index("[") + 1 : type_text.rindex("]")])


def _choices(type_text: str) -> list[str]:
    if type_text.startswith("Optional["):
        return [*_inner(type_text), "None"]
    return _inner(type_text) if type_text.startswith("Union[") else [type_text]


def _fits(type_text: str, value: Any) -> bool:
    """Whether a value may be of this type; True for types that are not known here."""
    return any(_is(t, value) for t in _choices(type_text))


def _is(type_text: str, value: Any) -> bool:
    if type_text == "None":
        return value is None
    if type_text == "int":
        try:  # all arrays of NumPy have __index__
            operator.index(value)
        except TypeError:
            return False
        return True
    if type_text == "float":
        return hasattr(value, "__float__") or hasattr(value, "__index__")
    if type_text == "bool":
        return isinstance(value, bool) or type(value).__name__ in ("bool", "bool_")  # of NumPy since version 2, and before
    if type_text in ("str", "bytes"):
        return isinstance(value, (str, bytes) if type_text == "str" else bytes)
    if type_text == "os.PathLike":
        return isinstance(value, (str, bytes)) or hasattr(value, "__fspath__")
    if type_text.startswith(("List[", "Tuple[", "Iterable", "list[", "tuple[")):
        if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__") and not hasattr(value, "__getitem__"):
            return False
        return not type_text.startswith(("List[", "list[")) or not isinstance(value, (list, tuple)) or all(_fits(_inner(type_text)[0], v) for v in value)
    if type_text.startswith(("Dict[", "dict", "Mapping")):
        return hasattr(value, "keys")
    if "forage" in type_text:
        return type(value).__name__ == type_text.rsplit(".", 1)[-1].rsplit("::", 1)[-1].replace("Python", "")
    return True


def _in_range(type_text: str, value: Any) -> bool:
    """Whether an integer fits any type of C++ that the function may have."""
    return "int" not in _choices(type_text) or not _is("int", value) or 0 <= operator.index(value) < 1 << 31


def _words(type_text: str) -> str:
    def one(t: str) -> str:
        if t.startswith(("List[", "list[", "Iterable")):
            return "a list"
        if t.startswith(("Tuple[", "tuple[")):
            return f"a tuple of {len(_inner(t))}"
        return _WORDS.get(t) or "a " + t.rsplit(".", 1)[-1].rsplit("::", 1)[-1].replace("Python", "").split("[")[0]

    return " or ".join(dict.fromkeys(map(one, _choices(type_text))))


def _short(value: Any) -> str:
    try:
        text = repr(value)
    except Exception:
        text = f"a value of type {type(value).__name__}"
    text = " ".join(text.split())
    return text if len(text) <= 60 else f"a value of type {type(value).__name__}"
