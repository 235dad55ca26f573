"""Viewers of molecules: RasMol, Jmol (Debian: rasmol, jmol, netpbm): python3 molecules.py [NAME ...]

Guesses before anything was drawn, and what became of them:
  RasMol   32 steps of ambient + (1 - ambient) N.L, lamp along 1, 1, 2, white mixed in by (N.L)^n      n + 1, else right
  Jmol     the ramp, once seen: N.L 1.21 diffusePercent, white beyond 52 of 64                        right
"""
from ball import *

ATOM = 'HETATM    1  C1  UNK     1       0.000   0.000   0.000  1.00  0.00           C\n'

def cut_out(drawn, w, size):
    """The ball of a larger picture as the parallel camera shows it"""
    inside = [i for i, p in enumerate(drawn) if p != (0, 0, 0)]
    xs, ys = [i % w for i in inside], [i // w for i in inside]
    cx, cy, r = (min(xs) + max(xs) + 1) / 2, (min(ys) + max(ys) + 1) / 2, (max(xs) - min(xs) + 1) / 2
    out = [(0, 0, 0)] * (size * size)
    for j in range(size):
        for i in range(size):
            x, y = HALF * (2 * (i + .5) / size - 1), HALF * (1 - 2 * (j + .5) / size)
            if x * x + y * y < 1: out[j * size + i] = drawn[int(cy - r * y) * w + int(cx + r * x)]
    return out

def tint(c): return '[' + ','.join(str(round(255 * x)) for x in c) + ']'

def rasmol_draw(case, size):
    m = case.material
    said = f'''load pdb a.pdb
background black
wireframe off
spacefill 300
set ambient {m['ambient']}
set specular {'on' if m['specular'] else 'off'}
set specpower {m['specpower']}
colour {tint(m['color'])}
write ppm a.ppm
quit
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.pdb'), 'w').write(ATOM)
        run_tool(['/usr/lib/rasmol/rasmol.32', '-nodisplay'], folder, input=said.encode())
        w, h, drawn = ppm(os.path.join(folder, 'a.ppm'))
    return cut_out(drawn, w, size)

def rasmol():
    m = [dict(color=c, ambient=a, specular=s, specpower=n) for c, a, s, n in
         ((ORANGE, 40, 0, 10), (ORANGE, 20, 1, 4), (ORANGE, 5, 1, 30), (WHITE, 20, 0, 10), (WHITE, 40, 1, 10), (WHITE, 70, 1, 1),
          ((.6, .6, .6), 20, 1, 30), (BLUE, 20, 0, 1), (BLUE, 40, 1, 100), (BLUE, 60, 1, 10), (BLUE, 5, 1, 1))]
    main('rasmol', 'RasMol 2.7.6 (Debian rasmol 2.7.6.0-3)', every(m, [[]], cameras=('parallel',)), rasmol_draw, head='within 16\n')

def jmol_draw(case, size):
    m = case.material
    said = f'''load a.pdb; background black; spacefill 300; wireframe off; set perspectiveDepth off; set antialiasImages off; frank off;
set ambientPercent {m['ambientPercent']}; set diffusePercent {m['diffusePercent']}; set specular on; set specularPercent {m['specularPercent']};
set phongExponent {m['phongExponent']}; color {tint(m['color'])}; zoom 60; write image 600 600 PNG "a.png"; exitJmol;
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.pdb'), 'w').write(ATOM)
        open(os.path.join(folder, 'a.spt'), 'w').write(said)
        run_tool(['java', '-Djava.awt.headless=true', '-jar', '/usr/share/java/JmolData.jar', '-n', '-o', '-g600x600', '-s', 'a.spt'], folder)
        run_tool(['sh', '-c', 'pngtopnm a.png > a.ppm'], folder)
        w, h, drawn = ppm(os.path.join(folder, 'a.ppm'))
    return cut_out(drawn, w, size)

def jmol():
    m = [dict(color=c, ambientPercent=a, diffusePercent=d, specularPercent=s, phongExponent=n) for c, a, d, s, n in
         ((ORANGE, 45, 84, 22, 64), (ORANGE, 20, 60, 0, 64), (ORANGE, 0, 100, 0, 64), (WHITE, 45, 84, 22, 64), (WHITE, 10, 70, 30, 10),
          ((1, 0, 0), 45, 100, 0, 64), ((1, 0, 0), 20, 50, 50, 20), (BLUE, 45, 84, 22, 64), (BLUE, 30, 70, 40, 100), (BLUE, 10, 40, 40, 5), ((.6, .6, .6), 20, 80, 20, 30))]
    main('jmol', 'Jmol 14.32.83 (Debian jmol 14.32.83+dfsg-2)', every(m, [[]], cameras=('parallel',)), jmol_draw, head='within 16\n')

if __name__ == '__main__':
    names = [a for a in sys.argv[1:] if not a.startswith('-')]
    for program in (rasmol, jmol):
        if not names or program.__name__ in names: program()
