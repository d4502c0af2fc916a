"""What notebooks show of the objects."""
import base64
from html import escape

from ._errors import InputError, RunError


def plain(thing):
    return f"<code>{escape(repr(thing))}</code>"


def table(head, rows):
    """A table; numbers are aligned on the right."""
    def cell(value, tag):
        side = "left" if isinstance(value, str) else "right"
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        return f'<{tag} style="text-align: {side}">{escape(text)}</{tag}>'

    lines = ["".join(cell(v, "th") for v in head), *("".join(cell(v, "td") for v in row) for row in rows)]
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def size(group):
    return " x ".join(map(str, reversed(group.shape)))


def run(self):
    if self.closed:
        return plain(self)
    groups = [self[path] for path in self.groups]
    rows = [(g.path, size(g), g.type) for g in groups]
    return plain(self) + f"<p>{self.seconds:.6g} s of the world</p>" + table(("group", "cells", "type"), rows)


def group(self):
    rows = []
    for name in self.states:
        try:
            values = getattr(self, name)
        except (InputError, RunError):  # not observed, or closed
            return plain(self)
        rows.append((name, float(values.min()), float(values.mean()), float(values.max())))
    return plain(self) + table(("state", "smallest", "mean", "largest"), rows)


def parameters(self):
    return plain(self) + table(("parameter", "value"), [(name, self[name]) for name in self])


def film(self):
    if not self.closed or not self.file.endswith(".gif"):
        return plain(self)
    with open(self.file, "rb") as file:
        data = base64.b64encode(file.read()).decode()
    return f'<img style="max-width: 100%" src="data:image/gif;base64,{data}">'
