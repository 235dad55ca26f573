#!/bin/sh
# instructions.sh - instructions a pixel of bench/instructions.c on several processors, as Markdown.
# qemu runs one instruction at a time and names each: those of one draw are the difference between
# three draws and one.  x86-64 is one without AVX, so that SSE2 stands beside NEON.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM

executed() {                    # scene, draws; qemu and program in $run
    $run "$T/program" "$1" "$2" 2>&1 >"$T/pixels" | grep -c '^Trace'
}
row() {                         # name, qemu, compiler ...
    name=$1 run="$2 -singlestep -d exec,nochain -D /dev/stderr"; shift 2
    "$@" -std=c99 -O2 -I. -static bench/instructions.c -lm -o "$T/program" 2>"$T/log" || return
    printf '| %s' "$name"
    for scene in flat lit map; do
        one=$(executed $scene 1) three=$(executed $scene 3)
        echo "$one $three $(cat "$T/pixels")" | awk '{ printf " | %.1f", ($2 - $1) / 2 / $3 }'
    done
    echo ' |'
}
echo '| instructions a pixel | one lamp, a face | two lamps, a pixel | one lamp and a map |'
echo '|---|---|---|---|'
row "x86-64, SSE2, gcc 12" "qemu-x86_64 -cpu Nehalem" gcc
row "x86-64, SSE2, clang 14" "qemu-x86_64 -cpu Nehalem" clang
row "aarch64, NEON, gcc 12" qemu-aarch64 aarch64-linux-gnu-gcc
row "aarch64, NEON, clang 14" qemu-aarch64 clang --target=aarch64-linux-gnu
