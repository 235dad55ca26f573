"""Programs that colour surfaces: matplotlib, Octave, gnuplot, GDAL (Debian: python3-matplotlib, octave, fonts-freefont-otf,
gnuplot-nox, gdal-bin, python3-numpy): python3 surfaces.py [NAME ...]

Those that shade planes get one plane for each pixel, tangent to the ball there.
"""
import os
from ball import *

def tangents(size=SIZE, parallel=True):
    """The normal at each pixel of positions(), parallel"""
    out = {}
    for x, y in positions():
        X, Y = HALF * (2 * (x + .5) / size - 1), HALF * (1 - 2 * (y + .5) / size)
        out[x, y] = (X, Y, math.sqrt(1 - X * X - Y * Y))
    return out

def spread(values, size):
    """A picture that has these grey values or colours, 0 .. 1, at positions()"""
    pixels = [(0, 0, 0)] * (size * size)
    for (x, y), v in values.items():
        rgb = v if isinstance(v, (tuple, list)) else (v, v, v)
        pixels[y * size + x] = tuple(min(255, max(0, int(255 * c + .5))) for c in rgb)
    return pixels

def once(materials, lamps):
    return every(materials, lamps, cameras=('parallel',))

def mplot3d_draw(case, size):
    import numpy
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    from mpl_toolkits.mplot3d import axes3d
    import matplotlib.pyplot as plt
    from matplotlib.colors import LightSource
    ax = plt.figure().add_subplot(projection='3d')
    at = tangents()
    m, normals = case.material, numpy.array(list(at.values()))
    light = LightSource(azdeg=m['azdeg'], altdeg=m['altdeg'])
    colors = ax._shade_colors(numpy.array(m['color']), normals, light)
    plt.close('all')
    return spread({p: tuple(c[:3]) for p, c in zip(at, colors)}, size)

def mplot3d():
    m = [dict(color=c, azdeg=a, altdeg=e) for c in (ORANGE, WHITE, BLUE) for a, e in ((225, 19.4712), (45, 45), (90, -30), (0, 80))]
    main('mplot3d', 'matplotlib 3.6.3 mplot3d (Debian python3-matplotlib 3.6.3-1+b1)', once(m, [[]]), mplot3d_draw)

def octave_values(m, at, normals):
    text = f'''graphics_toolkit gnuplot; f = figure('visible', 'off');
n = [{'; '.join(' '.join(f'{x:.9g}' for x in v) for v in normals)}]; out = zeros(rows(n), 1);
[x, y] = meshgrid(-1:1, -1:1);
for i = 1:rows(n)
  z = -(n(i, 1) * x + n(i, 2) * y) / n(i, 3);
  clf; axes(); view(0, 90); daspect([1 1 1]); hold on;
  h = surfl(x, y, z, [{' '.join(f'{v:.9g}' for v in at)}], [{m['ambient']} {m['diffuse']} {m['specular']} {m['shine']}]);
  c = get(h, 'cdata'); out(i) = c(2, 2);
end
printf('%.6f\\n', out);'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.m'), 'w').write(text)
        done = subprocess.run(['octave-cli', '--quiet', 'a.m'], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=200)
        # without a font its axes fail
        if done.returncode: raise SystemExit('octave-cli failed; it wants a font, as of fonts-freefont-otf')
        return [float(v) for v in done.stdout.split()[-len(normals):]]

def surfl_draw(case, size):
    at = tangents()
    values = octave_values(case.material, case.lamps[0]['at'][:3], list(at.values()))
    return spread(dict(zip(at, values)), size)

def surfl():
    m = [dict(ambient=.55, diffuse=.6, specular=.4, shine=10), dict(ambient=0, diffuse=.6, specular=.8, shine=30), dict(ambient=.2, diffuse=1, specular=0, shine=1)]
    lamps = directions() + [[dict(at=(0, 0, 1, 0))], [dict(at=(-1, 2, 3, 0))]]
    main('surfl', 'Octave 7.3.0 surfl (Debian octave 7.3.0-2)', once(m, lamps), surfl_draw)

def gnuplot_draw(case, size):
    m, big = case.material, 1000
    script = f'''set terminal png truecolor size {big},{big}; set output 'a.png'
unset key; unset border; unset tics; unset colorbox; set parametric; set isosamples 361,361; set samples 361
set view 0,0; set view equal xyz; set urange [0:2*pi]; set vrange [-pi/2:pi/2]; set xrange [-1:1]; set yrange [-1:1]; set zrange [-1:1]
set lmargin 0; set rmargin 0; set tmargin 0; set bmargin 0; set object 1 rectangle from screen 0,0 to screen 1,1 behind fillcolor rgb '#00ff00'
set pm3d depthorder lighting primary {m['primary']} specular {m['specular']}
splot sin(v),cos(v)*cos(u),cos(v)*sin(u) with pm3d fillcolor rgb '#{''.join('%02x' % round(255 * c) for c in m['color'])}' '''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.gp'), 'w').write(script)
        run_tool(['gnuplot', 'a.gp'], folder)
        run_tool(['sh', '-c', 'pngtopnm a.png > a.ppm'], folder)
        w, h, drawn = ppm(os.path.join(folder, 'a.ppm'))
    # where the ball is: gnuplot has margins of its own
    inside = [i for i, p in enumerate(drawn) if p != (0, 255, 0) and 5 < i % w < w - 5 and 5 < i // w < h - 5]
    xs, ys = [i % w for i in inside], [i // w for i in inside]
    cx, cy, r = (min(xs) + max(xs) + 1) / 2, (min(ys) + max(ys) + 1) / 2, (max(xs) - min(xs) + 1) / 2
    out = [(0, 0, 0)] * (size * size)
    for j in range(size):
        for i in range(size):
            X, Y = HALF * (2 * (i + .5) / size - 1), HALF * (1 - 2 * (j + .5) / size)
            if X * X + Y * Y < 1: out[j * size + i] = drawn[int(cy - r * Y) * w + int(cx + r * X)]
    return out

def gnuplot():
    m = [dict(color=c, primary=p, specular=s) for c, p, s in
         ((ORANGE, .5, 0), (ORANGE, .5, .2), (ORANGE, 1, .3), (WHITE, .6, .8), (WHITE, .3, .1), (WHITE, .8, .4), (BLUE, .5, .5), (BLUE, 1, 0), (BLUE, .7, .2), (BLUE, 0, .5), (ORANGE, .9, .5))]
    main('gnuplot', 'gnuplot 5.4.4 pm3d (Debian gnuplot-nox 5.4.4+dfsg1-2+b2)', once(m, [[]]), gnuplot_draw, head='within 4.6\n',
         ball=Case('parallel', dict(color=WHITE, primary=.6, specular=.8), []))

def gdal_draw(case, size):
    m, at = case.material, tangents()
    rows = [' '.join(f'{-(n[0] * x + n[1] * y) / n[2]:.9g}' for n in at.values() for x in (-1, 0, 1)) for y in (1, 0, -1)]
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.asc'), 'w').write(f'ncols {3 * len(at)}\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n' + '\n'.join(rows) + '\n')
        run_tool(['gdaldem', 'hillshade', 'a.asc', 'a.tif', '-az', str(m['azimuth']), '-alt', str(m['altitude']), '-q'], folder)
        run_tool(['gdal_translate', '-q', '-of', 'AAIGrid', 'a.tif', 'b.asc'], folder)
        lines = [l.split() for l in open(os.path.join(folder, 'b.asc'))]
    middle = [l for l in lines if len(l) == 3 * len(at)][1]
    return spread({p: int(middle[3 * i + 1]) / 255 for i, p in enumerate(at)}, size)

def gdal():
    m = [dict(azimuth=a, altitude=e) for a in (315, 45, 90, 200) for e in (45, 10, 80)]
    main('gdal', 'GDAL 3.6.2, gdaldem hillshade (Debian gdal-bin 3.6.2+dfsg-1+b2)', once(m, [[]]), gdal_draw)

if __name__ == '__main__':
    names = [a for a in sys.argv[1:] if not a.startswith('-')]
    for program in (mplot3d, surfl, gnuplot, gdal):
        if not names or program.__name__ in names: program()
