"""solution.py - the project in Python, solved with NumPy.  Students do not get it."""
import numpy as np

from scene import (BUMP, FLAT, GOURAUD, HEIGHT, MAP, SHADOW, SHADOW_MAP, SILHOUETTES, WIDTH)

P_, N_, C_, UV, T_ = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 11), slice(11, 14)


def unit(v):
    """Rows made unit."""
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-20)


def dot(a, b):
    """Products of rows, a column."""
    return np.sum(a * b, axis=-1, keepdims=True)


def look_at(eye, at, up):
    """The camera's matrix."""
    z = unit(eye - at)
    x = unit(np.cross(up, z))
    m = np.eye(4)
    m[:3, :3] = x, np.cross(z, x), z
    m[:3, 3] = -m[:3, :3] @ eye
    return m


def perspective(fovy, aspect, n, f):
    """The projection."""
    k = 1 / np.tan(fovy / 2)
    return np.array([[k / aspect, 0, 0, 0], [0, k, 0, 0],
                     [0, 0, (f + n) / (n - f), 2 * f * n / (n - f)], [0, 0, -1, 0]])


def through(m, p):
    """m (p, 1) for rows p."""
    return np.hstack([p, np.ones((len(p), 1))]) @ m.T


def light(s, P, N, visible=1):
    """Iterations zero to four for rows of points and normals."""
    m = s.material
    out = np.tile(m.emission, (len(P), 1))
    if s.iteration >= 1:
        out = out + m.ambient * s.ambient
    if s.iteration < 2:
        return out
    V = unit(s.eye - P)
    for k, lamp in enumerate(s.lamps if s.iteration == 4 else s.lamps[:1]):
        to = lamp.position - P
        r = np.linalg.norm(to, axis=1, keepdims=True)
        L = to / r
        amount = visible if k == 0 else 1
        if s.iteration == 4:
            out = out + m.ambient * lamp.ambient
            LS = dot(L, -unit(lamp.spot_direction))
            cone = np.where(LS >= lamp.spot_cos_cutoff, np.maximum(0, LS) ** lamp.spot_exponent, 0)
            amount = amount * cone / (lamp.constant + lamp.linear * r + lamp.quadratic * r * r)
        NL = dot(N, L)
        add = m.diffuse * lamp.diffuse * NL
        if s.iteration >= 3:
            H = unit(L + V)
            add = add + m.specular * lamp.specular * np.maximum(0, dot(N, H)) ** m.shininess
        out = out + np.where(NL > 0, amount * add, 0)
    return out


def bilinear(texels, u, v):
    """The mean of four texels."""
    size = len(texels)
    x, y = u * size - 0.5, v * size - 0.5
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - i)[:, None], (y - j)[:, None]
    at = lambda a, b: texels[b % size, a % size]
    return ((1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
            t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1)))


def visible(s, shadow, P):
    """1 where lamp 0 sees a point, 0 in shadow."""
    c = through(s.lamp_camera, P)
    u, v, z = (c[:, 0] / c[:, 3] + 1) / 2, (1 - c[:, 1] / c[:, 3]) / 2, (c[:, 2] / c[:, 3] + 1) / 2
    inside = (c[:, 3] > 0) & (u >= 0) & (u < 1) & (v >= 0) & (v < 1)
    i = np.clip((u * SHADOW_MAP).astype(int), 0, SHADOW_MAP - 1)
    j = np.clip((v * SHADOW_MAP).astype(int), 0, SHADOW_MAP - 1)
    return np.where(inside & (z > shadow[j, i] + s.bias), 0, 1)[:, None]


def color(s, v, level, shadow):
    """Colours of pixels, from rows of interpolated values."""
    P, N = v[:, P_], unit(v[:, N_])
    if s.checkpoint == 4 and s.shading > GOURAUD:
        return light(s, P, N)
    if s.checkpoint == 5:
        maps = [s.map]
        while len(maps[-1]) > 1:
            m = maps[-1]
            maps.append((m[::2, ::2] + m[1::2, ::2] + m[::2, 1::2] + m[1::2, 1::2]) / 4)
        level = min(level, 4)
        low = int(level)
        a, b = (bilinear(m, v[:, 9], v[:, 10]) for m in (maps[low], maps[min(4, low + 1)]))
        return a + (level - low) * (b - a)
    if s.checkpoint == 6 and s.option == SHADOW:
        return light(s, P, N, visible(s, shadow, P))
    if s.checkpoint == 6 and s.option == BUMP:
        n = 2 * bilinear(s.map, v[:, 9], v[:, 10]) - 1
        T = v[:, T_]
        T = unit(T - dot(N, T) * N)
        return light(s, P, unit(n[:, :1] * T + n[:, 1:2] * np.cross(N, T) + n[:, 2:] * N))
    if s.checkpoint == 6 and s.option == SILHOUETTES:
        cool, warm = np.array([0.4, 0.4, 0.7]), np.array([0.8, 0.6, 0.6])
        L = unit(s.lamps[0].position - P)
        return s.material.emission + cool + (1 + dot(N, L)) / 2 * (warm - cool)
    return v[:, C_]


def window(clip, width, height):
    """X, Y and depth of rows in clip space."""
    ndc = clip[:, :3] / clip[:, 3:]
    return np.stack([(ndc[:, 0] + 1) * width / 2, (1 - ndc[:, 1]) * height / 2, (ndc[:, 2] + 1) / 2], 1)


def clipped(clip, values):
    """The part of a triangle in front of the near plane, as triangles."""
    kept = []
    for k in range(3):
        a, b = k, (k + 1) % 3
        da, db = clip[a, 2] + clip[a, 3], clip[b, 2] + clip[b, 3]
        if da >= 0:
            kept.append((clip[a], values[a]))
        if (da >= 0) != (db >= 0):
            t = da / (da - db)
            kept.append((clip[a] + t * (clip[b] - clip[a]), values[a] + t * (values[b] - values[a])))
    for k in range(2, len(kept)):
        yield tuple(np.array(x) for x in zip(kept[0], kept[k - 1], kept[k]))


def triangle(clip, values, depth, test, shade, picture):
    """Draws a triangle; shade gives colours of rows of values, and is None for depth alone."""
    height, width = depth.shape
    at, w = window(clip, width, height), clip[:, 3]
    low = np.floor(np.maximum(at[:, :2].min(0), 0)).astype(int)
    high = np.ceil(np.minimum(at[:, :2].max(0), (width, height))).astype(int)
    if (low >= high).any():
        return
    j, i = (x.ravel() for x in np.mgrid[low[1]:high[1], low[0]:high[0]])
    x, y = i + 0.5, j + 0.5
    (x0, y0), (x1, y1), (x2, y2) = at[:, :2]
    whole = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if whole == 0:
        return
    a = ((x1 - x) * (y2 - y) - (x2 - x) * (y1 - y)) / whole
    b = ((x2 - x) * (y0 - y) - (x0 - x) * (y2 - y)) / whole
    abc = np.stack([a, b, 1 - a - b], 1)
    z = abc @ at[:, 2]
    inside = (abc >= 0).all(1)
    if test:
        inside &= z < depth[j, i]
    i, j, abc = i[inside], j[inside], abc[inside]
    depth[j, i] = z[inside]
    if shade and len(i):
        over = abc / w
        picture[j, i] = shade((over @ values) / over.sum(1, keepdims=True))


def draw(s, camera, depth, test, shade, picture):
    """Draws all triangles."""
    normals = np.linalg.inv(s.model[:3, :3]).T
    P = through(s.model, s.position)[:, :3]
    N, T = unit(s.normal @ normals.T), unit(s.tangent @ s.model[:3, :3].T)
    colors = light(s, P, N) if s.checkpoint == 4 and s.shading == GOURAUD else s.color
    values, clip = np.hstack([P, N, colors, s.uv, T]), through(camera, P)
    for face in s.triangles:
        some = values[face].copy()
        if s.checkpoint == 4 and s.shading == FLAT:
            n = unit(np.cross(P[face[1]] - P[face[0]], P[face[2]] - P[face[0]]))
            some[:, C_] = light(s, P[face].mean(0)[None], n[None])
        for part in clipped(clip[face], some):
            triangle(*part, depth, test, shade, picture)


def dot_at(s, camera, P, colors, picture):
    """A pixel for each point that is between near and far."""
    clip = through(camera, P)
    at = window(clip, WIDTH, HEIGHT)
    for (x, y, z), w, c in zip(at, clip[:, 3], colors):
        if w > 0 and 0 <= z <= 1 and 0 <= x < WIDTH and 0 <= y < HEIGHT:
            picture[int(y), int(x)] = c


def silhouettes(s, camera, picture):
    """Marks the ends of edges between a face that is seen and one that is not."""
    P = through(s.model, s.position)[:, :3]
    corners = P[s.triangles]
    normals = unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    edges = {}
    for k, face in enumerate(s.triangles):
        for j in range(3):
            a, b = (tuple(np.round(s.position[face[(j + n) % 3]], 4) + 0.0) for n in (0, 1))
            edges[a, b] = k, face[j], face[(j + 1) % 3]
    for (a, b), (k, i, j) in edges.items():
        if (b, a) in edges:
            e = s.eye - P[i]
            if (e @ normals[k]) * (e @ normals[edges[b, a][0]]) <= 0:
                dot_at(s, camera, P[[i, j]], np.zeros((2, 3)), picture)


def render(s, picture):
    """Draws the scene."""
    camera = perspective(s.fovy, WIDTH / HEIGHT, s.near_z, s.far_z) @ look_at(s.eye, s.at, s.up)
    if s.checkpoint == 1:
        dot_at(s, camera, through(s.model, s.position)[:, :3], s.color, picture)
        return
    level, shadow = 0, np.ones((SHADOW_MAP, SHADOW_MAP))
    if s.checkpoint == 6 and s.option == SHADOW:
        draw(s, s.lamp_camera, shadow, True, None, None)
    if s.mipmaps:
        face = s.triangles[0]
        at = window(through(camera, through(s.model, s.position[face])[:, :3]), WIDTH, HEIGHT)
        area = lambda p: abs(np.linalg.det(np.array([p[1] - p[0], p[2] - p[0]])))
        level = max(0, 0.5 * np.log2(area(s.uv[face]) * MAP * MAP / area(at[:, :2])))
    draw(s, camera, np.ones((HEIGHT, WIDTH)), s.checkpoint >= 3,
         lambda v: color(s, v, level, shadow), picture)
    if s.checkpoint == 6 and s.option == SILHOUETTES:
        silhouettes(s, camera, picture)
