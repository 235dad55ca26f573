#!/bin/sh
# gallery.sh - the pictures of the README: out/*.ppm made smaller, as PNG of 7 bits a channel, or 6
# where that takes more than 60 kB (70 for one that is dark, where steps show).  Needs netpbm
# (pamscale, pamdepth, pnmtopng).
mkdir -p examples/pictures
command -v pamscale >/dev/null && command -v pnmtopng >/dev/null ||
    { echo "gallery: no netpbm here"; exit 1; }
make -s -C examples/microcontroller ../../build/microcontroller/picture.565 || exit 1
for ppm in out/[0-9]*.ppm out/gallery.ppm build/microcontroller/picture.ppm; do
    name=$(basename "$ppm" .ppm) width=480 most=60000
    case $name in 01_* | 07_*) width=360 ;; 06_*) width=520 ;; 21_*) most=70000 ;; gallery) width=850 ;;
        picture) name=microcontroller width=320 ;; esac
    for levels in 127 63; do
        png=examples/pictures/$name.png
        pamscale -xsize $width -filter box "$ppm" 2>/dev/null | pamdepth $levels 2>/dev/null |
            pnmtopng -compression 9 >"$png" 2>/dev/null || exit 1
        [ "$(wc -c <"$png")" -gt "$most" ] || break
    done
    echo "$png $(wc -c <"$png")"
done
