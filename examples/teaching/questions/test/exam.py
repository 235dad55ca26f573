#!/usr/bin/env python3
"""Tests of exam sheets: each line against its formula in double precision, the pixel of the picture, the
letters of the courses, and that the sheet without values has none."""
import math
import re
import sys
import tempfile
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import exam  # noqa: E402

passed, failed = 0, 0


def count(good, says):
    """Counts a check, and tells of one that fails."""
    global passed, failed
    passed, failed = passed + bool(good), failed + (not good)
    if not good:
        print(f"FAIL      {says}")


def dot(a, b):
    """Returns a.b."""
    return math.fsum(x * y for x, y in zip(a, b))


def unit(v):
    """Returns v / |v|."""
    return [x / math.sqrt(dot(v, v)) for x in v]


def sub(a, b):
    """Returns a - b."""
    return [x - y for x, y in zip(a, b)]


def lines(rows):
    """Returns all numbers of a sheet as the formulas give them, from what the sheet gives."""
    E, P, kd, ks, n = rows["E"], rows["P"], rows["kd"], rows["ks"], rows["n"]
    N, V = unit(P), unit(sub(E, P))
    ambient = [k * i for k, i in zip(kd, rows["Ia"])]
    out, total = {"N": N, "V": V, "ambient": ambient, "lamps": []}, list(ambient)
    for lamp in rows["lamps"]:
        to = sub(lamp["place"], P)
        r, L = math.sqrt(dot(to, to)), unit(to)
        H = unit([a + b for a, b in zip(L, V)])
        own = {"r": r, "L": L, "NL": dot(N, L), "H": H, "NH": dot(N, H), "power": max(0, dot(N, H)) ** n,
               "f": 1 / (lamp["a"] + lamp["b"] * r + lamp["c"] * r * r)}
        arrives = own["f"]
        if "S" in lamp:
            own["LS"] = dot(L, lamp["S"])
            own["cone"] = own["LS"] ** lamp["e"] if own["LS"] >= lamp["cosbeta"] else 0
            arrives *= own["cone"]
        lit = own["NL"] > 0
        own["diffuse"] = [arrives * k * i * max(0, own["NL"]) for k, i in zip(kd, lamp["light"])]
        own["specular"] = [arrives * k * i * own["power"] * lit for k, i in zip(ks, lamp["light"])]
        total = [t + d + s for t, d, s in zip(total, own["diffuse"], own["specular"])]
        out["lamps"].append(own)
    return {**out, "I": total}


def off(got, want):
    """Returns by how much numbers differ at most."""
    if isinstance(want, list):
        return max(off(g, w) for g, w in zip(got, want))
    return abs(got - want)


def pixel(path, i, j):
    """Returns the bytes of a pixel of a PNG."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, name = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        if name == b"IHDR":
            width = int.from_bytes(data[at + 8:at + 12], "big")
        packed += data[at + 8:at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    rows, above = zlib.decompress(packed), bytes(3 * width)
    for y in range(j + 1):
        begin = y * (3 * width + 1)
        kind, row = rows[begin], bytearray(rows[begin + 1:begin + 1 + 3 * width])
        for x, byte in enumerate(row):
            a, b, c = (row[x - 3] if x > 2 else 0), above[x], (above[x - 3] if x > 2 else 0)
            near = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[x] = byte + [0, a, b, (a + b) // 2, near][kind] & 255
        above = row
    return list(above[3 * i:3 * i + 3])


def encoded(light):
    """Returns a colour as codes of sRGB."""
    return [255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055)
            for c in (min(1, max(0, x)) for x in light)]


with tempfile.TemporaryDirectory() as folder:
    program, picture = exam.compiled(folder), Path(folder) / "scene.png"
    worst, lamps, cones, bright = 0, set(), set(), 0
    for seed in range(1, 41):
        rows = exam.numbers(program, seed, picture)
        want = lines(rows)
        names = [(name, rows[name], want[name]) for name in want if name != "lamps"]
        for lamp, own in zip(rows["lamps"], want["lamps"]):
            names += [(name, lamp[name], own[name]) for name in own]
            cones.add(lamp.get("cone", 1) > 0)
        count(len(rows["lamps"]) == len(want["lamps"]), f"seed {seed}: lamps")
        for name, got, right in names:
            worst = max(worst, off(got, right))
            count(off(got, right) < 2e-5, f"seed {seed}: {name} is {got}, not {right}")
        count(dot(rows["P"], rows["P"]) - 1 < 0.003, f"seed {seed}: P is on the ball")
        lamps.add(len(rows["lamps"]))
        got, right = pixel(picture, *map(int, rows["pixel"])), encoded(rows["I"])
        count(off(got, right) < 2.5, f"seed {seed}: the picture has {got} there, not {right}")
        bright += max(rows["lamps"][0]["specular"]) > 0.005
    count(lamps == {1, 2} and cones == {True, False}, "one lamp and two, within a cone and outside")
    count(bright > 20, f"{bright} of 40 pixels lie in a highlight")
    print(f"          worst of 40 sheets: {worst:.1e}")
    count(exam.numbers(program, 3, picture) != exam.numbers(program, 4, picture), "seeds differ")
    parts = exam.parts_of(exam.numbers(program, 5, picture))
    for course in exam.COURSES:
        of = exam.letters(course)
        asked, solved = (exam.latex(parts, s, of, "") for s in (False, True))
        computed = [line.value for part in parts for line in part.lines if not line.given]
        given = [line.value for part in parts for line in part.lines if line.given]
        count(all(f"${value}$" in solved for value in computed), f"{course}: solutions have all values")
        count(not any(f"${value}$" in asked for value in computed if value not in given),
              f"{course}: the sheet has none")
        count(all(f"${value}$" in asked for value in given), f"{course}: the sheet has what is given")
        for letter in "NLVH":
            own = of.get(letter, letter)
            count(rf"\mathbf{{{own}}}" in asked, f"{course}: {letter} is {own}")
            count(own == letter or rf"\mathbf{{{letter}}}" not in asked, f"{course}: no {letter} is left")
        count(re.search(rf"\^{re.escape(of.get('n', 'n'))}\$|\^{re.escape(of.get('n', 'n'))} ", asked),
              f"{course}: the exponent is {of.get('n', 'n')}")
        count(re.search(rf"{re.escape(of.get('k_s', 'k_s'))}(?![a-z])", asked), f"{course}: k_s has its letter")
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
