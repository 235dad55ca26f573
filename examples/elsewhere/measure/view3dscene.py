"""view3dscene 4.2.0, of Castle Game Engine (Debian: view3dscene, netpbm, xvfb), on the display of DISPLAY

Guess before anything was drawn: as X_ITE, (N.H)^(128 shininess), V to the camera's point, but gated.
"""
import os
from ball import *

points, faces = mesh(120, 240)
LIST = ', '.join(f'{x:.6f} {y:.6f} {z:.6f}' for x, y, z in points)
INDEX = ' '.join(str(i) for f in faces for i in f)

def triple(v): return ' '.join(f'{x:.7g}' for x in v[:3])

def draw(case, size):
    m, l = case.material, case.lamps[0]
    if l['at'][3] == 0:
        lamp = f"DirectionalLight {{ direction {triple([-x for x in l['at']])} }}"
    elif 'aim' in l:
        lamp = (f"SpotLight {{ location {triple(l['at'])} direction {triple(l['aim'])} beamWidth {l['beamWidth']} "
                f"cutOffAngle {l['cutOffAngle']} radius 100 }}")
    else:
        lamp = f"PointLight {{ location {triple(l['at'])} attenuation {triple(l.get('attenuation', (1, 0, 0)))} radius {l.get('radius', 100)} }}"
    view = f'OrthoViewpoint {{ fieldOfView [ -{HALF} -{HALF} {HALF} {HALF} ]' if case.parallel else f'Viewpoint {{ fieldOfView {math.radians(FOVY)}'
    scene = f'''#X3D V3.2 utf8
PROFILE Interchange
COMPONENT Lighting:2
COMPONENT Navigation:3
NavigationInfo {{ headlight FALSE type "NONE" }}
{view} position 0 0 5 }}
{lamp}
Shape {{ appearance Appearance {{ material Material {{ diffuseColor {triple(m['diffuseColor'])} specularColor {triple(m['specularColor'])}
emissiveColor {triple(m.get('emissiveColor', (0, 0, 0)))} shininess {m['shininess']} ambientIntensity 0 }} }}
geometry IndexedTriangleSet {{ index [ {INDEX} ] coord Coordinate {{ point [ {LIST} ] }} normal Normal {{ vector [ {LIST} ] }} }} }}
'''
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, 'a.x3dv'), 'w').write(scene)
        run_tool(['view3dscene', 'a.x3dv', '--geometry', f'{size}x{size}', '--anti-alias', '0', '--screenshot', '0', 'a.png'], folder)
        return picture(os.path.join(folder, 'a.png'), size)

m = [dict(diffuseColor=(.6, .3, .12), specularColor=(.3, .3, .3), shininess=.08),
     dict(diffuseColor=(.6, .6, .6), specularColor=(.8, .8, .8), shininess=30 / 128),
     dict(diffuseColor=(.14, .28, .63), specularColor=(.5, .4, .3), shininess=.8, emissiveColor=(.04, .08, .18))]
lamps = [[dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))],
         [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), beamWidth=.15, cutOffAngle=.35)]]
main('view3dscene', 'view3dscene 4.2.0, Castle Game Engine (Debian view3dscene 4.2.0-1)', every(m, directions()) + every(m[:1], lamps), draw, lamp='x3d_lamp')
