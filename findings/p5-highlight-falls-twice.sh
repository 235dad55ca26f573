#!/bin/sh
# p5.js 1.11.13: the highlight of a pointLight falls with the square of lightFalloff, its diffuse light once.
# Most would guess that both fall alike, as with a spotLight of the same library.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
command -v chromium >/dev/null && command -v npm >/dev/null || exit 77
npm install --silent --no-audit --no-fund --ignore-scripts --prefix "$T" p5@1.11.13 >/dev/null 2>&1 || exit 77
MODULES="$T/node_modules" python3 - <<'P'
import sys
sys.path.insert(0, 'examples/elsewhere/measure')
from web import pictures

def brightest(fill, specular, constant):
    material = dict(fill=[fill] * 3, specular=[specular] * 3, shininess=10)
    lamp = dict(at=(0, 0, 3, 1), attenuation=(constant, 0, 0))
    return max(p[1] for p in pictures('p5', [dict(program='p5', parallel=True, material=material, lamps=[lamp], size=64)])[0])

diffuse = [brightest(.8, 0, c) for c in (1, 2)]
highlight = [brightest(0, .4, c) for c in (1, 2)]
print('p5.js 1.11.13, falloff 1 and 2: diffuse', diffuse, 'highlight', highlight)
print('diffuse light halves, the highlight falls to a quarter')
sys.exit(not (abs(diffuse[0] / diffuse[1] - 2) < .05 and abs(highlight[0] / highlight[1] - 4) < .1))
P
