#!/bin/sh
# Processing.js 1.6.6: the highlight of directionalLight moves when its vector is made longer, although its diffuse light stays.
# Most would guess that the length of a direction counts for nothing, as in Processing and p5.js.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
command -v chromium >/dev/null && command -v npm >/dev/null || exit 77
npm install --silent --no-audit --no-fund --ignore-scripts --prefix "$T" processing-js@1.6.6 >/dev/null 2>&1 || exit 77
MODULES="$T/node_modules" python3 - <<'P'
import sys
sys.path.insert(0, 'examples/elsewhere/measure')
from web import pictures

def brightest(fill, specular, length):
    material = dict(fill=[fill] * 3, ambient=[0] * 3, specular=[specular] * 3, shininess=40)
    lamp = dict(at=(length, length, length, 0))
    return dict(program='processing', parallel=True, material=material, lamps=[lamp], size=100)

drawn = pictures('processing', [brightest(.8, 0, 1), brightest(.8, 0, 10), brightest(0, .9, 1), brightest(0, .9, 10)])
places = [max(range(len(p)), key=lambda k: p[k][1]) for p in drawn]
places = [(k % 100, k // 100) for k in places]
print('Processing.js 1.6.6, directions of length 1.7 and 17: diffuse light brightest at', places[:2], 'highlight at', places[2:])
sys.exit(not (abs(places[0][0] - places[1][0]) <= 1 and places[3][0] - places[2][0] >= 5))
P
