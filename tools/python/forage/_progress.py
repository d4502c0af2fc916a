"""Progress on one line of the standard error, in a terminal as in a notebook."""
import sys


class Bar:
    """Called with the fraction that is done, 0 to 1, and a text about it."""

    width = 30

    def __call__(self, fraction, text):
        filled = int(self.width * min(fraction, 1))
        sys.stderr.write(f"\r[{'=' * filled:{self.width}}] {100 * fraction:3.0f} %  {text:40}")
        if fraction >= 1:
            sys.stderr.write("\n")
        sys.stderr.flush()
