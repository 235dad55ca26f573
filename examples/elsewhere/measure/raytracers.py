"""Tachyon, Raster3D, PyMOL (Debian: tachyon, raster3d, pymol): python3 raytracers.py [NAME ...]"""
import os, struct
from ball import *

def unit(v):
    n = math.sqrt(sum(x * x for x in v[:3]))
    return [x / n for x in v[:3]]

def triple(v): return ' '.join(f'{x:.7g}' for x in v[:3])

# Tachyon 0.99

def tachyon_draw(case, size, flags=()):
    m = case.material
    zoom = 1 / (2 * HALF) if case.parallel else .5 / math.tan(math.radians(FOVY / 2))
    lamps = ''
    for l in case.lamps:
        tint = triple(l.get('color', WHITE))
        if l['at'][3] == 0:
            lamps += f"directional_light direction {triple([-x for x in l['at']])} color {tint}\n"
        elif 'aim' in l:
            lamps += (f"spotlight center {triple(l['at'])} rad 0.001 direction {triple(l['aim'])} falloff_start {l['start']} "
                      f"falloff_end {l['end']} color {tint}\n")
        else:
            a = l.get('attenuation', (1, 0, 0))
            lamps += f"light center {triple(l['at'])} rad 0.001 attenuation constant {a[0]} linear {a[1]} quadratic {a[2]} color {tint}\n"
    view = 'projection orthographic\n' if case.parallel else ''
    scene = f'''begin_scene
resolution {size} {size}
camera
{view}zoom {zoom}
aspectratio 1
antialiasing 0
raydepth 1
center 0 0 5
viewdir 0 0 -1
updir 0 1 0
end_camera
{lamps}
background 0 0 0
sphere center 0 0 0 rad 1
texture ambient {m.get('ambient', 0)} diffuse {m['diffuse']} specular 0 opacity 1
phong plastic {m['phong']} phong_size {m['phong_size']} color {triple(m['color'])} texfunc 0
end_scene
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.dat'), 'w').write(scene)
        run_tool(['tachyon', 'a.dat', '-o', 'a.ppm', '-format', 'PPM', '-numthreads', '1', '-shadow_filter_off', *flags], folder)
        # its world is left-handed: x goes to the left of the picture
        pixels = ppm(os.path.join(folder, 'a.ppm'))[2]
        return [pixels[i - i % size + size - 1 - i % size] for i in range(size * size)]

def tachyon():
    m = [dict(color=ORANGE, ambient=.1, diffuse=.6, phong=.3, phong_size=10), dict(color=WHITE, diffuse=.6, phong=.8, phong_size=30),
         dict(color=BLUE, ambient=.2, diffuse=.7, phong=.5, phong_size=100)]
    lamps = [[dict(at=(2, 1.5, 2.5, 1))], [dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .05))], [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), start=8, end=20)]]
    main('tachyon', 'Tachyon 0.99 b6 (Debian tachyon 0.99~b6+dsx-10)', every(m, directions()) + every(m[:1], lamps), tachyon_draw,
         lamp='tachyon_lamp', head='shift -.5 -.5\n', ball=Case('parallel', m[1], [dict(at=KEY)]))

# Raster3D 3.0-7

def raster3d_draw(case, size):
    m, l = case.material, case.lamps[0]
    eye = 0 if case.parallel else 5
    # one unit of the picture is the half width with the scale of the matrix
    half = HALF if case.parallel else EYE[2] * math.tan(math.radians(FOVY / 2))
    head = f'''one ball
{size} {size} tiles
1 1 pixels of a tile
1 no anti-aliasing
0 0 0
F
{m['phong']}
{m['straight']}
{m['ambient']}
{m['specular']}
{eye / (2 * half) if eye else 0}
{triple(unit(l['at']))}
1 0 0 0
0 1 0 0
0 0 1 0
0 0 0 {2 * half}
3
*
*
*
2
0 0 0 1 {triple(m['color'])}
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.r3d'), 'w').write(head)
        with open(os.path.join(folder, 'a.r3d')) as text:
            done = subprocess.run(['render', '-png', 'a.png'], cwd=folder, stdin=text, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if not os.path.exists(os.path.join(folder, 'a.png')): raise SystemExit(done.stdout.decode())
        return picture(os.path.join(folder, 'a.png'), size)

def raster3d():
    m = [dict(color=ORANGE, phong=10, straight=.2, ambient=.1, specular=.3), dict(color=(.9, .9, .9), phong=30, straight=0, ambient=0, specular=.4),
         dict(color=BLUE, phong=100, straight=.5, ambient=.2, specular=.5)]
    main('raster3d', 'Raster3D 3.0-7 (Debian raster3d 3.0-7-2+b1)', every(m, directions()), raster3d_draw, head='flat\n',
         ball=Case('parallel', dict(color=WHITE, phong=30, straight=0, ambient=0, specular=.5), [dict(at=KEY)]))

# PyMOL 2.5.0

def pymol_draw(case, size):
    m, l = case.material, case.lamps[0]
    L = unit(l['at'])
    half = EYE[2] * math.tan(math.radians(FOVY / 2))
    fov = 2 * math.degrees(math.atan(HALF / 5)) if case.parallel else FOVY
    script = f'''
from pymol import cmd
cmd.pseudoatom('a', pos=[0, 0, 0], vdw=1)
cmd.hide('everything'); cmd.show('spheres')
cmd.set_color('tint', {list(m['color'])}); cmd.color('tint')
cmd.set('ray_shadows', 0); cmd.set('antialias', 0); cmd.set('ray_trace_fog', 0); cmd.set('depth_cue', 0)
cmd.set('light_count', 2); cmd.set('light', {[-x for x in L]}); cmd.set('ambient', {m['ambient']}); cmd.set('direct', {m['direct']})
cmd.set('reflect', {m['reflect']}); cmd.set('specular', 1); cmd.set('spec_count', 1)
cmd.set('specular_intensity', {m['specular_intensity']}); cmd.set('shininess', {m['shininess']})
cmd.set('spec_direct', 0); cmd.set('power', 1); cmd.set('reflect_power', 1); cmd.set('gamma', 1); cmd.set('ray_opaque_background', 1)
cmd.bg_color('black'); cmd.set('orthoscopic', {int(case.parallel)}); cmd.set('field_of_view', {fov})
cmd.set_view([1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -5, 0, 0, 0, 3, 8, {fov if case.parallel else -fov}])
cmd.ray({size}, {size}); cmd.png('a.png')
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.py'), 'w').write(script)
        run_tool([sys.executable, '-m', 'pymol', '-cqk', 'a.py'], folder)
        run_tool(['sh', '-c', 'pngtopnm a.png > a.ppm'], folder)
        return ppm(os.path.join(folder, 'a.ppm'))[2]

def pymol():
    m = [dict(color=ORANGE, ambient=.14, direct=.45, reflect=.45, specular_intensity=.3, shininess=10),
         dict(color=WHITE, ambient=0, direct=0, reflect=.5, specular_intensity=.8, shininess=30),
         dict(color=BLUE, ambient=.3, direct=.2, reflect=.6, specular_intensity=.5, shininess=55)]
    main('pymol', 'PyMOL 2.5.0, ray (Debian pymol 2.5.0+dfsg-1)', every(m, directions()), pymol_draw, head='within 4.1\n',
         ball=Case('parallel', dict(color=WHITE, ambient=0, direct=0, reflect=.6 * (1 + 1 / math.sqrt(3)) / 2, specular_intensity=.8, shininess=30), [dict(at=KEY)]))

if __name__ == '__main__':
    names = [a for a in sys.argv[1:] if not a.startswith('-')]
    for program in (tachyon, raster3d, pymol):
        if not names or program.__name__ in names: program()
