#!/bin/sh
# explain.sh [states] - shade_explain is silent about the project's own scenes: every program that
# draws meshes is built with explain_wrap.h before it, which prints what shade_explain says after
# each draw, and is run, with one sample a pixel.  Bands, strips, samples and pictures of many meshes
# are among them.
#   What it says of states is judged by tests/fuzz/explained.h, of 20,000 of each kind, or with a
# number of as many, and by the runner's sections, with more rounds than make test has, or with as many
# lines and pipelines; with a number the programs are left out.  Nothing false is said, and fewer than
# one black picture in a thousand has no sentence.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc} CXX=${CXX:-c++}
WRAP="-w -O1 -I. -ffp-contract=off -DSHADE__IMPLEMENTED -include tests/unit/explain_wrap.h"
${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
OPENMP=$(echo 'int main(void) { return 0; }' | $CC -fopenmp -x c - -o "$T/openmp" 2>/dev/null &&
    echo -fopenmp)
POSIX=$(echo | $CC -fsyntax-only -include termios.h -x c - 2>/dev/null && echo batch)

check "the judge of states builds" "$CC" -std=c99 -D_DEFAULT_SOURCE -O2 -I. -DSHADE_LANES=16 \
    -DEXPLAIN_STATES tests/fuzz/explain.c tests/fuzz/shade.c -lm -o "$T/states"
for kind in random ordinary; do
    { "$T/states" $kind "${1:-20000}" >"$T/$kind" 2>&1; } &
done
wait
true_of() {                     # kind, states; the last line has the counts
    set -- "$1" "${2:-20000}" $(sed -n \
        's/.* sentences, \([0-9]*\) false, \([0-9]*\) black.*/\1 \2/p' "$T/$1")
    grep '^false\|^black' "$T/$1"
    [ $# -eq 4 ] || return 1
    [ "$3" -eq 0 ] && [ $(($4 * 1000)) -lt "$2" ]
}
for kind in random ordinary; do
    [ $# -eq 0 ] || grep '^ ' "$T/$kind"
    tail -n 1 "$T/$kind"
    check "what is said of $kind states is true, and something is said of black ones" \
        true_of $kind "$@"
done
# the runner's sections that explain, with five times the rounds of make test, or as many as states
times=$((${1:-10000} / 2000))
check "sections that explain build" "$CC" -std=c99 -w -O1 -I. -DSHADE__IMPLEMENTED -DTEST_TIMES=$((times + !times)) \
    tests/unit/main.c tests/unit/scene.c tests/unit/explain*.c tests/unit/camera.c build/shade.o -lm -o "$T/sections"
for section in explain explain_pipelines camera; do
    check "the section $section, with many rounds" "$T/sections" $section
    cat "$T/log"
done
[ $# -eq 0 ] || finish

# Runs a program that draws a mesh; fails where a draw was explained.
silent() {
    (cd "$T" && "$@") >"$T/out" 2>"$T/err" || { cat "$T/err"; return 1; }
    grep -q '^a mesh is drawn' "$T/err" || { echo "no mesh is drawn"; return 1; }
    grep '^explain' "$T/err" | sort | uniq -c | sort -rn >"$T/said"
    [ ! -s "$T/said" ] || { cat "$T/said"; return 1; }
}
build() {                       # name, what compiles and links it
    name=$1; shift
    check "$name builds" "$@" build/shade.o -lm -pthread -o "$T/$name"
}
c99() { build "$1" "$CC" -std=c99 -D_DEFAULT_SOURCE $WRAP $2; }
run() { check "nothing is wrong with $1" silent "$T/$@"; }

for file in $(grep -l shade_draw_mesh examples/lessons/[0-9]*.c); do
    name=$(basename "$file" .c)
    before="-include $one_sample"
    among "$name" "$alone 08_normal_matrix" && before=    # its lines are a third of a pixel wide
    c99 "$name" "$OPENMP $before $file"
    run "$name" "$name.ppm"
done

cat >"$T/roof.obj" <<'END'
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v 0 1 0
f 1 2 3 4
f 4 3 5
f 3 2 5
f 2 1 5
f 1 4 5
END
c99 thumbnail examples/programs/thumbnail/thumbnail.c
run thumbnail roof.obj roof.ppm --size 200x160
run thumbnail roof.obj flat.ppm --size 200x160 --shading face --no-shadow --material gold
if [ -n "$POSIX" ]; then
    c99 batch examples/programs/batch/batch.c
    run batch --frames 4 --size 160x120 --out frames
    run batch --strips 5 --size 320x200 --out strips
else left_out "batch (no termios.h)"; fi

c99 saddle "examples/embed/cmake/main.c examples/embed/cmake/saddle.c"
run saddle saddle.ppm 160 120
if echo 'auto x = __cpp_lib_bit_cast; ' |
    $CXX -std=c++20 -include bit -include glm/glm.hpp -x c++ -fsyntax-only - 2>/dev/null; then
    build glm "$CXX" -std=c++20 $WRAP examples/embed/glm.cpp
    run glm glm.ppm
else left_out "GLM's program (no C++20, or no GLM)"; fi
${MAKE:-make} -s build/knot.c && cp build/knot.c "$T/readme.c"
c99 readme "$T/readme.c"
run readme
{ printf '#include "shade.h"\n'
  awk '/^ +#include <stdio.h>/ { inside = 1 } inside { print } /^       }/ { inside = 0 }' shade.h
} >"$T/head.c"
c99 head "$T/head.c"
run head

c99 scenes "-DSCENE_MAIN -Itests/unit tests/unit/scene.c"
run scenes
conformance="tests/conformance/main.c tests/conformance/scenes.c tests/conformance/gl.c"
if echo 'int main(void) { return !OSMesaGetProcAddress; }' |
    $CC -include GL/osmesa.h -x c - -o "$T/probe" -lOSMesa 2>/dev/null; then
    c99 conformance "$conformance -lOSMesa"
    GALLIUM_DRIVER=llvmpipe LP_NUM_THREADS=0 run conformance
else left_out "the scenes of conformance.sh (no OSMesa)"; fi

finish
