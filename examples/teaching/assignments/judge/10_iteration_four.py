"""10. Iteration four, whole."""
import math

from .points import Case
from .tools import add, ball, dot, length, mul, pow, scale, sub, unit

LAMPS = 3
LAMP = ("position3 spot_direction3 spot_cos_cutoff1 spot_exponent1 ambient3 diffuse3 specular3 "
        "constant1 linear1 quadratic1")
INPUTS = ("eye3 P3 N3 m.emission3 m.ambient3 m.diffuse3 m.specular3 m.shininess1 lighting.ambient3 "
          "light_count1") + "".join(f" lights[{k}].{LAMP}" for k in range(LAMPS))
OUTPUTS, TOLERANCE = "3", 1e-4
PARTS = ["red", "green", "blue"]
BASES = 3  # cases whose terms the cases after them have too
TERMS = [  # numbers of the inputs that make a term, and what to say where it alone is wrong
    (9, 12, "All is right but k_e."),
    (22, 25, "All is right but k_a I_a, the ambient light of the scene."),
    (34, 37, "All is right but k_a I_La, the ambient light of a lamp: no cone, no distance and no B "
             "stands before it."),
    (37, 40, "All is right but the diffuse term: k_d I_d (N.L), times spot / (a + b r + c r^2)."),
    (40, 43, "All is right but the highlight: k_s I_s (N.H)^n, times spot / (a + b r + c r^2). Look "
             "at H, at the exponent, at what stands before k_s."),
    (37, 43, "All is right but the factor that dims both terms, spot / (a + b r + c r^2): look at r "
             "and at the cone."),
]


def iteration_four(lighting, material, eye, P, N):
    """The light from P to the eye."""
    V = unit(sub(eye, P))
    light = add(material.emission, mul(material.ambient, lighting.ambient))
    for lamp in lighting.lights:
        to = sub(lamp.position[0:3], P)
        L, r = unit(to), length(to)
        S = unit(scale(-1, lamp.spot_direction))
        spot = pow(max(0, dot(L, S)), lamp.spot_exponent)
        spot = spot if dot(L, S) >= lamp.spot_cos_cutoff else 0
        fall = 1 / (lamp.constant + lamp.linear * r + lamp.quadratic * r * r)
        B = 1 if dot(N, L) > 0 else 0
        H = unit(add(L, V))
        lobe = pow(max(0, dot(N, H)), material.shininess)
        diffuse = scale(B * dot(N, L), mul(material.diffuse, lamp.diffuse))
        specular = scale(B * lobe, mul(material.specular, lamp.specular))
        light = add(light, mul(material.ambient, lamp.ambient))
        light = add(light, scale(spot * fall, add(diffuse, specular)))
    return light


FUNCTIONS = [iteration_four]


def fill(draw, lamps, side, lit=True, hidden=False):
    """Returns a scene in which each term of each lamp can be seen: all lamps in front of the
    surface or behind it, and the point in their cones or, not lit, outside of the first one.  In one
    of ten scenes with lamps behind they are at the horizon, where N.L is 0 to the bit.  Hidden: the
    eye is behind the surface, N.V < 0, and the highlight of the first lamp is there all the same.
    Some lamps with e = 0 light what is behind them, in a cone wider than 90 degrees."""
    N, P, n = draw.direction(), draw.some(-0.6, 0.6, 3), draw.spread(1, 80 if side > 0 else 4)
    to = [draw.at(N, side * draw.between(0.1, 1)) for _ in range(LAMPS)]
    if side < 0 and draw.random() < 0.1:
        N, *to = draw.axes()
    while True:
        if hidden:
            n, to[0] = draw.spread(1, 3), draw.at(N, draw.between(0.1, 0.4))
        H = draw.at(N, draw.lobe(n, 0.2))
        V = sub(scale(2 * dot(H, to[0]), H), to[0])
        V = V if side > 0 else draw.at(N, draw.between(0.6, 1))
        if dot(N, V) < -0.05 if hidden else dot(N, V) > 0.05:
            break
    inputs = add(P, scale(draw.between(1.5, 4), V)) + P + N
    inputs += draw.some(0.05, 0.9, 12) + [n] + draw.some(0.05, 0.5, 3) + [lamps]
    for k, L in enumerate(to):
        e = 0 if draw.random() < 0.1 else draw.spread(0.5, 40)
        here = lit or k and draw.random() < 0.5
        cosine = draw.lobe(e, 0.2) if here else draw.between(0.3, 0.9)
        if here and not e and draw.random() < 0.6:
            cosine = draw.between(-0.8, -0.1)
        cutoff = draw.between(min(-0.5, cosine - 0.15), cosine - 0.01) if here else draw.between(
            cosine + 0.01, 1)
        inputs += add(P, scale(draw.between(0.6, 2.5), L))
        inputs += scale(-draw.spread(0.3, 4), draw.at(L, cosine)) + [cutoff, e]
        inputs += draw.some(0.05, 0.4, 3) + draw.some(0.3, 2, 6)
        inputs += [draw.between(0.2, 0.9), draw.between(0.1, 0.8), draw.between(0.1, 0.8)]
    return inputs


CASES = [
    Case(2, "no lamp", lambda draw: fill(draw, 0, 1), "Without a lamp the answer is k_e + k_a "
                                                      "I_a."),
    Case(6, "one lamp", lambda draw: fill(draw, 1, 1),
         "Look at one term after the other: L and V are unit vectors from P, S is -spot_direction "
         "made unit, the highlight has the lamp's specular colour, and cone and distance dim k_d "
         "and k_s alone."),
    Case(5, "several lamps", lambda draw: fill(draw, draw.randint(2, 3), 1,
                                               hidden=draw.random() < 0.25),
         "If one lamp is right and several are not, look at the sum: each lamp has its own L, H, "
         "r, cone and B."),
    Case(4, "lamps behind the surface", lambda draw: fill(draw, draw.randint(1, 3), -1),
         "Where N.L is not above 0 a lamp adds its ambient light alone, k_a I_La."),
    Case(3, "outside of a cone", lambda draw: fill(draw, draw.randint(1, 3), 1, False),
         "Outside of its cone a lamp adds its ambient light alone, k_a I_La."),
]
CUT = "spot = spot if dot(L, S) >= lamp.spot_cos_cutoff else 0"
AMBIENT = "light = add(light, mul(material.ambient, lamp.ambient))"
START = "light = add(material.emission, mul(material.ambient, lighting.ambient))"
LIGHTS = """mul(material.diffuse, lamp.diffuse))
        specular = scale(B * lobe, mul(material.specular, lamp.specular))"""
BOTH = "scale(spot * fall, add(diffuse, specular))"
OFTEN = AMBIENT + "\n        light = add(light, scale(1 if lamp is not lighting.lights[0] else 0, "
MISTAKES = [
    ("ungated", "scale(B * lobe,", "scale(lobe,",
     "The highlight has no B: where N.L is not above 0 both terms are 0."),
    ("no_gate", "B = 1 if dot(N, L) > 0 else 0", "B = 1",
     "B is missing: a lamp behind the surface takes light away, because its N.L is negative. B is "
     "0 there, for both terms."),
    ("absolute", "scale(B * dot(N, L),", "scale(abs(dot(N, L)),",
     "The absolute value of N.L lights the back of the surface: B is 0 where N.L is not above 0."),
    ("gated_by_viewer", "if dot(N, L) > 0 else", "if dot(N, L) > 0 and dot(N, V) > 0 else",
     "Where N.V is negative the terms are 0 here. B asks for N.L alone; what the eye cannot see is not "
     "drawn anyway."),
    ("dark_behind", "pow(max(0, dot(L, S)), lamp.spot_exponent)",
     "(pow(dot(L, S), lamp.spot_exponent) if dot(L, S) > 0 else 0)",
     "Behind a lamp, where L.S is negative, a wide cone with an exponent of 0 is lit too: 0 to the "
     "power 0 is 1."),
    ("dimmed_ambient", AMBIENT, "light = add(light, scale(spot * fall, mul(material.ambient, "
                                "lamp.ambient)))",
     "The ambient light of a lamp, I_La, is dimmed by its cone and its distance: in iteration four "
     "it stands outside of both."),
    ("attenuated_ambient", AMBIENT, "light = add(light, scale(fall, mul(material.ambient, "
                                    "lamp.ambient)))",
     "The ambient light of a lamp, I_La, is divided by a + b r + c r^2: only k_d and k_s are."),
    ("gated_ambient", AMBIENT, "light = add(light, scale(B, mul(material.ambient, lamp.ambient)))",
     "A lamp behind the surface adds no ambient light here: k_a I_La has no B."),
    ("no_lamp_ambient", AMBIENT, "pass",
     "The ambient light that each lamp adds is missing: k_a I_La stands inside the sum."),
    ("no_scene_ambient", "add(material.emission, mul(material.ambient, lighting.ambient))",
     "material.emission", "The ambient light of the scene is missing: k_a I_a, once, before the "
                          "sum."),
    ("no_emission", "add(material.emission, mul(material.ambient, lighting.ambient))",
     "mul(material.ambient, lighting.ambient)", "k_e is missing: what the surface emits by "
                                                "itself."),
    ("ambient_without_k", "mul(material.ambient, lighting.ambient)", "lighting.ambient",
     "I_a is added without k_a: the surface returns the share k_a of it."),
    ("emission_often", AMBIENT, OFTEN + "material.emission))",
     "k_e is added for each lamp: it stands before the sum."),
    ("ambient_often", AMBIENT, OFTEN + "mul(material.ambient, lighting.ambient)))",
     "k_a I_a is added for each lamp: it stands before the sum."),
    ("phong", "dot(N, H)", "dot(sub(scale(2 * dot(N, L), N), L), V)",
     "The highlight is Phong's (R.V)^n: iteration four has (N.H)^n."),
    ("no_exponent", "material.shininess)", "1)",
     "The highlight is as wide as for n = 1: raise N.H to the power n."),
    ("exponent_times_4", "material.shininess)", "4 * material.shininess)",
     "The exponent is 4 n. That factor makes Blinn's lobe look like Phong's; here it is n."),
    ("weighted", "scale(B * lobe,", "scale(B * dot(N, L) * lobe,",
     "The highlight is multiplied by N.L: in iteration four only the diffuse term is."),
    ("H_not_unit", "H = unit(add(L, V))", "H = scale(0.5, add(L, V))",
     "H is (L + V) / 2, which is shorter than 1: divide the sum by its length."),
    ("H_from_positions", "H = unit(add(L, V))", "H = unit(add(to, sub(eye, P)))",
     "H is made of vectors that are not unit: make L and V unit before you add them."),
    ("no_distance", "1 / (lamp.constant + lamp.linear * r + lamp.quadratic * r * r)", "1",
     "Lamps are as bright far away as nearby: divide by a + b r + c r^2."),
    ("no_linear", "lamp.linear * r + ", "", "b r is missing from a + b r + c r^2."),
    ("no_quadratic", " + lamp.quadratic * r * r", "", "c r^2 is missing from a + b r + c r^2."),
    ("one_and_square", "lamp.constant + lamp.linear * r", "1",
     "This divides by 1 + c r^2, as for a = 1 and b = 0: divide by a + b r + c r^2."),
    ("square_alone", "lamp.constant + lamp.linear * r + ", "",
     "This divides by c r^2: a and b r are missing."),
    ("constant_is_one", "lamp.constant", "1", "a is taken for 1: divide by a + b r + c r^2."),
    ("not_squared", "lamp.quadratic * r * r", "lamp.quadratic * r", "c belongs to the square of "
                                                                    "r."),
    ("distance_of_unit", "L, r = unit(to), length(to)", "L, r = unit(to), 1",
     "The distance is 1 for every lamp: take the length of the vector to the lamp before you make "
     "it unit."),
    ("distance_squared", "length(to)", "dot(to, to)",
     "r is the square of the distance: the root is missing."),
    ("no_cone", CUT, "spot = 1",
     "Lamps shine outside of their cones, and evenly inside: spot is 0 where L.S is below "
     "spot_cos_cutoff, else (L.S) to the power spot_exponent."),
    ("no_cutoff", CUT, "pass",
     "Cones are not cut: spot is 0 where L.S is below spot_cos_cutoff."),
    ("no_spot_exponent", "pow(max(0, dot(L, S)), lamp.spot_exponent)", "1",
     "Lamps shine evenly in their cones: there the factor is (L.S) to the power spot_exponent."),
    ("reversed_cone", "scale(-1, lamp.spot_direction)", "lamp.spot_direction",
     "The cones point the wrong way: S is -spot_direction, and L.S is 1 on the axis."),
    ("aim_not_unit", "S = unit(scale(-1, lamp.spot_direction))", "S = scale(-1, "
                                                                 "lamp.spot_direction)",
     "spot_direction is of any length: make it unit before you take L.S."),
    ("cutoff_as_angle", "dot(L, S) >= lamp.spot_cos_cutoff",
     "math.acos(max(-1, min(1, dot(L, S)))) <= lamp.spot_cos_cutoff",
     "An angle is compared with a cosine: spot_cos_cutoff is the cosine already, so compare L.S "
     "with it."),
    ("cutoff_after_power", "dot(L, S) >= lamp.spot_cos_cutoff",
     "pow(max(0, dot(L, S)), lamp.spot_exponent) >= lamp.spot_cos_cutoff",
     "The power is compared with spot_cos_cutoff: compare L.S itself."),
    ("eye_as_direction", "unit(sub(eye, P))", "unit(eye)",
     "V is taken from the origin: it is the unit vector from P to the eye, eye - P."),
    ("eye_reversed", "unit(sub(eye, P))", "unit(sub(P, eye))",
     "V points from the eye to P: it is the unit vector from P to the eye, eye - P."),
    ("eye_not_unit", "unit(sub(eye, P))", "sub(eye, P)",
     "V is eye - P of any length: make it unit before you add it to L."),
    ("lamp_as_direction", "sub(lamp.position[0:3], P)", "lamp.position[0:3]",
     "L is taken from the origin: it is the unit vector from P to the lamp, position - P."),
    ("lamp_reversed", "sub(lamp.position[0:3], P)", "sub(P, lamp.position[0:3])",
     "L points from the lamp to P: it is the unit vector from P to the lamp, position - P."),
    ("L_not_unit", "L, r = unit(to), length(to)", "L, r = to, length(to)",
     "L is position - P of any length: make it unit before you take N.L."),
    ("colors_of_diffuse", "mul(material.specular,", "mul(material.diffuse,",
     "The highlight has the colour k_d: it has a colour of its own, k_s."),
    ("colors_of_specular", "mul(material.diffuse,", "mul(material.specular,",
     "The diffuse term has the colour k_s: its colour is k_d."),
    ("exchanged_lights", LIGHTS, LIGHTS.replace("diffuse))", "spec))").replace(
        "specular))", "diffuse))").replace("spec))", "specular))"),
     "I_d and I_s are exchanged: k_d goes with the lamp's diffuse colour, k_s with its specular "
     "one."),
    ("diffuse_light_alone", "lamp.specular", "lamp.diffuse",
     "The highlight has the lamp's diffuse colour I_d: it goes with I_s."),
    ("specular_light_alone", "mul(material.diffuse, lamp.diffuse)", "mul(material.diffuse, "
                                                                    "lamp.specular)",
     "The diffuse term has the lamp's specular colour I_s: it goes with I_d."),
    ("one_channel_of_emission", "material.emission,", "3 * [material.emission[0]],",
     "k_e has one value in all channels here: use its red, green and blue."),
    ("no_specular", "add(diffuse, specular)", "diffuse", "The highlight is missing: k_s I_s "
                                                         "(N.H)^n."),
    ("no_diffuse", "add(diffuse, specular)", "specular", "The diffuse term is missing: k_d I_d "
                                                         "(N.L)."),
    ("last_lamp", AMBIENT, START + "\n        " + AMBIENT,
     "Only the last lamp is left: add the lamps up, each with +=."),
    ("first_lamp", "in lighting.lights:", "in lighting.lights[:1]:",
     "Only the first lamp shines: the sum is over all of lighting's lights."),
    ("mean_of_lamps", "scale(spot * fall,", "scale(spot * fall / len(lighting.lights),",
     "The lamps are divided by their number: light adds up."),
    ("clamped", "return light", "return [min(1, c) for c in light]",
     "The sum is cut off at 1: return it as it is, a display cuts later."),
    ("gate_at_horizon", "if dot(N, L) > 0", "if dot(N, L) >= 0",
     "B is 0 where N.L is 0 as well, for a lamp at the horizon gives no light. Compare with >, not "
     "with >=."),
    ("exponent_of_lamp", "material.shininess)", "lamp.spot_exponent)",
     "The highlight has the exponent of the lamp, spot_exponent: n is the material's shininess."),
    ("cone_by_shininess", "lamp.spot_exponent)", "material.shininess)",
     "The cone has the material's shininess: its exponent is the lamp's spot_exponent."),
    ("lamp_ambient_without_k", AMBIENT, "light = add(light, lamp.ambient)",
     "I_La is added without k_a: the surface returns the share k_a of it."),
    ("highlight_undimmed", BOTH, "add(scale(spot * fall, diffuse), specular)",
     "Cone and distance dim the diffuse term alone: they stand before the bracket, for both."),
    ("diffuse_undimmed", BOTH, "add(diffuse, scale(spot * fall, specular))",
     "Cone and distance dim the highlight alone: they stand before the bracket, for both."),
    ("cone_cuts_ambient", AMBIENT, "light = add(light, scale(1 if spot else 0, mul("
                                   "material.ambient, lamp.ambient)))",
     "Outside of its cone a lamp adds no ambient light here: k_a I_La stands outside of cone and "
     "distance."),
    ("stops_at_cone", AMBIENT, "if not spot:\n            break\n        " + AMBIENT,
     "The first lamp that does not reach P ends the sum: go on with the next one."),
    ("stops_behind", AMBIENT, AMBIENT + "\n        if not B:\n            break",
     "The first lamp behind the surface ends the sum: go on with the next one."),
    ("distance_of_eye", "length(to)", "length(sub(eye, P))",
     "r is the distance to the eye: take that to the lamp."),
]


def terms(right, inputs):
    """Returns what right answers lose without a term, and what to say where it alone is wrong."""
    def without(start, end):
        return [0.0 if start <= k < end else x for k, x in enumerate(inputs)]
    whole = right(inputs)
    return [(sub(whole, right(without(start, end))), says) for start, end, says in TERMS]


def shown(inputs):
    """How many of the inputs mean something: lamps that are not lit do not."""
    return 26 + 20 * int(inputs[25])


def place(x, y):
    """The inputs of a place of the picture, or None."""
    N = ball(x, y)
    material = 3 * [0.02] + [0.1, 0.05, 0.03, 0.5, 0.3, 0.1, 0.5, 0.5, 0.5, 20] + 3 * [0.1]
    white = [2, -2, 2, 2, 1, -1, -1, 0.5, 2] + 3 * [0.2] + 6 * [2] + [1, 0, 0.05]
    blue = [2, 0, 2, -1, 0, -1, 0.3, 8, 0, 0.1, 0.3, 0, 1, 3, 0, 1, 3, 1, 0, 0.1]
    return N and [0, 0, 4, *N, *N] + material + white + blue + 20 * [0]


def color(out, x, y):
    """What an answer looks like there."""
    return out
