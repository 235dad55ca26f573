"""lit and light_at beside the equation in double precision."""
import numpy as np
import pytest

import shade_h as shade


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def equation(lighting, m, eye, points, normals):
    """Iteration four as the books have it, term by term."""
    n, v = unit(normals), unit(np.asarray(eye) - points)
    out = np.array(m.emission) + np.array(m.ambient) * lighting.ambient + 0 * points
    for lamp in lighting.lights:
        p = np.array(lamp.position)
        way = p[:3] - points if p[3] else np.broadcast_to(p[:3], points.shape)
        r, light = np.linalg.norm(way, axis=1), unit(way)
        fall = np.ones(len(points))
        if p[3] and (lamp.constant or lamp.linear or lamp.quadratic):
            fall = 1 / (lamp.constant + lamp.linear * r + lamp.quadratic * r * r)
        if np.any(lamp.spot_direction):
            cosine = -(light * unit(np.array(lamp.spot_direction))).sum(1)
            inside = cosine >= lamp.spot_cos_cutoff
            fall = fall * np.where(inside, np.maximum(cosine, 0) ** lamp.spot_exponent, 0)
        nl = (n * light).sum(1)
        if lighting.model == shade.Model.PHONG:
            lobe = ((2 * nl[:, None] * n - light) * v).sum(1)
        else:
            lobe = (n * unit(light + v)).sum(1)
        lobe = np.maximum(lobe, 0) ** m.shininess
        if not lighting.flags & shade.Flag.UNGATED_SPECULAR:
            lobe = np.where(nl > 0, lobe, 0)
        diffuse = np.outer(np.maximum(nl, 0), np.array(m.diffuse) * lamp.diffuse)
        out = out + np.array(m.ambient) * lamp.ambient
        out = out + fall[:, None] * (diffuse + np.outer(lobe, np.array(m.specular)
                                                        * lamp.specular))
    return out


MATERIAL = shade.Material((0.1, 0, 0), (0.2, 0.3, 0.1), (0.6, 0.5, 0.4), (0.3, 0.4, 0.5), 20)
LAMPS = [shade.Light.directional((-1, -2, -1), (1, 0.9, 0.8)),
         shade.Light.point((0, 3, 2), (0.5, 0.5, 1), (1, 0.1, 0.25)),
         shade.Light.spot((0, 4, 0), (0.1, -1, 0), 1.0, 8, (2, 2, 2))]


@pytest.mark.parametrize("lighting", [
    shade.uw(LAMPS), shade.massey(LAMPS, (0.2, 0.3, 0.4)), shade.berkeley(LAMPS),
    shade.shirley(LAMPS[0], (0.1, 0.2, 0.3))], ids=["uw", "massey", "berkeley", "shirley"])
@pytest.mark.parametrize("count", [1, 127, 128, 1001])
def test_every_point_is_lit_by_the_equation(lighting, count):
    random = np.random.default_rng(count)
    points, normals = random.normal(size=(count, 3)), random.normal(size=(count, 3))
    eye = (1.0, 2.0, 5.0)
    got = shade.lit(lighting, MATERIAL, eye, points, normals)
    wanted = equation(lighting, MATERIAL, eye, points, normals)
    wrong = np.abs(got - wanted).max(1) > 1e-4
    assert wrong.mean() < 0.01    # at the edges of cones and gates rounding may decide
    assert shade.lit(lighting, MATERIAL, eye, points[:0], normals[:0]).shape == (0, 3)


def test_light_at_tells_factor_direction_and_distance():
    points = np.random.default_rng(1).normal(size=(50, 3))
    amount, toward, distance = shade.light_at(LAMPS[1], points)
    way = np.array([0, 3, 2]) - points
    r = np.linalg.norm(way, axis=1)
    assert distance == pytest.approx(r, rel=1e-5)
    assert toward == pytest.approx(way / r[:, None], abs=1e-5)
    assert amount == pytest.approx(1 / (1 + 0.1 * r + 0.25 * r * r), rel=1e-4)


def test_presets_are_the_table_of_the_library():
    gold = shade.preset("gold", linear=False)
    assert gold.diffuse == pytest.approx((0.75164, 0.60648, 0.22648), abs=1e-6)
    assert gold.shininess == pytest.approx(51.2)
    assert len(shade.PRESETS) == 24 == len({shade.preset(n) for n in shade.PRESETS})
