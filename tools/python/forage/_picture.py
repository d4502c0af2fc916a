"""Pictures, which notebooks show."""
from __future__ import annotations

import os


class Picture:
    """A picture as the content of a file: run.plot(...). Notebooks show it, and save() writes it."""

    def __init__(self, data: bytes, format: str) -> None:
        self.data = data
        """The content of the file, as bytes."""
        self.format = format
        """png, svg, pdf, or gif for a movie."""

    def save(self, file: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> None:
        """Writes the picture to a file, whatever its name is."""
        with open(file, "wb") as out:
            out.write(self.data)

    def _repr_png_(self) -> bytes | None:
        return self.data if self.format == "png" else None

    def _repr_html_(self) -> str | None:
        # A picture of its own, not elements of the page: cairo's ids repeat in every SVG, and nbconvert removes what it does not know.
        mime = {"svg": "image/svg+xml", "gif": "image/gif"}.get(self.format)
        if mime is None:
            return None
        import base64  # when it is needed: importing forage stays light

        return f'<img style="max-width: 100%" src="data:{mime};base64,{base64.b64encode(self.data).decode()}">'

    def __repr__(self) -> str:
        return f"<forage.Picture, {self.format}, {len(self.data)} bytes>"
