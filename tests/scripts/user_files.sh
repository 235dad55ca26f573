#!/bin/sh
# user_files.sh [word] - what users compile beside an implementation in an object of its own, with
# the defaults of each compiler: the inline functions of shade.h, by user_files.c; README's program
# and that in the head of shade.h; every lesson; the programs of examples/embed.  Each gives the
# same bits on every machine.
#   The programs of $own have sums of their own, which compilers may fuse.  The script holds that
# each draws other bits somewhere, and the same ones with -ffp-contract=off.  Lessons are drawn with
# one sample a pixel: all of them by gcc, as C99 and fused; a third of them elsewhere, so that each
# lesson is drawn by some clang, and fewer under slow emulators, or with LONG=1 all.  A word tries
# only machines that have it in their command.  What is not installed is named and left out.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
TOP=$PWD word=${1:-}
own="glm 14_two_sided 19_threads 20_openmp 21_transparency 37_rays 40_fog 43_pinhole"
by_rays="16_ray_cast 37_rays"       # a ray for each pixel: minutes under an emulator

awk '/^```c$/ { inside = 1; text = ""; next }
     /^```/ { if (inside && text ~ /int main\(/) { printf "%s", text; exit } inside = 0 }
     inside { text = text $0 "\n" }' README.md >"$T/readme.c"
{ echo '#include "shade.h"'
  awk '/^ +#include <stdio.h>/ { inside = 1 } inside { print } /^       }/ { inside = 0 }' shade.h
} >"$T/head.c"
programs="readme head saddle ball $(cd examples/lessons && ls [0-9]*.c | sed 's/\.c$//')"

# folder, runner (or ""), program, compiler and flags: its pictures and text, in folder/program.out
cat >"$T/draw.sh" <<'END'
folder=$1 runner=$2 name=$3; shift 3
E=$TOP/examples/embed
case $name in
readme | head) set -- "$@" "$T/$name.c" ;;
saddle) set -- "$@" "$E/cmake/main.c" "$E/cmake/saddle.c" ;;
ball) set -- "$@" "$E/meson/ball.c" ;;
glm) set -- "$@" "$E/glm.cpp" ;;
*)  case $name in
    *threads) set -- "$@" -pthread ;;
    *openmp)    # some compilers have no library for it: pragmas are then comments
        echo 'int main(void) { return 0; }' | "$@" -fopenmp -x c - -o "$folder/openmp" 2>/dev/null &&
            set -- "$@" -fopenmp ;;
    esac
    case " $ALONE " in *" $name "*) ;; *) set -- "$@" -include "$ONE_SAMPLE" ;; esac
    set -- "$@" "$TOP/examples/lessons/$name.c" ;;
esac
mkdir -p "$folder/$name" && cd "$folder/$name" || exit 1
"$@" -w -s -I"$TOP" -DSHADE__IMPLEMENTED "$folder/shade.o" -lm -o program 2>errors ||
    { cat errors; exit 1; }
# the same program, of other options, has been run: it draws the same
ran=$T/ran/$(cksum <program | tr ' ' _)
if ! [ -f "$ran" ]; then
    $runner ./program picture.ppm >text 2>errors || { cat errors; exit 1; }
    find . -name "*.ppm" -exec cat {} + | cat text - >ran && mv ran "$ran"
fi
cp "$ran" "../$name.out" && rm -rf "$folder/$name"
END
export T TOP ALONE="$alone" ONE_SAMPLE="$one_sample"
draw() { sh "$T/draw.sh" "$@"; }
# folder, runner, programs, compiler and flags: as many at a time as there are cores
draw_all() {
    folder=$1 runner=$2 some=$3; shift 3
    printf '%s\n' $some |
        xargs -P "$(nproc)" -I{} sh "$T/draw.sh" "$folder" "$runner" {} "$@" >"$T/log" 2>&1 ||
        fail "a program does not run: $*" "$T/log"
}
implementation() { "$@" -w -O2 -DSHADE_IMPLEMENTATION -x c -c shade.h -o "$T/shade_$1.o"; }

# What is wanted: all sums rounded after each operation
mkdir "$T/want" "$T/ran"
implementation gcc && cp "$T/shade_gcc.o" "$T/want/shade.o"
draw_all "$T/want" "" "$programs" gcc -std=c99 -O2 -ffp-contract=off
glm=; echo '#include <glm/glm.hpp>' | g++ -x c++ -fsyntax-only - 2>/dev/null && glm=glm
if [ -n "$glm" ]; then draw "$T/want" "" glm g++ -std=c++20 -O2 -ffp-contract=off
else left_out "glm.cpp: no GLM"; fi
rows() { "$@" -w -I. tests/scripts/user_files.c -lm -o "$T/rows"; }
rows gcc -O1 -std=c99 -ffp-contract=off && "$T/rows" >"$T/rows.want"
untried() {
    inline_functions | grep -v shade__ | while read -r name; do
        grep -q "TRY($name," tests/scripts/user_files.c || echo "$name"
    done
}
check "every inline function is tried" same "$(untried)" ""

lacks() { ! there "$1" || { [ -n "$2" ] && ! there "$2"; }; }    # compiler, runner (or "")
# fuses or not, runner (or ""), compiler and flags: the inline functions, and a sum of its own
inline() {
    fuses=$1 runner=$2; shift 2
    case "$*" in *"$word"*) ;; *) return ;; esac
    if lacks "$1" "$runner"; then left_out "inline functions, $*"; return; fi
    if ! rows "$@" 2>"$T/log"; then fail "inline functions, $*" "$T/log"; return; fi
    $runner "$T/rows" >"$T/rows.got"
    grep -v '^own' "$T/rows.want" >"$T/a"
    grep -v '^own' "$T/rows.got" >"$T/b"
    check "inline functions, $*" diff "$T/a" "$T/b"
    differs=0
    [ "$(tail -n 1 "$T/rows.want")" = "$(tail -n 1 "$T/rows.got")" ] || differs=1
    check "own sums, $*" same "$differs" "$fuses"
}

# program, compiler and flags: draws it again for the machine
draw_one() {
    name=$1 c=$2; shift 2
    case $name in
    glm) draw "$D" "$runner" glm "$cxx" "$@" -std=c++20 ;;
    *) draw "$D" "$runner" "$name" "$c" "$@" ;;
    esac
}
# fuses or not, runner (or ""), compiler for C++ (or none), compiler and flags: all programs
machine() { of=1; on_machine "$@"; }
# which of how many parts, and the same: README's, the head's and those of embed, and that part of the lessons
some_on() { part=${1%/*} of=${1#*/}; [ -z "$LONG" ] || of=1; shift; on_machine "$@"; }
on_machine() {
    fuses=$1 runner=$2 cxx=$3; shift 3
    case "$*" in *"$word"*) ;; *) return ;; esac
    inline "$fuses" "$runner" "$@"
    if lacks "$1" "$runner"; then left_out "programs, $*"; return; fi
    start=$(date +%s) D=$T/$(echo "$*" | tr -cd 'a-z0-9') some=$programs object=$T/shade_gcc.o
    mkdir "$D"
    [ -n "$runner" ] && implementation "$@" && object=$T/shade_$1.o
    cp "$object" "$D/shade.o"
    [ "$of" -eq 1 ] ||
        some=$(printf '%s\n' $some | awk -v part="$part" -v of="$of" 'NR <= 4 || NR % of == part')
    for name in $by_rays; do    # the list has words in lines
        [ -n "$runner" ] && some=$(printf '%s\n' $some | grep -vx "$name")
    done
    draw_all "$D" "$runner" "$some" "$@"
    if [ -n "$glm" ] && there "$cxx"; then
        check "glm.cpp, $cxx" draw_one glm "$@"
        some="$some glm"
    fi
    for name in $some; do
        if cmp "$T/want/$name.out" "$D/$name.out" >"$T/log" 2>&1; then passed=$((passed + 1))
        elif among "$name" "$own" && [ "$fuses" = 1 ]; then
            echo "$name" >>"$T/differed"
            check "$name, $* -ffp-contract=off, draws" draw_one "$name" "$@" -ffp-contract=off
            check "$name, $* -ffp-contract=off" cmp "$T/want/$name.out" "$D/$name.out"
        else fail "$name, $*" "$T/log"; fi
    done
    rm -rf "$D"
    echo "$(($(date +%s) - start)) s  $*"
}

# G12
: >"$T/differed"
machine 1 "" g++ gcc -O2 -march=haswell
some_on 0/3 0 "" g++ gcc -O2
some_on 1/3 0 "" "" gcc -O3
some_on 2/3 1 "" "" gcc -O2 -march=native
some_on 0/3 0 "" clang++ clang -O2
some_on 1/3 0 "" clang++-19 clang-19 -O2
some_on 2/3 0 "" "" clang-19 -O3
some_on 0/3 1 qemu-aarch64 "" aarch64-linux-gnu-gcc -static -O2
some_on 1/6 1 qemu-riscv64 "" riscv64-linux-gnu-gcc -static -O2
some_on 4/6 1 qemu-s390x "" s390x-linux-gnu-gcc -static -O2
inline 1 qemu-arm arm-linux-gnueabihf-gcc -static -O2 -mfpu=neon-vfpv4
inline 1 qemu-ppc64le powerpc64le-linux-gnu-gcc -static -O2
inline 1 qemu-ppc64le powerpc64le-linux-gnu-gcc -static -O3
inline 0 "" gcc -O2 -march=haswell -std=c99
inline 1 "" gcc -O3 -march=haswell -ffp-contract=fast
inline 1 "" g++ -x c++ -std=c++11 -O2 -march=haswell
inline 0 "" clang -O2 -march=haswell
inline 0 "" clang-19 -O3 -march=haswell
if [ "$LONG" ]; then
    far_machines >"$T/far"
    while read -r runner command <&3; do
        fuses=0
        case $command in powerpc* | mipsisa32r6*) fuses=1 ;; esac
        inline $fuses "$runner" $command -static
    done 3<"$T/far"
fi
roots() { rows gcc -O2 -march=haswell -DSHADE_NO_LIBM && "$T/rows"; }
check "square roots of SHADE_NO_LIBM" roots
for name in $own; do
    [ -z "$word" ] && { [ "$name" != glm ] || [ -n "$glm" ]; } || continue
    check "$name has sums of its own, or leaves the list" grep -qx "$name" "$T/differed"
done
finish
