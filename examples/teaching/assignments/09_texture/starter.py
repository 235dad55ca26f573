"""Write what README.md asks for."""


def texture_at(w, uv, abc):
    """w, abc: lists of three floats; uv: three lists [u, v].  Returns [u, v]."""
    return [0.0, 0.0]
