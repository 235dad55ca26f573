"""seen.js 0.2.7 (npm install seen@0.2.7), in Node.js: MODULES=DIR/node_modules python3 seen.py

Its surfaces are flat: each pixel is a face that is tangent to the ball there.
"""
import json, os
from ball import *
from surfaces import once, spread, tangents

SCRIPT = '''const seen = require(process.argv[1]), [m, lamps, normals] = JSON.parse(process.argv[2])
const color = c => new seen.Color(...c.map(x => 255 * x))
const material = new seen.Material(color(m.color), { specularColor: color(m.specularColor), specularExponent: m.specularExponent })
const lights = lamps.map(l => seen.Lights.directional({ normal: seen.P(...l.at.slice(0, 3)).normalize(), intensity: l.color[0], color: new seen.Color(255, 255, 255) }))
for (const l of lights) l.render()
console.log(JSON.stringify(normals.map(n => {
    const c = seen.Shaders.phong().shade(lights, { normal: seen.P(...n), barycenter: seen.P(...n) }, material)
    return [c.r, c.g, c.b].map(x => x / 255)
})))'''

def draw(case, size):
    at = tangents()
    seen = next(p for p in (os.path.join(os.environ['MODULES'], 'seen', 'dist', 'latest', 'seen.js'), os.path.join(os.environ['MODULES'], 'seen', 'dist', '0.2.7', 'seen.js')) if os.path.exists(p))
    got = json.loads(run_tool(['node', '-e', SCRIPT, seen, json.dumps([case.material, case.lamps, list(at.values())])], HERE))
    return spread({p: tuple(v) for p, v in zip(at, got)}, size)

m = [dict(color=ORANGE, specularColor=WHITE, specularExponent=15), dict(color=(.6, .6, .6), specularColor=(.5, .5, .5), specularExponent=8),
     dict(color=BLUE, specularColor=(1, .5, .2), specularExponent=5)]
cases = once(m, [[dict(at=at, color=(i,) * 3)] for at in DIRECTIONS + [(0, 0, 1, 0)] for i in (.002, .0035)])
main('seen', 'seen.js 0.2.7 (npm)', cases, draw, head='ambient 0\n')
