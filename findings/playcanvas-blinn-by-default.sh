#!/bin/sh
# PlayCanvas 2.23.3: the highlight of a StandardMaterial is (n + 2)/8 (N.H)^n of n = 2^(11 gloss), Blinn's, not GGX, unless
# enableGGXSpecular is set; at gloss .25 it is four times as bright in its middle as with it.
# Most would guess GGX, which an engine of physically based materials has everywhere else.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
command -v chromium >/dev/null && command -v npm >/dev/null || exit 77
npm install --silent --no-audit --no-fund --ignore-scripts --prefix "$T" playcanvas@2.23.3 >/dev/null 2>&1 || exit 77
MODULES="$T/node_modules" python3 - <<'P'
import sys
sys.path.insert(0, 'examples/elsewhere/measure')
from web import pictures

def case(gloss, ggx):
    material = dict(diffuse=[0] * 3, specular=[.5] * 3, gloss=gloss, ggx=ggx)
    return dict(program='playcanvas', parallel=True, material=material, lamps=[dict(at=(0, 0, 1, 0))], size=101)

drawn = pictures('playcanvas', [case(.25, 0), case(.25, 1), case(.5, 0), case(.5, 1)])
middle = [(p[50 * 101 + 50][1] / 255) ** 2.2 for p in drawn]
print('PlayCanvas 2.23.3, light in the middle: gloss .25', *('%.3f' % v for v in middle[:2]), 'gloss .5', *('%.3f' % v for v in middle[2:]), '(default, with enableGGXSpecular)')
want = .5 ** 2.2 * (2 ** 2.75 + 2) / 8
sys.exit(not (abs(middle[0] - want) < .01 and abs(middle[1] - want) > .05))
P
