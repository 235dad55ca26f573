#!/bin/sh
# gallery.sh - the pictures of the README: out/*.ppm as PNG, in 256 colours where dither hides that
# (pngquant's 99 of 100), else in 7 bits a channel.  The picture for the microcontroller's display is
# shown three times as large.  Needs netpbm (pnmenlarge, pamdepth, pnmtopng), pngquant and python3.
#     gallery.sh --check     is each PNG the picture that its program draws into out/, but for the few
#                            bits that are taken away?  Needs netpbm; make draws the pictures first.
cd "$(dirname "$0")/../.." || exit 1
alike() {                       # two pictures: the noise is 42 dB below the signal, or there is none
    pnmpsnr "$1" "$2" 2>&1 | tee "$T/said" | awk '
        /no difference/ { same++ }
        / dB$/ { sub(/.*: */, ""); if ($1 >= 42) same++ }
        END { exit same != 3 }' || { cat "$T/said"; return 1; }
}
if [ "$1" = --check ]; then
    . tests/scripts/tools.sh
    there pnmpsnr && there pngtopnm || { left_out "everything: no netpbm"; finish; }
    for ppm in out/*.ppm; do
        png=examples/pictures/$(basename "$ppm" .ppm).png
        pngtopnm "$png" 2>/dev/null | pamdepth 255 >"$T/shown.ppm" 2>/dev/null
        check "$png shows what is drawn; if not, make gallery" alike "$ppm" "$T/shown.ppm"
    done
    finish
fi
for tool in pnmenlarge pamdepth pnmtopng pngquant python3; do
    command -v $tool >/dev/null || { echo "gallery: no $tool here"; exit 1; }
done
make -s -C examples/microcontroller ../../build/microcontroller/picture.565 || exit 1
pnmenlarge 3 build/microcontroller/picture.ppm >build/microcontroller.ppm || exit 1
mkdir -p build/parts && python3 examples/programs/thumbnail/test/parts.py build/parts || exit 1
build/thumbnail build/parts/assembly.obj build/drawing.ppm --views front,right,top,iso --ortho \
    --hidden --ids --dimensions --size 1200x900 || exit 1
for ppm in out/[0-9]*.ppm out/gallery.ppm out/elsewhere.ppm build/microcontroller.ppm build/drawing.ppm; do
    least=99
    case $ppm in */20_*) least=97 ;; */39_*) least=92 ;; esac    # large; looked at
    png=examples/pictures/$(basename "$ppm" .ppm).png
    if ! pnmtopng "$ppm" 2>/dev/null |
        pngquant --quality $least-100 --speed 1 --strip 256 - >"$png" 2>/dev/null; then
        pamdepth 127 "$ppm" 2>/dev/null | pnmtopng -compression 9 >"$png" 2>/dev/null || exit 1
    fi
    echo "$png $(wc -c <"$png")"
done
pnmtopng -compression 9 out/knot.ppm 2>/dev/null >examples/pictures/knot.png || exit 1    # a test compares it
echo "$(cat examples/pictures/*.png | wc -c) bytes of PNG in all"
