"""OpenGL's fixed function (Debian: libosmesa6-dev, gcc), by gl.c"""
import os
from ball import *

folder = tempfile.TemporaryDirectory()
program = os.path.join(folder.name, 'gl')
run_tool(['cc', '-O2', '-w', os.path.join(HERE, 'gl.c'), '-lOSMesa', '-lm', '-o', program], HERE)

def draw(case, size):
    m, l = case.material, case.lamps[0]
    n = [size, int(case.parallel), *m['ambient'], *m['diffuse'], *m['specular'], *m.get('emission', (0, 0, 0)), m['shininess'], m['local_viewer'],
         *l['at'], *l.get('attenuation', (1, 0, 0)), *l.get('aim', (0, 0, -1)), l.get('cutoff', 180), l.get('exponent', 0), 0, 0]
    done = subprocess.run([program], input=' '.join(map(str, n)).encode(), stdout=subprocess.PIPE, check=True).stdout
    return [tuple(done[3 * i:3 * i + 3]) for i in range(size * size)]

m = [dict(ambient=(.1, .05, .02), diffuse=(.6, .3, .12), specular=(.3, .3, .3), shininess=10, local_viewer=0),
     dict(ambient=(0, 0, 0), diffuse=(.6, .6, .6), specular=(.8, .8, .8), shininess=30, local_viewer=1),
     dict(ambient=(.1, .1, .1), diffuse=(.14, .28, .63), specular=(.5, .4, .3), emission=(.04, .08, .18), shininess=100, local_viewer=1)]
lamps = [[dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .05))], [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), cutoff=20, exponent=8)]]
main('opengl', 'OpenGL fixed function, Mesa 22.3.6 (Debian libosmesa6 22.3.6-1+deb12u2)', every(m, directions()) + every(m[:2], lamps), draw,
     ball=Case('parallel', m[1], [dict(at=KEY)]))
