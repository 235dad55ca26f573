"""Write what README.md asks for."""


def iteration_four(lighting, m, eye, P, N):
    """lighting has the fields ambient and lights; m, the material, has emission, ambient, diffuse,
    specular and shininess; a lamp has position, ambient, diffuse, specular, constant, linear, quadratic,
    spot_direction, spot_exponent and spot_cos_cutoff.  Colours and vectors are lists of floats.
    Returns a list of three.
    """
    return m.emission
