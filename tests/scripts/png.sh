#!/bin/sh
# png.sh - out/*.ppm, the pictures of the gallery, as PNG: three tenths of their bytes on average, at
# most.  libpng reads the pixels of the PPM, where netpbm is here; make draws the pictures first.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
find_compilers
# G20
$CC -O2 -w -I. -DSHADE__IMPLEMENTED tests/scripts/png.c build/shade.o -lm -o "$T/png" || exit 1
size_of() { wc -c <"$1"; }
written() { "$T/png" "$1" "$T/picture.png"; }
read_back() { pngtopnm "$T/picture.png" | cmp - "$1"; }
there pngtopnm || left_out "pixels that libpng reads: no netpbm"
for ppm in out/*.ppm; do
    check "$ppm as PNG" written "$ppm"
    if there pngtopnm; then check "$ppm, read by libpng" read_back "$ppm"; fi
    echo "$(size_of "$T/picture.png") $(size_of "$ppm")" >>"$T/sizes"
done
small() {
    awk '{ sum += $1 / $2 } END { print sum / NR " of the bytes of PPM"; exit !(sum <= 0.3 * NR) }' \
        "$T/sizes"
}
check "three tenths of the bytes" small
cat "$T/log"
finish
