#!/bin/sh
# vector_report.sh - lists every loop over lanes of shade.h that a compiler left scalar at -O2: none.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/impl.c"
passed=0 failed=0

# compiler, flags that make it tell of missed loops, what such a line says
report() {
    name=$1 flags=$2 says=$3
    command -v "$name" >/dev/null || return
    "$name" -std=c99 -O2 -I. $flags -c "$T/impl.c" -o /dev/null 2>&1 | grep "$says" |
        sed -n 's/.*shade\.h:\([0-9]*\):.*/\1/p' | sort -nu >"$T/lines"
    : >"$T/missed"
    while read -r line; do
        sed -n "${line}p" shade.h | grep -E 'SHADE__FOR\(|SHADE_EACH_LANE\(' | sed "s/^/$name, shade.h:$line:/" >>"$T/missed"
    done <"$T/lines"
    # loops of one lane are no loops, and are inlined from the same line as wide ones
    cat "$T/missed"
    if [ -s "$T/missed" ]; then failed=$((failed + 1)); else passed=$((passed + 1)); fi
}
report gcc -fopt-info-vec-missed "couldn't vectorize loop"
report clang -Rpass-missed=loop-vectorize "loop not vectorized"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
