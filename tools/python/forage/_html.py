"""What notebooks show of the objects."""
import base64
import os
from html import escape

from ._errors import InputError, RunError


def plain(thing):
    return f"<code>{escape(repr(thing))}</code>"


def with_table(head, rows):
    """Shows what repr() gives and a table; no table of a run that is closed or running, or that does not compute these numbers."""

    def show(self):
        try:
            return plain(self) + folded(head, rows(self))
        except (InputError, RunError):
            return plain(self)

    return show


def table(head, rows):
    """A table; numbers are aligned on the right."""

    def cell(value, tag):
        side = "left" if isinstance(value, str) else "right"
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        return f'<{tag} style="text-align: {side}">{escape(text)}</{tag}>'

    lines = ["".join(cell(v, "th") for v in head), *("".join(cell(v, "td") for v in row) for row in rows)]
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def folded(head, rows, most=12):
    """A table, which a reader opens when it is long."""
    whole = table(head, rows)
    return whole if len(rows) <= most else f"<details><summary>{len(rows)} rows</summary>{whole}</details>"


def size(group):
    return " x ".join(map(str, reversed(group.shape)))


def _groups(run):
    return [(g.path, size(g), g.type) for g in map(run.__getitem__, run.groups)]


def _states(group):
    states = [(name, getattr(group, name)) for name in group.states]
    return [(name, float(values.min()), float(values.mean()), float(values.max())) for name, values in states]


def _values(parameters):
    return [(name, parameters[name]) for name in parameters]


run = with_table(("group", "cells", "type"), _groups)
group = with_table(("state", "smallest", "mean", "largest"), _states)
parameters = with_table(("parameter", "value"), _values)


def recording(self):
    cells = self._table()
    rows = [(int(c), float(r.min()), float(r.mean()), float(r.max())) for c, r in _ends(list(zip(self.cycles, cells)))]
    return plain(self) + table(("cycle", "smallest", "mean", "largest"), rows)


def _ends(rows, most=20):
    """The first and the last rows when there are more than `most`."""
    return rows if len(rows) <= most else [*rows[: most // 2], *rows[-most // 2 :]]


def film(self):
    if not self.closed or not self.file.endswith((".gif", ".mp4")) or not os.path.isfile(self.file):  # there is none without a frame
        return plain(self)
    with open(self.file, "rb") as file:
        data = base64.b64encode(file.read()).decode()
    if self.file.endswith(".mp4"):
        return f'<video controls style="max-width: 100%" src="data:video/mp4;base64,{data}"></video>'
    return f'<img style="max-width: 100%" src="data:image/gif;base64,{data}">'
