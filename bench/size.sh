#!/bin/sh
# size.sh - seconds to compile shade.h's implementation, its machine code, and the stack it takes.
# CC and BUILD (where to build) may be set.
set -e
cd "$(dirname "$0")/.."
cc=${CC:-cc}
build=${BUILD:-build}
small="-DSHADE_LANES=16 -DSHADE_MAX_VARYINGS=8"
mkdir -p "$build"
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$build/size.c"

# median of five compilations, processor time
seconds() {
    for run in 1 2 3 4 5; do
        { time -p $cc "$@" -std=c99 -I. -c "$build/size.c" -o "$build/size.o"; } 2>&1 |
            awk '$1 == "user" { print $2 }'
    done | sort -n | sed -n 3p
}
# bytes of the sections of size.o whose names begin so
section() {
    size -A "$build/size.o" |
        awk -v name="$1" 'index($1, name) == 1 { n += $2 } END { print n + 0 }'
}
row() {
    title=$1
    shift
    printf "| $title | \`$*\` | $(seconds "$@")"
    for name in .text .rodata .data .bss; do printf " | $(section $name)"; done
    echo " |"
}
printf "| shade.h, $(wc -l <shade.h) lines | flags | seconds to compile"
echo " | .text | .rodata | .data* | .bss |"
echo "|---|---|---|---|---|---|---|"
row "as it comes" -O2
row "no dispatch" -O2 -DSHADE_NO_DISPATCH
row "small" -Os -DSHADE_NO_DISPATCH $small
echo
echo "(* constants with pointers in them, .data.rel.ro.)"
echo
echo "Bytes of stack that \`shade_draw_mesh\` touches, measured:"

# program, flags
stack() {
    program=$build/$1
    shift
    $cc -std=c99 -I. "$@" bench/stack.c -o "$program" -lm -pthread
    echo
    echo "\`$*\`"
    echo
    "$program"
}
stack stack -O2
stack stack_small -O2 $small
stack stack_least -Os -DSHADE_NO_DISPATCH $small

# frames by the compiler's own account, largest first
if $cc -std=c99 -O2 -I. -fstack-usage -c "$build/size.c" -o "$build/size.o" 2>/dev/null; then
    echo
    echo "Largest frames, by \`-O2 -fstack-usage\`:"
    echo
    echo "| function | bytes |"
    echo "|---|---|"
    awk -F'\t' '{ n = split($1, p, ":"); print $2 "\t" p[n] }' "$build/size.su" |
        sort -rn | head -8 | awk -F'\t' '{ print "| " $2 " | " $1 " |" }'
fi
