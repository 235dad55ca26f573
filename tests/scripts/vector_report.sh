#!/bin/sh
# vector_report.sh - lists every loop over lanes of shade.h that a compiler left scalar at -O2, or
# gcc at -O0, where the implementation asks for -O2 but the inline functions before it do not: none
# but those in $known.  x86-64, aarch64, RISC-V with V (a clang since 16) and WebAssembly with simd128;
# not armv7, whose NEON flushes denormal numbers, so that gcc leaves floats to its scalar unit.
# And every function that gcc compiled for SSE4.1, AVX2 or AVX-512 without using its instructions or
# registers: none.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/impl.c"

# Reports, functions whose loops they leave scalar, and why; each must still be left.
known='gcc for aarch64: shade__come_from_infinity (stores of constants: gcc 12 sees no gain)
gcc for aarch64: shade__pack_bytes (look-ups in a table, which x86 puts together as vectors)
clang for wasm32: shade__areas (integers to doubles, two in a vector: clang sees no gain)
clang for wasm32: shade__sides (integers to doubles, two in a vector: clang sees no gain)'

missed_gcc() {                  # compiler and flags; lines of shade.h
    "$@" -std=c99 -I. -fopt-info-vec-missed -c "$T/impl.c" -o /dev/null 2>&1 |
        sed -n "s/.*shade\.h:\([0-9]*\):.*couldn't vectorize loop.*/\1/p"
}
missed_clang() {
    "$@" -std=c99 -I. -foptimization-record-file="$T/record" -c "$T/impl.c" -o /dev/null
    awk '/^--- / { missed = $2 == "!Missed" } /^Pass:/ { pass = $2 }
        /^DebugLoc:.*shade\.h/ { sub(/.*Line: /, ""); sub(/,.*/, ""); line = $0 }
        /^Function:/ && missed && pass == "loop-vectorize" { print line }' "$T/record"
}
# Lines on standard input: those that begin a loop over lanes, with the function that each is in.
loops() {
    sort -nu >"$T/lines"
    awk 'NR == FNR { wanted[$1] = 1; next }
        /^[A-Za-z].* \**shade_[a-z_0-9]*\(/ { name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
        FNR in wanted && /SHADE__FOR\(|SHADE_EACH_LANE\(/ { print name " " FNR ": " $0 }' "$T/lines" shade.h
}
report() {                      # name, gcc or clang, compiler and flags
    name=$1 kind=$2; shift 2
    printf '%s\n' "$known" | sed -n "s/^$name: \([a-z_0-9]*\) .*/\1/p" | sort -u >"$T/known"
    if ! echo '#include <math.h>' | "$@" -x c -fsyntax-only - 2>/dev/null; then
        echo "left out: $name"
        return
    fi
    missed_$kind "$@" | loops >"$T/missed"
    sed 's/ .*//' "$T/missed" | sort -u >"$T/names"
    if cmp -s "$T/known" "$T/names"; then passed=$((passed + 1)); return; fi
    failed=$((failed + 1))
    grep -vwFf "$T/known" "$T/missed" | sed "s/^/$name, left scalar: /"
    comm -23 "$T/known" "$T/names" | sed "s/^/$name, no longer left scalar: /"
}
report "gcc -O2" gcc gcc -O2
report "gcc -O0" gcc gcc -O0
report "clang" clang clang -O2
report "gcc for aarch64" gcc aarch64-linux-gnu-gcc -O2
report "clang for aarch64" clang clang --target=aarch64-linux-gnu -O2
report "clang for riscv64 with V" clang clang-19 --target=riscv64-linux-gnu -march=rv64gcv -O2 \
    -isystem /usr/riscv64-linux-gnu/include
report "clang for wasm32" clang clang --target=wasm32-wasi -msimd128 -fno-math-errno -O2

# A function that gcc takes for cold is not even looked at: its builds have no wide register.  What
# SSE4.1 adds to loops over lanes are products, least and greatest of 32-bit integers, and selects.
scalar() {
    gcc -std=c99 -O2 -I. -S "$T/impl.c" -o "$T/impl.s" && awk '
        /^shade__.*:$/ { name = $1; wide[name] += 0 }
        /%ymm/ { wide[name] += name ~ /_avx2/ } /%zmm/ { wide[name] += name ~ /_avx512/ }
        /^\tp(mulld|m(in|ax)[su]d|blendvb)\t/ { wide[name] += name ~ /_sse41/ }
        END { for (name in wide) if (name ~ /_(avx|sse)/ && name !~ /cold/ && !wide[name]) print name }' \
        "$T/impl.s"
}
if command -v gcc >/dev/null && [ "$(uname -m)" = x86_64 ]; then
    scalar | sed 's/^/gcc -O2, without vectors: /' >"$T/missed"
    cat "$T/missed"
    if [ -s "$T/missed" ]; then failed=$((failed + 1)); else passed=$((passed + 1)); fi
fi

# README says that gcc for armv7 leaves the arithmetic of floats to the scalar unit.
arm=arm-linux-gnueabihf-gcc
if command -v $arm >/dev/null; then
    if $arm -std=c99 -O2 -mfpu=neon -I. -S "$T/impl.c" -o "$T/impl.s" &&
        ! grep -E '\sv(add|sub|mul|ml[as])\.f32\s+[qd]' "$T/impl.s"; then passed=$((passed + 1))
    else failed=$((failed + 1)); fi
else echo "left out: gcc for armv7"; fi
finish
