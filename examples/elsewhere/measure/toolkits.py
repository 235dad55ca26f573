"""Libraries that C and C++ programs draw with, each by a program beside this file (Debian: gcc, g++,
libosmesa6-dev, and libcoin-dev, libopenscenegraph-dev, libmgl-dev, libirrlicht-dev):

    python3 toolkits.py [NAME ...] [--write]

Guesses before anything was drawn, and what became of them:
  Coin     OpenGL's (N.H)^(128 shininess), V the axis, at vertices                          right
  OSG      OpenGL's; its light model adds ambient light of .1                               right
  MathGL   exp(-3 (1 - R.V)), once seen; that brightness counts twice was not thought of
  Irrlicht N.L of directional lamps, once seen                                              right
"""
import shlex
from ball import *

folder = tempfile.TemporaryDirectory()
built = {}

def built_from(source, libraries):
    """The program made of a file beside this one; CPATH and LIBRARY_PATH tell the compiler more"""
    if source not in built:
        built[source] = os.path.join(folder.name, source.split('.')[0])
        compiler = 'cc' if source.endswith('.c') else 'c++'
        run_tool([compiler, '-O1', '-w', os.path.join(HERE, source), *shlex.split(libraries), '-lm', '-o', built[source]], HERE)
    return built[source]

def bytes_of(program, arguments, text):
    done = subprocess.run([program, *arguments], input=text.encode(), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True).stdout
    return [tuple(done[3 * i:3 * i + 3]) for i in range(len(done) // 3)]

def numbers(*values):
    return ' '.join(' '.join(map(str, v)) if isinstance(v, (tuple, list)) else str(v) for v in values)

def triple(v): return ' '.join(f'{x:.7g}' for x in v[:3])

points, faces = mesh(160, 320)
LIST = ', '.join(triple(p) for p in points)
INDEX = ', '.join(f'{a}, {b}, {c}, -1' for a, b, c in faces)

# Coin

def inventor_text(case):
    m, l = case.material, case.lamps[0]
    if l['at'][3] == 0:
        lamp = f"DirectionalLight {{ direction {triple([-x for x in l['at']])} }}"
    elif 'aim' in l:
        lamp = f"SpotLight {{ location {triple(l['at'])} direction {triple(l['aim'])} cutOffAngle {l['cutOffAngle']} dropOffRate {l['dropOffRate']} }}"
    else:
        lamp = f"PointLight {{ location {triple(l['at'])} }}"
    a = l.get('attenuation', (1, 0, 0))
    camera = f'OrthographicCamera {{ height {2 * HALF}' if case.parallel else f'PerspectiveCamera {{ heightAngle {math.radians(FOVY)}'
    return f'''#Inventor V2.1 ascii
Separator {{
{camera} position 0 0 5 nearDistance 1 farDistance 10 }}
Environment {{ attenuation {a[2]} {a[1]} {a[0]} }}
{lamp}
Material {{ ambientColor {triple(m['ambientColor'])} diffuseColor {triple(m['diffuseColor'])} specularColor {triple(m['specularColor'])}
emissiveColor {triple(m.get('emissiveColor', (0, 0, 0)))} shininess {m['shininess']} }}
Coordinate3 {{ point [ {LIST} ] }}
Normal {{ vector [ {LIST} ] }}
NormalBinding {{ value PER_VERTEX_INDEXED }}
IndexedFaceSet {{ coordIndex [ {INDEX} ] }}
}}
'''

def coin_draw(case, size):
    return bytes_of(built_from('coin.cpp', '-lOSMesa -lCoin'), [str(size)], inventor_text(case))

def inventor():
    m = [dict(ambientColor=(.2, .1, .04), diffuseColor=(.6, .3, .12), specularColor=(.3, .3, .3), shininess=.08),
         dict(ambientColor=(0, 0, 0), diffuseColor=(.6, .6, .6), specularColor=(.8, .8, .8), shininess=30 / 128),
         dict(ambientColor=(.5, .5, .5), diffuseColor=(.14, .28, .63), specularColor=(.5, .4, .3), shininess=.8, emissiveColor=(.04, .08, .18))]
    lamps = [[dict(at=(2, 1.5, 2.5, 1))], [dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))],
             [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), cutOffAngle=.35, dropOffRate=.15)]]
    main('inventor', 'Coin 4.0.0 (Debian libcoin-dev 4.0.0+ds-3), drawn by Mesa 22.3.6', every(m, directions()) + every(m[:1], lamps),
         coin_draw, lamp='inventor_lamp', head='ambient .2\n')

# OpenSceneGraph

def osg_draw(case, size):
    m, l = case.material, case.lamps[0]
    text = numbers(size, int(case.parallel), m['ambient'], m['diffuse'], m['specular'], m.get('emission', (0, 0, 0)), m['shininess'],
                   l['at'], l.get('attenuation', (1, 0, 0)), l.get('aim', (0, 0, -1)), l.get('cutoff', 0), l.get('exponent', 0))
    return bytes_of(built_from('osg.cpp', '-lOSMesa -losgViewer -losgUtil -losgGA -losg'), [], text)

def osg():
    m = [dict(ambient=(.5, .25, .1), diffuse=(.6, .3, .12), specular=(.3, .3, .3), shininess=10),
         dict(ambient=(0, 0, 0), diffuse=(.6, .6, .6), specular=(.8, .8, .8), shininess=30),
         dict(ambient=(.9, .9, .9), diffuse=(.14, .28, .63), specular=(.5, .4, .3), emission=(.04, .08, .18), shininess=100)]
    lamps = [[dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))], [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), cutoff=20, exponent=15)]]
    main('osg', 'OpenSceneGraph 3.6.5 (Debian libopenscenegraph-dev 3.6.5+dfsg1-8+b2), drawn by Mesa 22.3.6',
         every(m, directions()) + every(m[:1], lamps), osg_draw, head='ambient .1\n')

# MathGL

def mathgl_draw(case, size):
    big = 800
    m, l = case.material, case.lamps[0]
    drawn = bytes_of(built_from('mathgl.c', '-lmgl'), [], numbers(big, m['ambient'], m['color'], l['at'][:3], l.get('color', WHITE)[0] / 2))
    out = [(0, 0, 0)] * (size * size)
    for j in range(size):
        for i in range(size):
            x, y = HALF * (2 * (i + .5) / size - 1), HALF * (1 - 2 * (j + .5) / size)
            # the ball's radius is .3236 of the picture's width
            if x * x + y * y < 1: out[j * size + i] = drawn[int(big * (.4994 - .3236 * y)) * big + int(big * (.5006 + .3236 * x))]
    return out

def mathgl():
    m = [dict(color=ORANGE, ambient=.5), dict(color=(.6, .6, .6), ambient=0), dict(color=BLUE, ambient=.2), dict(color=WHITE, ambient=.1)]
    lamps = directions(color=(.4, .4, .4)) + directions()[:1]
    main('mathgl', 'MathGL 8.0.1 (Debian libmgl-dev 8.0.1-4+b4)', every(m, lamps, cameras=('parallel',)), mathgl_draw, head='within 8.5\n')

# Irrlicht

def irrlicht_draw(case, size):
    m, l = case.material, case.lamps[0]
    return bytes_of(built_from('irrlicht.cpp', '-lIrrlicht'), [], numbers(size, int(case.parallel), m['DiffuseColor'], m.get('EmissiveColor', (0, 0, 0)), l['at'][:3]))

def irrlicht():
    m = [dict(DiffuseColor=ORANGE), dict(DiffuseColor=(.6, .6, .6)), dict(DiffuseColor=BLUE, EmissiveColor=(.04, .08, .1))]
    main('irrlicht', "Irrlicht 1.8.5, Burning's Video (Debian libirrlicht-dev 1.8.5+ds2-1)", every(m, directions()), irrlicht_draw, head='within 2.7\n')

if __name__ == '__main__':
    names = [a for a in sys.argv[1:] if not a.startswith('-')]
    for program in (inventor, osg, mathgl, irrlicht):
        if not names or program.__name__ in names: program()
