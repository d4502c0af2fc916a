"""What pickles refer to."""
import math

from . import _forage


def resumed(state, on_nan="warn"):
    """The run that was pickled; older pickles do not have `on_nan`."""
    return _forage._resumed(state, on_nan)  # a pickle can run code anyway, so its plugins are trusted


def value(text):
    """The pattern, arborization or function of the distance with this text."""
    import forage

    return eval(text, {"forage": forage, "inf": math.inf, "nan": math.nan})


def weights(text, is_list):
    """The pattern of weights with this table."""
    return _forage._weights_of_text(text, is_list)
