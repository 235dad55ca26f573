#!/bin/sh
# vector_report.sh - lists every loop over lanes of shade.h that a compiler left scalar at -O2, or
# gcc at -O0, where the implementation asks for -O2 but the inline functions before it do not: none.
# And every function that gcc compiled for AVX2 or AVX-512 without using its registers: none.
cd "$(dirname "$0")/../.." || exit 1
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/impl.c"
passed=0 failed=0

missed_gcc() {                               # lines of shade.h
    gcc -std=c99 "$1" -I. -fopt-info-vec-missed -c "$T/impl.c" -o /dev/null 2>&1 |
        sed -n "s/.*shade\.h:\([0-9]*\):.*couldn't vectorize loop.*/\1/p"
}
missed_clang() {
    clang -std=c99 -O2 -I. -foptimization-record-file="$T/record" -c "$T/impl.c" -o /dev/null
    awk '/^--- / { missed = $2 == "!Missed" } /^Pass:/ { pass = $2 }
        /^DebugLoc:.*shade\.h/ { sub(/.*Line: /, ""); sub(/,.*/, ""); line = $0 }
        /^Function:/ && missed && pass == "loop-vectorize" { print line }' "$T/record"
}
for report in "gcc -O2" "gcc -O0" "clang -O2"; do
    name=${report% *}
    command -v $name >/dev/null || continue
    missed_$name "${report#* }" | sort -nu >"$T/lines"
    while read -r line; do
        sed -n "${line}p" shade.h | grep -E 'SHADE__FOR\(|SHADE_EACH_LANE\(' |
            sed "s/^/$report, shade.h:$line:/"
    done <"$T/lines" >"$T/missed"
    cat "$T/missed"
    if [ -s "$T/missed" ]; then failed=$((failed + 1)); else passed=$((passed + 1)); fi
done

# A function that gcc takes for cold is not even looked at: its builds have no wide register.
scalar() {
    gcc -std=c99 -O2 -I. -S "$T/impl.c" -o "$T/impl.s" && awk '
        /^shade__.*:$/ { name = $1; wide[name] += 0 }
        /%ymm/ { wide[name] += name ~ /_avx2/ } /%zmm/ { wide[name] += name ~ /_avx512/ }
        END { for (name in wide) if (name ~ /_avx/ && name !~ /cold/ && !wide[name]) print name }' \
        "$T/impl.s"
}
if command -v gcc >/dev/null && [ "$(uname -m)" = x86_64 ]; then
    scalar | sed 's/^/gcc -O2, without vectors: /' >"$T/missed"
    cat "$T/missed"
    if [ -s "$T/missed" ]; then failed=$((failed + 1)); else passed=$((passed + 1)); fi
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
