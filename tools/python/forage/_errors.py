"""What Forage raises."""


class Diagnostic:
    """One mistake, or a warning, about a file or an argument. Its text is what `forage check` prints."""

    __slots__ = ("severity", "message", "hint", "file", "line", "column", "text")

    def __init__(self, severity, message, hint="", file=None, line=None, column=None, text=""):
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

    def __str__(self):
        return self.text

    def __repr__(self):
        place = ":".join(str(p) for p in (self.file, self.line, self.column) if p is not None)
        return f"<{self.severity}{' at ' + place if place else ''}: {self.message}>"


class InputError(ValueError):
    """Mistakes in a file, a system, a world, a plugin, an expression or an argument.

    The text lists all of them as `forage check` does. `diagnostics` has each of them, and the warnings about the same
    input; `file`, `line`, `column` and `hint` are those of the first mistake.
    """

    def __init__(self, text, diagnostics=()):
        super().__init__(text, diagnostics)
        self.diagnostics = list(diagnostics)

    def __str__(self):
        return str(self.args[0]).rstrip("\n")

    def _first(self, name):
        return next((getattr(d, name) for d in self.diagnostics if d.severity == "error"), None)

    @property
    def file(self):
        """The path of the file with the first mistake; None when it is in an argument."""
        return self._first("file")

    @property
    def line(self):
        """The line of the first mistake, from 1; None when it is not in a line."""
        return self._first("line")

    @property
    def column(self):
        """The column of the first mistake, from 1, in bytes; None like the line."""
        return self._first("column")

    @property
    def hint(self):
        """How to correct the first mistake; may be empty."""
        return self._first("hint") or ""


class InputWarning(UserWarning):
    """Something in a file or an argument is legal, and probably not what its author wants."""


class RunError(RuntimeError):
    """A cycle of a run failed, a trial took too long, or a run was used in a way that is impossible."""
