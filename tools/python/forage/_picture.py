"""Pictures, which notebooks show."""
from __future__ import annotations

import os


class Picture:
    """A picture as the content of a file: run.plot(...). Notebooks show it, and save() writes it."""

    def __init__(self, data: bytes, format: str) -> None:
        self.data = data
        """The content of the file, as bytes."""
        self.format = format
        """png, svg or pdf."""

    def save(self, file: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> None:
        """Writes the picture to a file, whatever its name is."""
        with open(file, "wb") as out:
            out.write(self.data)

    def _repr_png_(self) -> bytes | None:
        return self.data if self.format == "png" else None

    def _repr_svg_(self) -> str | None:
        # Without the XML declaration, which nbconvert refuses in text.
        return self.data.decode().split("?>", 1)[-1].lstrip() if self.format == "svg" else None

    def __repr__(self) -> str:
        return f"<forage.Picture, {self.format}, {len(self.data)} bytes>"
