#!/bin/sh
# gallery.sh - the pictures of the README: out/*.ppm as PNG.  Needs pnmtopng (netpbm) or ImageMagick.
mkdir -p examples/pictures
for ppm in out/[0-9]*.ppm; do
    png=examples/pictures/$(basename "$ppm" .ppm).png
    if command -v pnmtopng >/dev/null; then pnmtopng -compression 9 "$ppm" >"$png" 2>/dev/null
    else magick "$ppm" -strip "$png" || convert "$ppm" -strip "$png"; fi || exit 1
    echo "$png"
done
