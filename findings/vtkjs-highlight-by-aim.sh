#!/bin/sh
# vtk.js 37.4.3: a positional light whose cone is wider than 90 degrees shines everywhere, and its highlight moves when the
# light is turned without being moved: R is that of the aim, not of the way from the light to the point.
# Most would guess what VTK does: the highlight depends on the position alone.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
command -v chromium >/dev/null && command -v npm >/dev/null || exit 77
npm install --silent --no-audit --no-fund --prefix "$T" @kitware/vtk.js@37.4.3 esbuild@0.25.12 >/dev/null 2>&1 || exit 77
MODULES="$T/node_modules" python3 - <<'P'
import sys
sys.path.insert(0, 'examples/elsewhere/measure')
from web import pictures

material = dict(color=(1, 1, 1), specular_color=(1, 1, 1), ambient=0, diffuse=0, specular=.9, power=40)
def brightest(aim):
    lamp = dict(at=(2, 1.5, 2.5, 1), aim=aim, cone=120)
    drawn = pictures('vtkjs', [dict(program='vtkjs', parallel=True, material=material, lamps=[lamp], size=100)])[0]
    i = max(range(len(drawn)), key=lambda k: drawn[k][1])
    return i % 100, i // 100

places = [brightest(aim) for aim in ((-2, -1.5, -2.5), (2, -1.5, -2.5))]
print('vtk.js 37.4.3, one place, aimed left and aimed right: brightest pixel', places)
sys.exit(not (places[0][0] > 55 and places[1][0] < 45))
P
