"""6. The matrix of normals."""
import math

from .points import Case
from .tools import cross, dot, length, scale, unit

INPUTS = "model.col[0]4 model.col[1]4 model.col[2]4 model.col[3]4 normal3"
OUTPUTS, TOLERANCE = "9", 1e-4
SENT = 16  # the normal stays with the judge


def normal_matrix(model):
    """The inverse transpose, by cross products of columns."""
    x, y, z = model[0:3], model[4:7], model[8:11]
    determinant = dot(x, cross(y, z))
    columns = [cross(y, z), cross(z, x), cross(x, y)]
    return [e / determinant for column in columns for e in column]


FUNCTIONS = [normal_matrix]


def compared(inputs, numbers):
    """The direction in which the matrix takes the normal: no length counts."""
    N = inputs[SENT:]
    out = [sum(numbers[3 * k + i] * N[k] for k in range(3)) for i in range(3)]
    return unit(out) if 1e-18 < length(out) < 1e18 else [0, 0, 0]


def product(a, b):
    """Returns a b, three columns each."""
    return [[sum(a[k][i] * column[k] for k in range(3)) for i in range(3)] for column in b]


def rotation(draw):
    """Returns three columns at right angles."""
    x = draw.direction()
    y = draw.at(x, 0)
    return [x, y, cross(x, y)]


def matrix(change):
    """Returns what makes a matrix of two rotations with a change between them, and a normal."""
    def make(draw):
        m = product(product(rotation(draw), change(draw)), rotation(draw))
        moved = [e for column in m for e in column + [0]] + draw.some(-5, 5, 3) + [1]
        return moved + draw.direction()
    return make


def scaling(sign):
    """Returns what scales each axis by a factor of its own, one at least twice another."""
    def change(draw):
        factors = [draw.spread(0.3, 0.7), draw.spread(1.4, 3), draw.spread(0.4, 2.5)]
        return [[sign * f if i == k == 0 else f if i == k else 0 for i in range(3)]
                for k, f in enumerate(factors)]
    return change


def shear(draw):
    """Returns what moves points of one axis along the two others."""
    along = draw.choice([-1, 1]) * draw.between(0.5, 2)
    return [[1, 0, 0], [along, 1, 0], draw.some(0.5, 1, 2) + [1]]


CASES = [
    Case(2, "rotations and translations", matrix(lambda draw: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
         "For a rotation the inverse transpose is the rotation itself; a translation turns no "
         "normal."),
    Case(3, "scaled", matrix(scaling(1)),
         "A normal stays at right angles to each edge M e of the moved mesh only if it becomes the "
         "inverse transpose of M times N: its product with M e is then that of N and e."),
    Case(2, "sheared", matrix(shear),
         "A shear changes normals although it leaves lengths along the axes: invert the whole "
         "matrix."),
    Case(3, "mirrored", matrix(scaling(-1)),
         "A mirror has a negative determinant; the normals still point out of the mesh."),
]
RIGHT = "[e / determinant for column in columns for e in column]"
MISTAKES = [
    ("as_points", RIGHT, "x + y + z",
     "Normals are transformed as points are. Where a matrix scales one direction more than "
     "another, that tilts them: take the inverse transpose."),
    ("inverse_alone", RIGHT, "[columns[k][i] / determinant for i in range(3) for k in range(3)]",
     "This is the inverse, or columns are taken for rows: the inverse must be transposed."),
    ("transpose_alone", RIGHT, "[v[i] for i in range(3) for v in (x, y, z)]",
     "This is the transpose; transpose the inverse."),
    ("cofactors", "e / determinant", "e",
     "These are the cofactors, the inverse transpose times the determinant. That is negative where "
     "the matrix mirrors: there your normals point inward."),
    ("unit_columns", RIGHT, "unit(x) + unit(y) + unit(z)",
     "The columns are made unit. That takes the scale away, but normals need its inverse."),
    ("not_moved", RIGHT, "[1, 0, 0, 0, 1, 0, 0, 0, 1]",
     "The normals stay as they are: they must turn with the mesh."),
    ("negated", "e / determinant", "-e / determinant",
     "The normals point inward: the sign is turned round."),
    ("divided_twice", RIGHT, "scale(1 / dot(x, x), x) + scale(1 / dot(y, y), y) + scale(1 / dot(z, "
                             "z), z)",
     "Each column is divided by the square of its length. That is the inverse transpose only where "
     "the columns are at right angles: invert the whole matrix."),
    ("one_column_turned", "cross(z, x)", "cross(x, z)",
     "One of the cross products has its two columns exchanged: they go round, y z, z x, x y."),
    ("diagonal", RIGHT, "[1 / x[0], 0, 0, 0, 1 / y[1], 0, 0, 0, 1 / z[2]]",
     "Only the diagonal is inverted, which is the inverse of a matrix that scales and does nothing "
     "else."),
    ("adjugate", RIGHT, "[columns[k][i] for i in range(3) for k in range(3)]",
     "This is the adjugate, the inverse times the determinant: divide by the determinant, whose "
     "sign counts, and transpose."),
    ("minors", RIGHT, "[(-1) ** (k + i) * e / determinant for k, column in enumerate(columns) for "
                      "i, e in enumerate(column)]",
     "Every other number has the wrong sign. Minors become cofactors by the signs of a chessboard: "
     "+ - +, - + -, + - +."),
    ("unit_then_inverted", "model[0:3], model[4:7], model[8:11]",
     "unit(model[0:3]), unit(model[4:7]), unit(model[8:11])",
     "The columns are made unit before the matrix is inverted. That takes the scale away, whose "
     "inverse normals need."),
    ("result_unit", RIGHT, "[e for c in columns for e in unit(scale(1 / determinant, c))]",
     "The columns of the result are made unit: a normal mixes them, so their lengths count."),
]


def place(x, y):
    """The inputs of a place of the picture."""
    c, s, h = math.cos(3 * x), math.sin(3 * x), 1 + 0.9 * y
    return [c, 0, -s, 0, 0, h, 0, 0, 0.5 * s, 0, 0.5 * c, 0, 0, 0, 0, 1, 1 / 3, 2 / 3, 2 / 3]


def color(out, x, y):
    """What an answer looks like there."""
    return [0.5 * n + 0.5 for n in out]
