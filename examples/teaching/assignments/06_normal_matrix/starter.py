"""Write what README.md asks for."""


def normal_matrix(model):
    """model: sixteen floats, column after column.  Returns three columns of three floats."""
    return [model[0:3], model[4:7], model[8:11]]
