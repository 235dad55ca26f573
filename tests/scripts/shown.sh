#!/bin/sh
# shown.sh - each PNG of examples/pictures is the picture that its program draws into out/, but for
# the few bits that gallery.sh takes away.  Needs netpbm; make draws the pictures first.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
there pnmpsnr && there pngtopnm || { left_out "everything: no netpbm"; finish; }

alike() {                       # two pictures: the noise is 42 dB below the signal, or there is none
    pnmpsnr "$1" "$2" 2>&1 | tee "$T/said" | awk '
        /no difference/ { same++ }
        / dB$/ { sub(/.*: */, ""); if ($1 >= 42) same++ }
        END { exit same != 3 }' || { cat "$T/said"; return 1; }
}
for ppm in out/*.ppm; do
    png=examples/pictures/$(basename "$ppm" .ppm).png
    pngtopnm "$png" 2>/dev/null | pamdepth 255 >"$T/shown.ppm" 2>/dev/null
    check "$png shows what is drawn; if not, make gallery" alike "$ppm" "$T/shown.ppm"
done
finish
