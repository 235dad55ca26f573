#!/bin/sh
# run.sh - builds and runs the programs of bench/ and prints their tables as Markdown.
#
#   run.sh [compare] [levels] [maths] [kernel] [scaling] [normals] [size] [copies] [read] [thumbnails]
#                            all where none is named
#   BASE=revision run.sh     this shade.h against that of another revision, frames in turns
#
# CC, CXX, CFLAGS (-O2), BUILD (where to build, from the top directory: build), ROUNDS and MESH (an
# OBJ file instead of the knot) may be set.  Figures for plot.sh are left in BUILD as bench_*.tsv.
set -e
cd "$(dirname "$0")/.."
cc=${CC:-cc}
cxx=${CXX:-c++}
flags=${CFLAGS:--O2}
build=${BUILD:-build}
rounds=${ROUNDS:+--rounds $ROUNDS}
standard="-std=c99 -I."
mkdir -p "$build"

# One processor, so that caches and clock stay the same.
pin=
if command -v taskset >/dev/null && taskset -c 0 true 2>/dev/null; then pin="taskset -c 0"; fi

# Can a program with this line be built?  The rest are flags.
can_build() {
    printf '%s\nint main(void) { return 0; }\n' "$2" >"$build/probe.$1"
    shift 2
    "$@" -o "$build/probe" >/dev/null 2>&1
}

# $1.c with the adapters of the peers that are installed, into BUILD
build_with_peers() {
    peers= libraries=
    if can_build c '#include <GL/osmesa.h>' $cc "$build/probe.c" -lOSMesa; then
        peers="-DHAVE_OSMESA" libraries="-lOSMesa"
    fi
    if can_build c '#include <vulkan/vulkan.h>' $cc "$build/probe.c" -lvulkan; then
        peers="$peers -DHAVE_VULKAN" libraries="$libraries -lvulkan"
    fi
    $cc $standard $flags $peers "-DBENCH_FLAGS=\"$flags\"" "bench/$1.c" bench/peers/osmesa.c \
        bench/peers/vulkan.c -o "$build/bench_$1" $libraries -lm -pthread
}
compare() {
    build_with_peers compare
    echo "## The same pictures with other renderers"
    echo
    $pin "$build/bench_compare" $rounds ${MESH:+--mesh "$MESH"} --tsv "$build/bench_compare.tsv"
    echo
}

# The library on processors with less: AVX2, SSE4.1, and SSE2 as any x86-64 has it; Mesa's vectors
# have 256 bits beside AVX2, else 128.
levels() {
    build_with_peers compare
    for level in 2 1 0; do
        echo "## The same with narrower vectors: level $level of 3"
        echo
        $pin "$build/bench_compare" ${rounds:---rounds 11} ${MESH:+--mesh "$MESH"} --level $level \
            --tsv "$build/bench_level_$level.tsv"
        echo
    done
    [ ! -s "$build/bench_compare.tsv" ] || together
}
# Each row beside its best peer; lines without tabs tell of the machine.
together() {
    echo "## Together"
    echo
    awk -F'\t' '
        FILENAME == ARGV[4] && NF == 1 { print }
        NF == 1 { next }
        FILENAME != ARGV[4] {
            narrow[FILENAME, $1] = $4 > 0 ? sprintf("%.2g, %s", $4, $5) : "-"
            next
        }
        !begun++ {
            print "\n| scene | shade.h, ms | best peer, ms | times faster | with AVX2 | with SSE4.1 | with SSE2 |"
            print "|---|---|---|---|---|---|---|"
        }
        {
            best = $4 > 0 ? sprintf("%s, %.3g", $5, $3) : "-"
            printf "| %s | %.3g | %s | %.2g | %s | %s | %s |\n", $1, $2, best, $4,
                narrow[ARGV[1], $1], narrow[ARGV[2], $1], narrow[ARGV[3], $1]
        }' \
        "$build/bench_level_2.tsv" "$build/bench_level_1.tsv" "$build/bench_level_0.tsv" \
        "$build/bench_compare.tsv"
    echo
}

# The rest are flags of the compilers.
maths_with() {
    cglm= glm=
    if can_build c '#include <cglm/cglm.h>' $cc "$build/probe.c" -lm; then cglm="-DHAVE_CGLM"; fi
    if can_build cpp '#include <glm/glm.hpp>' $cxx "$build/probe.cpp"; then glm="-DHAVE_GLM"; fi
    $cc $standard "$@" "-DBENCH_FLAGS=\"$*\"" -c bench/maths.c -o "$build/maths.o"
    $cc $standard "$@" -c bench/maths_shade.c -o "$build/maths_shade.o"
    $cc -std=gnu99 "$@" $cglm -c bench/peers/cglm.c -o "$build/maths_cglm.o"
    $cxx "$@" $glm -c bench/peers/glm.cpp -o "$build/maths_glm.o"
    $cxx "$build/maths.o" "$build/maths_shade.o" "$build/maths_cglm.o" "$build/maths_glm.o" -lm \
        -o "$build/maths"
    $pin "$build/maths" $rounds --tsv "$build/bench_maths.tsv"
    echo
}
maths() {
    echo "## Vectors and matrices"
    echo
    maths_with -O2
    maths_with -O3 -march=native
}

kernel() {
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/kernel.c -o "$build/kernel" -lm
    echo "## The equations alone"
    echo
    $pin "$build/kernel" $rounds --tsv "$build/bench_kernel.tsv"
    echo
}

scaling() {
    build_with_peers scaling
    echo "## Larger meshes, larger pictures, more threads, less in sight"
    echo
    "$build/bench_scaling" $rounds --tsv "$build/bench_scaling.tsv"
    echo
}

# Model files in memory, without a program around.
read_files() {
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/read.c -o "$build/bench_read" -lm
    echo "## Reading model files"
    echo
    $pin "$build/bench_read" $rounds
    echo
}

# Thumbnails at 256 pixels, as programs from start to end, beside f3d, which needs a display.
thumbnails() {
    ${MAKE:-make} -s build/thumbnail
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/read.c -o "$build/bench_read" -lm
    $cc $standard $flags bench/turns.c -o "$build/turns"
    picture=$build/bench_read.ppm f3d= screen=
    if can_build c '#include <stb/stb_image_write.h>' $cc "$build/probe.c"; then
        picture=$build/bench_read.png
    fi
    if command -v f3d >/dev/null; then
        f3d="-- f3d --dry-run --resolution 256,256 --output $build/bench_f3d.png"
        if [ -z "${DISPLAY:-}" ]; then screen="xvfb-run -a"; fi
    fi
    echo "## Thumbnails of binary STL at 256 pixels, seconds of processor time"
    echo
    echo "| triangles | shade-thumbnail | with --quick | f3d | parts of it |"
    echo "|---|---|---|---|---|"
    for triangles in 1000 100000 2000000; do
        "$build/bench_read" --only "STL, binary" --triangles "$triangles" --write "$build" >/dev/null
        model=$build/a.stl
        $screen "$build/turns" "${ROUNDS:-5}" build/thumbnail --size 256x256 "$model" "$picture" -- \
            build/thumbnail --quick --size 256x256 "$model" "$picture" ${f3d:+$f3d "$model"} |
            awk -v triangles="$triangles" '{
                parts = NF > 2 ? sprintf("%.2f, %.2f", $1 / $3, $2 / $3) : "-"
                print "| " triangles " | " $1 " | " $2 " | " (NF > 2 ? $3 : "-") " | " parts " |" }'
    done
    rm -f "$build/a.stl"
    echo
}

# Normals of vertices; beside those of $BASE where it is set.
normals_by() {                  # the folder of a shade.h, more flags, what it is called
    $cc $standard $flags $2 -I"$1" -iquote bench bench/normals.c -o "$build/normals" -lm
    echo "| $3, a million triangles | ms | bits |"
    echo "|---|---|---|"
    $pin "$build/normals" $rounds
    echo
}
normals() {
    echo "## shade_mesh_normals"
    echo
    normals_by . "" "this shade.h"
}

size_of() {
    echo "## Size"
    echo
    CC=$cc BUILD=$build sh bench/size.sh
    echo
}

# What each specialised copy of a hot loop is worth: the library without it beside the whole one, in
# the scene that it serves best.
copies() {
    $cc $standard $flags -fPIC -shared bench/frames.c -o "$build/whole.so" -lm
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/against.c -o "$build/against" -ldl
    echo "## Specialised copies of hot loops"
    echo
    echo "| without the copy for | bytes of .text fewer | scene | times as long |"
    echo "|---|---|---|---|"
    all=255 bit=1
    while read -r copy scene; do
        $cc $standard $flags -fPIC -shared -DSHADE__SPECIALIZE=$((all - bit)) bench/frames.c \
            -o "$build/without.so" -lm
        $pin "$build/against" "$build/whole.so" "$build/without.so" $rounds --only "$scene" |
            awk -F' *[|] *' -v copy="$copy" -v fewer=$(($(text_of whole) - $(text_of without))) '
                $3 ~ /^[0-9.]+$/ { print "| " copy " | " fewer " | " $2 " | " $5 " |"; exit }'
        bit=$((bit * 2))
    done <<'SCENES'
light-without-rows every pixel in every cone
LESS 1000 big
tiles-inside 1000 big
bounds 1000 big
narrow-triangles teapot 64
short-runs knot of 124k
long-runs flat fill with depth 320
medium-triangles teapot 720p, Gouraud
SCENES
    echo
}
text_of() { size -A "$build/$1.so" | awk '$1 == ".text" { print $2 }'; }

# The scenes of today with the header of another revision, whose names must be those of 1.0.
against() {
    old=$build/base
    rm -rf "$old" && mkdir -p "$old/bench" "$old/examples/shared"
    git show "$BASE:shade.h" >"$old/shade.h"
    cp bench/frames.c bench/level.h bench/scenes.h "$old/bench/"
    cp examples/shared/teapot.h "$old/examples/shared/"
    before=
    grep -q sse4.1 "$old/shade.h" || before=-DBENCH_WITHOUT_SSE41
    $cc $standard $flags -fPIC -shared bench/frames.c -o "$build/frames.so" -lm
    (cd "$old" && $cc $standard $flags $before -fPIC -shared bench/frames.c -o frames.so -lm)
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/against.c -o "$build/against" -ldl
    normals
    standard=-std=c99 normals_by "$old" "$before" "$BASE"
    for level in ${LEVELS:-3 2 1 0}; do
        echo "## Against $BASE, level $level of 3"
        echo
        $pin "$build/against" "$build/frames.so" "$old/frames.so" $rounds --level "$level"
        echo
    done
}
if [ -n "${BASE:-}" ]; then
    against
    exit
fi

for part in ${*:-compare levels maths kernel scaling normals size copies read thumbnails}; do
    case $part in
    compare | levels | maths | kernel | scaling | normals | copies | thumbnails) $part ;;
    size) size_of ;;
    read) read_files ;;
    *)
        echo "run.sh: no part is called $part" >&2
        exit 2
        ;;
    esac
done
