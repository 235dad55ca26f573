"""Write what README.md asks for."""


def lambert(N, L):
    """N, L: lists of three floats, unit vectors.  Returns a float."""
    return 0.0
