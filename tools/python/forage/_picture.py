"""Pictures, which notebooks show."""


class Picture:
    """A picture as the content of a file: run.plot(...). Notebooks show it, and save() writes it."""

    def __init__(self, data, format):
        self.data = data
        """The content of the file, as bytes."""
        self.format = format
        """png, svg or pdf."""

    def save(self, file):
        """Writes the picture to a file, whatever its name is."""
        with open(file, "wb") as out:
            out.write(self.data)

    def _repr_png_(self):
        return self.data if self.format == "png" else None

    def _repr_svg_(self):
        return self.data.decode() if self.format == "svg" else None

    def __repr__(self):
        return f"<forage.Picture, {self.format}, {len(self.data)} bytes>"
