"""Write what README.md asks for."""


def mirror(L, N):
    """L, N: lists of three floats, unit vectors.  Returns a list of three."""
    return L
