"""What Forage raises."""
from __future__ import annotations

TYPE_CHECKING = False  # that of `typing`, whose import takes time
if TYPE_CHECKING:
    from collections.abc import Sequence


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

    def __str__(self) -> str:
        return str(self.args[0]).rstrip("\n")

    @property
    def _first(self) -> Diagnostic:
        return next((d for d in self.diagnostics if d.severity == "error"), Diagnostic("error", str(self)))

    @property
    def file(self) -> str | None:
        """The path of the file with the first mistake; None when it is in an argument."""
        return self._first.file

    @property
    def line(self) -> int | None:
        """The line of the first mistake, from 1; None when it is not in a line."""
        return self._first.line

    @property
    def column(self) -> int | None:
        """The column of the first mistake, from 1, in bytes; None like the line."""
        return self._first.column

    @property
    def hint(self) -> str:
        """How to correct the first mistake; may be empty."""
        return self._first.hint


class InputWarning(UserWarning):
    """Something in a file or an argument is legal, and probably not what its author wants."""


class RunError(RuntimeError):
    """A cycle of a run failed, a trial took too long, or a run was used in a way that is impossible."""
