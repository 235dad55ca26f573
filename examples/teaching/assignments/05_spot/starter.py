"""Write what README.md asks for."""


def spot(L, aim, cos_cutoff, e):
    """L, aim: lists of three floats; e >= 0.  Returns a float."""
    return 1.0
