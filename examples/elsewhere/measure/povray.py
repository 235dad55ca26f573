"""POV-Ray 3.7 (Debian: povray)"""
import os, tempfile
from ball import *

def vector(v): return '<' + ','.join(f'{x:.7g}' for x in v[:3]) + '>'

def finish(m):
    word = 'albedo ' if m.get('albedo') else ''
    text = f"ambient {m.get('ambient', .1)} diffuse {word}{m.get('diffuse', .6)}"
    if 'brilliance' in m: text += f" brilliance {m['brilliance']}"
    if 'phong' in m: text += f" phong {word}{m['phong']} phong_size {m['phong_size']}"
    if 'specular' in m: text += f" specular {word}{m['specular']} roughness {m['roughness']}"
    return text

def light(l):
    at, text = l['at'], ''
    where = [1e5 * x for x in at[:3]] if at[3] == 0 else at
    if l.get('shadowless'): text += ' shadowless'
    if 'fade_distance' in l: text += f" fade_distance {l['fade_distance']} fade_power {l['fade_power']}"
    if 'radius' in l:
        text += f" spotlight radius {l['radius']} falloff {l['falloff']} tightness {l.get('tightness', 0)}"
        text += f" point_at {vector([a + b for a, b in zip(at, l['aim'])])}"
    # z is turned: POV-Ray's world is left-handed; the camera below is right-handed
    return f"light_source {{ {vector(where)} rgb {vector(l.get('color', (1, 1, 1)))}{text} }}"

def draw(case, size):
    camera = (f'camera {{ orthographic location <0,0,5> direction <0,0,-1> right <{2 * HALF},0,0> up <0,{2 * HALF},0> }}'
              if case.parallel else
              f'camera {{ perspective location <0,0,5> direction <0,0,-1> right <{2 * math.tan(math.radians(FOVY / 2))},0,0>'
              f' up <0,{2 * math.tan(math.radians(FOVY / 2))},0> }}')
    scene = f'''#version 3.7; global_settings {{ assumed_gamma 1 }} {camera}
{' '.join(light(l) for l in case.lamps)}
sphere {{ <0,0,0>, 1 pigment {{ rgb {vector(case.material['color'])} }} finish {{ {finish(case.material)} }} no_shadow }}'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.pov'), 'w').write(scene)
        run_tool(['povray', '+Ia.pov', '+Oa.ppm', '+FP8', f'+W{size}', f'+H{size}', '-D', '-A', '-P', '+WT1', '-GA'], folder)
        return ppm(os.path.join(folder, 'a.ppm'))[2]

phong = [dict(color=ORANGE, diffuse=.6, phong=.3, phong_size=10),
         dict(color=WHITE, ambient=0, diffuse=.6, phong=.8, phong_size=30),
         dict(color=BLUE, ambient=.2, diffuse=.7, specular=.5, roughness=.01)]
cases = every(phong, directions())
cases += every([dict(color=ORANGE, diffuse=.6, brilliance=2, albedo=1, phong=.02, phong_size=20),
                dict(color=WHITE, diffuse=.6, brilliance=.5, specular=.05, roughness=.05, albedo=1)], [[dict(at=KEY)]])
cases += every(phong[:1], [[dict(at=(2, 1.5, 2.5, 1), fade_distance=2, fade_power=2)],
                           [dict(at=(2, 1.5, 2.5, 1), fade_distance=2, fade_power=3)],
                           [dict(at=(2, 1.5, 2.5, 1), shadowless=1)],
                           [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), radius=8, falloff=20, tightness=4)]])
main('povray', 'POV-Ray 3.7.0.10 (Debian povray 1:3.7.0.10-2+b2)', cases, draw, lamp='povray_lamp',
     ball=Case('parallel', dict(color=WHITE, ambient=0, diffuse=.6, phong=.8, phong_size=30), [dict(at=KEY)]))
