#!/bin/sh
# drawing.sh - build/thumbnail --views: sheets, maps and JSON of known parts (drawing.py
# with parts.py), every error of an option, and the same bytes from other builds.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}
export LC_ALL=C
there python3 || { left_out "everything: no python3"; finish; }
python3 examples/programs/thumbnail/test/parts.py "$T" || exit 1

# ---- programs ------------------------------------------------------------------------------------
find_libraries
THUMBNAIL=$PWD/build/thumbnail
${MAKE:-make} -s build/thumbnail && $CC -std=c99 -O0 -ffp-contract=off -I. -DSHADE_NO_DISPATCH -DSHADE_LANES=16 \
    -DBANDS_ALONE examples/programs/thumbnail/thumbnail.c -lm -o "$T/alone" ||
    { echo "0 passed, 1 failed"; exit 1; }

# ---- what is drawn -------------------------------------------------------------------------------
find_python "numpy, PIL"
if [ "$STB" ] && [ "$python" ]; then
    [ "$ASSIMP" ] || left_out "nodes as parts: no libassimp-dev"
    "$python" examples/programs/thumbnail/test/drawing.py "$THUMBNAIL" "$T" ${ASSIMP:+assimp} >"$T/python.log" 2>&1
    grep -v ' passed, ' "$T/python.log"
    counts=$(sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/\1 \2/p' "$T/python.log")
    check "drawing.py ends" [ "$counts" ]
    passed=$((passed + ${counts% *})) failed=$((failed + ${counts#* }))
else left_out "drawing.py: no stb (libstb-dev), numpy or Pillow"; fi

# Sheets have the bits of golden/drawing.txt from all builds: cksum, size, name
sheets() {                      # program
    for part in box.stl inner.stl pair.stl bracket.obj; do
        for more in "" "--edges --angle first --samples 1" "--hidden --ids --dimensions --ortho"; do
            "$1" "$T/$part" "$T/sheet.ppm" --views front,right,top,iso --size 800x600 $more \
                --depth "$T/sheet.pgm" --id-map "$T/ids.pgm" --json "$T/sheet.json" || return 1
            sed '2,5d' "$T/sheet.json" >"$T/sheet.txt"
            for file in sheet.ppm sheet.pgm ids.pgm sheet.txt; do
                echo "$(cksum <"$T/$file") $part $file $more"
            done
        done
    done
}
if [ "$1" = --update ]; then sheets "$THUMBNAIL" >examples/programs/thumbnail/test/drawing.txt; exit; fi
for k in "$THUMBNAIL" "$T/alone"; do
    sheets "$k" >"$T/sums" 2>"$T/err"
    check "${k##*/}: the bits of drawing.txt" diff examples/programs/thumbnail/test/drawing.txt "$T/sums"
done

# ---- what goes wrong -----------------------------------------------------------------------------
refused() {                     # text, command ...: and no file
    rm -f "$T"/none.*
    refused_by thumbnail "$@" && [ -z "$(ls "$T" | grep -e '^none\.' -e '\.part$')" ]
}
bad() {                         # text, options
    text=$1; shift
    check "$* says $text" refused "$text" "$THUMBNAIL" "$T/box.stl" "$T/none.ppm" "$@"
}
v="--views front,top"
for k in "" front, ,front front,front Front front,side "front top"; do bad "views" --views "$k"; done
bad "needs a value" --views
for k in --ortho --edges --hidden --ids --dimensions "--angle first" "--depth $T/none.pgm" \
    "--id-map $T/none.pgm" "--json $T/none.json"; do bad "needs --views" $k; done
for k in "--rotate 10" "--model phong" "--shading face" "--material gold" --no-shadow "--view top" --quick; do
    bad "does not go with --views" $v $k
done
bad "background none" $v --background none
bad "angle" $v --angle second
bad "depth" $v --depth "$T/none.jpg"
bad "depth" $v --depth .png
bad "id-map" $v --id-map "$T/none"
bad "needs a value" $v --json
bad "same name" $v --depth "$T/none.pgm" --id-map "$T/none.pgm"
bad "FILE ends in .json" $v --json "$T/none.ppm"
check "a map of the sheet's name" refused "same name" "$THUMBNAIL" "$T/box.stl" "$T/none.png" $v \
    --depth "$T/none.png"
bad "too small" $v --size 60x40
bad "too small" --views front,back,left,right,top,bottom,iso --dimensions --size 200x600
bad "No such file" $v --depth "$T/nowhere/none.pgm"
bad "No such file" $v --json "$T/nowhere/none.json"
mkdir "$T/folder.pgm"
bad "directory" $v --id-map "$T/folder.pgm"
[ -e /dev/full ] && bad "No space left" $v --json /dev/full
check "PNG of 16 bits is named with what it needs" refused "libstb-dev" "$T/alone" "$T/box.stl" \
    "$T/none.ppm" $v --depth "$T/none.png"
: >"$T/empty.stl"
check "an empty model" refused "empty" "$THUMBNAIL" "$T/empty.stl" "$T/none.ppm" $v
check "too many triangles" refused "more than 5 triangles" "$THUMBNAIL" "$T/box.stl" "$T/none.ppm" \
    $v --max-triangles 5

# ---- odd models ----------------------------------------------------------------------------------
odd() {                         # what, file
    check "$1" "$T/alone" "$T/$2" "$T/odd.ppm" --views front,right,top,iso --hidden --ids \
        --dimensions --size 400x300 --json "$T/odd.json"
    check "$1: JSON" python3 -m json.tool "$T/odd.json"
    check "$1: no number that JSON lacks" no grep -iE '(nan|inf)[^a-z]' "$T/odd.json"
}
printf 'v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n' >"$T/point.obj"
printf 'v 0 0 0\nv 9 0 0\nv 4 0 0\nf 1 2 3\n' >"$T/line.obj"
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n' >"$T/flat.obj"
printf 'v 1e38 1e38 -1e38\nv -1e38 1e38 1e38\nv 1e38 -1e38 0\nf 1 2 3\n' >"$T/large.obj"
printf 'v 1e-38 0 0\nv 0 1e-38 0\nv 0 0 1e-38\nf 1 2 3\n' >"$T/small.obj"
printf 'v 0 0 0\nv 1000000 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/needle.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n' >"$T/fan.obj"
for k in point line flat large small needle fan; do odd "a $k" $k.obj; done
finish
