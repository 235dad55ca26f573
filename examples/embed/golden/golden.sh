#!/bin/sh
# golden.sh - a test by picture: draws, compares with the picture kept beside this script, and
# fails where more than a few pixels differ by more than a little.
#
#   sh golden.sh             exit status 0: the same; 1: see difference.ppm; 2: it does not build
#   sh golden.sh --accept    keeps what is drawn now; look at it first
#
# SHADE is the directory of shade.h, OUT where pictures and programs go, CC the compiler.
cd "$(dirname "$0")" || exit 2
SHADE=${SHADE:-../../..} OUT=${OUT:-$SHADE/build/embed/golden} CC=${CC:-cc}
mkdir -p "$OUT" || exit 2

# the program under test, its own sums as exact as those of shade.h; and what compares
$CC -std=c99 -O2 -ffp-contract=off -I"$SHADE" ../cmake/*.c -lm -o "$OUT/saddle" || exit 2
$CC -std=c99 -O2 -pthread "-I$SHADE" "$SHADE/examples/programs/compare/compare.c" -lm -o "$OUT/compare" || exit 2

# small pictures: less to keep, and a fault that matters shows in them as well
"$OUT/saddle" "$OUT/picture.ppm" 64 48 || exit 2
if [ "${1:-}" = --accept ]; then
    cp "$OUT/picture.ppm" golden.ppm
    exit
fi

# the same bits everywhere, but for functions that differ between C libraries, such as sinf
"$OUT/compare" --limit 2 --count 10 --difference "$OUT/difference.ppm" golden.ppm "$OUT/picture.ppm"
