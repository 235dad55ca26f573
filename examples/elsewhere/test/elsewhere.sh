#!/bin/sh
# elsewhere.sh - the page examples/elsewhere/README.md beside the tables of pixels: each table has a row, each row that
# names a difference a table, and the difference is the measured one.  With LONG=1 the scripts in measure/ draw the tables
# again, where their programs are installed, and must get the same bytes.
cd "$(dirname "$0")/../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc} room=examples/elsewhere
PYTHON=python3
[ -x /usr/bin/python3 ] && PYTHON=/usr/bin/python3    # Debian's modules are for Debian's Python
export PYTHON

$CC -O1 -w -I. $room/test/tables.c -lm -o "$T/tables" || exit 1
"$T/tables" $room/tables/*.txt >"$T/measured"
# "name d" of a table, and of a row of the page, by the first names in its column of words
sed -n 's|^[^ ]*/\([a-z0-9_]*\)\.txt .* d \([0-9.]*\), .*|\1 \2|p' "$T/measured" | sort >"$T/tables.txt"
awk -F'|' '/^\| .*`.*\|$/ { d = $(NF - 1); gsub(/ /, "", d); n = split($5, word, "`")
    for (i = 2; i <= n; i += 2) print word[i], d }' $room/README.md >"$T/rows.txt"
# The page rounds up to one digit and says the larger one of two tables in a row.
holds() {
    said=$(sed -n "s/^$1 //p" "$T/rows.txt" | head -n 1)
    awk -v said="${said:-0}" -v d="$2" 'BEGIN { exit !(d <= said + .05 && said <= d * 1.1 + .5) }' || { echo "the page says '$said', measured $2"; return 1; }
}
while read -r name d; do check "$name: the page's difference" holds "$name" "$d"; done <"$T/tables.txt"
tabled() { [ "$2" = - ] || [ -f "$room/tables/$1.txt" ]; }
while read -r name d; do
    case $name in *lamp) ;; *) check "$name: has a table" tabled "$name" "$d" ;; esac
done <"$T/rows.txt"

# what must be there, then script and names
again() {
    needs=$1 script=$2; shift 2
    if [ -z "${LONG:-}" ]; then return; fi
    for name; do
        if sh -c "$needs" >/dev/null 2>&1; then check "$name draws as it did" "$PYTHON" "$room/measure/$script" "$name"
        else left_out "$name, whose program is not installed"; fi
    done
}
[ "${LONG:-}" ] || left_out "the programs themselves, which draw again with LONG=1"
if [ "${LONG:-}" ] && [ ! "${DISPLAY:-}" ] && there Xvfb; then    # VTK and view3dscene want a display
    Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>"$T/display" >/dev/null 2>&1 & x=$!
    trap 'kill $x; rm -rf "$T"' EXIT
    for _ in 1 2 3 4 5 6 7 8 9 10; do [ -s "$T/display" ] || sleep 1; done
    if [ -s "$T/display" ]; then DISPLAY=":$(cat "$T/display")" && export DISPLAY; fi
fi
header() { echo "echo '#include <$1>' | c++ $2 -w -E -x c++ -"; }
again 'command -v povray' povray.py povray
again '$PYTHON -c "import vtkmodules" && test "$DISPLAY"' vtk.py vtk
again 'command -v view3dscene && command -v pngtopnm && test "$DISPLAY"' view3dscene.py view3dscene
again "$(header GL/osmesa.h)" opengl.py opengl
again 'command -v tachyon' raytracers.py tachyon
again 'test -x /usr/bin/render && command -v pngtopnm' raytracers.py raster3d
again '$PYTHON -c "import pymol" && command -v pngtopnm' raytracers.py pymol
again '$PYTHON -c "import mpl_toolkits.mplot3d"' surfaces.py mplot3d
again 'command -v octave-cli && command -v gnuplot' surfaces.py surfl
again 'command -v gnuplot && command -v pngtopnm' surfaces.py gnuplot
again 'command -v gdaldem && command -v gdal_translate' surfaces.py gdal
again "$(header Inventor/SoDB.h) && $(header GL/osmesa.h)" toolkits.py inventor
again "$(header osg/Version) && $(header GL/osmesa.h)" toolkits.py osg
again "$(header mgl2/mgl_cf.h)" toolkits.py mathgl
again "$(header irrlicht/irrlicht.h)" toolkits.py irrlicht
again 'test -x /usr/lib/rasmol/rasmol.32' molecules.py rasmol
again 'test -f /usr/share/java/JmolData.jar && command -v java' molecules.py jmol
if [ "${LONG:-}" ] && command -v npm chromium >/dev/null; then
    export MODULES="$PWD/build/elsewhere/node_modules"
    # shellcheck disable=SC2046
    npm install --silent --no-audit --no-fund --ignore-scripts --prefix build/elsewhere $(sed -n 's/^ *packages: //p' $room/measure/web.py) >/dev/null 2>&1
fi
again 'command -v chromium && test -d "$MODULES/three"' web.py three_phong three_toon three_lambert three_mtl babylon x_ite x3dom p5 xeokit vtkjs deck processing playcanvas
again 'test -d "$MODULES/seen"' seen.py seen
finish
