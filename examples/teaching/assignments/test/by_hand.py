"""Each assignment solved as a student does."""
import math


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(dot(v, v))
    return [x / length for x in v]


def lambert(N, L):
    return max(0, dot(N, L))


def mirror(L, N):
    return [2 * dot(N, L) * n - l for n, l in zip(N, L)]


def halfway(L, V):
    H = [l + v for l, v in zip(L, V)]
    return unit(H) if dot(H, H) > 1e-12 else [0, 0, 0]


def phong(N, L, V, n):
    if dot(N, L) <= 0:
        return 0
    return max(0, dot(mirror(L, N), V)) ** n


def attenuation(a, b, c, r):
    return 1 / (a + b * r + c * r ** 2)


def spot(L, aim, cos_cutoff, e):
    cosine = -dot(L, unit(aim))
    return max(0, cosine) ** e if cosine >= cos_cutoff else 0


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def normal_matrix(model):
    x, y, z = model[0:3], model[4:7], model[8:11]
    sign = math.copysign(1, dot(x, cross(y, z)))
    return [[sign * e for e in c] for c in (cross(y, z), cross(z, x), cross(x, y))]


def covers(x, y, i, j):
    area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])
    corners = list(zip(x, y)) if area > 0 else list(zip(x, y))[::-1]
    for k in range(3):
        (ax, ay), (bx, by) = corners[k], corners[(k + 1) % 3]
        edge = (bx - ax) * (256 * j + 128 - ay) - (by - ay) * (256 * i + 128 - ax)
        top_left = by < ay or (by == ay and bx > ax)
        if edge < 0 or (edge == 0 and not top_left):
            return False
    return area != 0


def depth_at(w, z, abc):
    return (sum(c * b / a for a, b, c in zip(w, z, abc)) + 1) / 2


def texture_at(w, uv, abc):
    over = [c / a for a, c in zip(w, abc)]
    return [sum(o * t[k] for o, t in zip(over, uv)) / sum(over) for k in (0, 1)]


def iteration_four(lighting, material, eye, P, N):
    V = unit([e - p for e, p in zip(eye, P)])
    out = [e + a * i for e, a, i in zip(material.emission, material.ambient, lighting.ambient)]
    for lamp in lighting.lights:
        to = [q - p for q, p in zip(lamp.position, P)]
        L, r = unit(to), math.sqrt(dot(to, to))
        arrives = (attenuation(lamp.constant, lamp.linear, lamp.quadratic, r) *
                   spot(L, lamp.spot_direction, lamp.spot_cos_cutoff, lamp.spot_exponent))
        for k in range(3):
            out[k] += material.ambient[k] * lamp.ambient[k]
            if dot(N, L) > 0:
                lobe = max(0, dot(N, halfway(L, V))) ** material.shininess
                out[k] += arrives * (material.diffuse[k] * lamp.diffuse[k] * dot(N, L) +
                                     material.specular[k] * lamp.specular[k] * lobe)
    return out


def color_at(x, y, color, px, py):
    area = [(x[a] - px) * (y[b] - py) - (x[b] - px) * (y[a] - py) for a, b in ((1, 2), (2, 0), (0, 1))]
    return [sum(a * c[k] for a, c in zip(area, color)) / sum(area) for k in range(3)]


def level(du_dx, dv_dx, du_dy, dv_dy, size):
    crossed = size * max(math.hypot(du_dx, dv_dx), math.hypot(du_dy, dv_dy))
    return 0 if crossed <= 1 else min(math.log2(crossed), math.log2(size))


def bilinear(texel, u, v):
    x, y = 4 * u - 0.5, 4 * v - 0.5
    out = 0
    for j in (math.floor(y), math.floor(y) + 1):
        for i in (math.floor(x), math.floor(x) + 1):
            out += (1 - abs(x - i)) * (1 - abs(y - j)) * texel[4 * (j % 4) + i % 4]
    return out


def clip_near(corners):
    kept = []
    for a, b in zip([corners[2], corners[0], corners[1]], corners):
        da, db = a[2] + a[3], b[2] + b[3]
        if (da >= 0) != (db >= 0):
            kept.append([p + da / (da - db) * (q - p) for p, q in zip(a, b)])
        if db >= 0:
            kept.append(b)
    return kept


def bumped(N, T, texel):
    n = [2 * c - 1 for c in texel]
    T = unit([t - dot(N, T) * m for t, m in zip(T, N)])
    return unit([n[0] * t + n[1] * b + n[2] * m for t, b, m in zip(T, cross(N, T), N)])


def lit(depth, lamp, P, bias):
    x, y, z, w = (lamp[k] * P[0] + lamp[4 + k] * P[1] + lamp[8 + k] * P[2] + lamp[12 + k]
                  for k in range(4))
    if w <= 0 or abs(x) > w or abs(y) > w:
        return True
    column, row = int(2 * (x / w + 1)), int(2 * (1 - y / w))
    return z / w / 2 + 0.5 <= depth[4 * min(3, row) + min(3, column)] + bias
