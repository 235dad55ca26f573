#!/bin/sh
# run.sh - builds and runs the programs of bench/ and prints their tables as Markdown.
#
#   run.sh [compare] [levels] [maths] [kernel] [scaling] [normals] [size] [copies] [read] [thumbnails]
#          [lamps] [batch]   all where none is named
#   BASE=revision run.sh     this shade.h against that of another revision, frames in turns
#   BASE=revision run.sh thumbnails lamps batch
#                            these programs beside those of another revision
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

# A program of $BASE as build/base_NAME, without libraries; this one's as build/own_NAME
programs_of() {                 # name, more flags for our own
    name=$1; shift
    line="-std=c99 $flags -ffp-contract=off -pthread -I. examples/programs/$name/$name.c -lm"
    $cc "$@" $line -o "$build/own_$name"
    [ "${BASE:-}" ] || return 0
    rm -rf "$build/base_tree" && mkdir -p "$build/base_tree"
    git archive "$BASE" shade.h examples | tar x -C "$build/base_tree"
    (cd "$build/base_tree" && $cc $line -o "../base_$name")
}
# The least seconds of commands in turns become the rest of a row: $1 names it.
row() {
    awk -v name="$1" '{
        line = "| " name
        for (k = 1; k <= NF; k++) { split($k, v, ":"); line = line " | " v[1] " | " v[2]; t[k] = v[1] }
        for (k = 3; k <= NF; k++) line = line sprintf(" | %.2f, %.2f", t[1] / t[k], t[2] / t[k])
        print line " |" }'
}
torus() {                       # triangles: build/a.stl
    "$build/bench_read" --only "STL, binary" --triangles "$1" --write "$build" >/dev/null
}
tools() {
    $cc $standard $flags "-DBENCH_FLAGS=\"$flags\"" bench/read.c -o "$build/bench_read" -lm
    $cc $standard $flags bench/turns.c -o "$build/turns"
    $cc $standard $flags examples/programs/thumbnail/test/look.c -o "$build/look" -lm
}

# Thumbnails at 256 pixels, as programs from start to end, beside f3d, which needs a display, and
# beside those of $BASE.
thumbnails() {
    tools
    programs_of thumbnail
    f3d= screen= heads= rules=
    if command -v f3d >/dev/null; then
        f3d="-- f3d --dry-run --resolution 256,256 --output $build/bench_f3d.png"
        heads=" | f3d | MB" rules="---|---|"
        if [ -z "${DISPLAY:-}" ]; then screen="xvfb-run -a"; fi
    fi
    [ -z "${BASE:-}" ] || heads="$heads | $BASE | MB" rules="$rules---|---|"
    echo "## Thumbnails of binary STL at 256 pixels: least seconds of processor time, most memory"
    echo
    echo "Behind them the parts of each other program's time that the two take."
    echo
    echo "| triangles | thumbnail | MB | --quick | MB$heads |${f3d:+ of f3d |}${BASE:+ of $BASE |}"
    echo "|---|---|---|---|---|$rules${f3d:+---|}${BASE:+---|}"
    for triangles in 1000 100000 2000000; do
        torus $triangles
        set -- --size 256x256 "$build/a.stl" "$build/bench_read.ppm"
        $screen "$build/turns" "${ROUNDS:-5}" "$build/own_thumbnail" "$@" -- \
            "$build/own_thumbnail" --quick "$@" ${f3d:+$f3d "$build/a.stl"} \
            ${BASE:+-- "$build/base_thumbnail" "$@"} | row $triangles
    done
    rm -f "$build/a.stl"
    echo
}

# How far thumbnails are from pictures of which each sample asks 64 lamps of the sky and 16 points of
# the large one, by fine maps of the whole model, and how far those of $BASE are.  MODELS: the files.
lamps() {
    tools
    programs_of thumbnail -DSTUDIO_WHOLE=1
    mv "$build/own_thumbnail" "$build/whole_thumbnail"
    programs_of thumbnail
    torus 100000
    from=/usr/share/assimp/models       # of assimp-testmodels
    all="$build/a.stl $from/OBJ/spider.obj $from/OBJ/WusonOBJ.obj $from/STL/Spider_binary.stl
        $from/PLY/Wuson.ply $from/OFF/Wuson.off
        $from/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"
    echo "## Mean difference to a picture by all lamps, of 255, at 256 pixels"
    echo
    echo "| model | thumbnail${BASE:+ | $BASE} |"
    echo "|---|---|${BASE:+---|}"
    for model in ${MODELS:-$all}; do
        [ -f "$model" ] || continue
        line="| ${model##*/} |"
        "$build/whole_thumbnail" --quiet --size 256x256 "$model" "$build/whole.ppm"
        for program in own ${BASE:+base}; do
            "$build/${program}_thumbnail" --quiet --size 256x256 "$model" "$build/$program.ppm"
            line="$line $("$build/look" near "$build/whole.ppm" "$build/$program.ppm" 255 |
                sed 's/.*, \([0-9.]*\) in.*/\1/') |"
        done
        echo "$line"
    done
    rm -f "$build/a.stl"
    echo
}

# A frame of a turning torus, 640 x 360: a tenth of what eleven frames take more than one
batch() {
    tools
    programs_of batch
    echo "## Frames of batch at 640 x 360, seconds of processor time"
    echo
    echo "| triangles | a frame${BASE:+ | $BASE | parts of it} |"
    echo "|---|---|${BASE:+---|---|}"
    for triangles in 1000 100000; do
        torus $triangles
        set -- "$build/a.stl" --size 640x360 --pipe --frames
        "$build/turns" "${ROUNDS:-5}" "$build/own_batch" "$@" 1 -- "$build/own_batch" "$@" 11 \
            ${BASE:+-- "$build/base_batch" "$@" 1 -- "$build/base_batch" "$@" 11} |
            awk -v triangles="$triangles" '{
                for (k = 1; k <= NF; k++) t[k] = $k + 0
                line = sprintf("| %s | %.4f |", triangles, (t[2] - t[1]) / 10)
                if (NF > 2) line = line sprintf(" %.4f | %.2f |", (t[4] - t[3]) / 10,
                    (t[2] - t[1]) / (t[4] - t[3]))
                print line }'
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
if [ -n "${BASE:-}" ] && [ $# -eq 0 ]; then
    against
    exit
fi

for part in ${*:-compare levels maths kernel scaling normals size copies read thumbnails lamps batch}; do
    case $part in
    compare | levels | maths | kernel | scaling | normals | copies | thumbnails | lamps | batch) $part ;;
    size) size_of ;;
    read) read_files ;;
    *)
        echo "run.sh: no part is called $part" >&2
        exit 2
        ;;
    esac
done
