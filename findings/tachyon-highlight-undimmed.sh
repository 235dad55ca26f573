#!/bin/sh
# Tachyon 0.99 b6: neither attenuation nor the soft rim of a spotlight dims a highlight; it is cut off where the spot's light is 0.
# Most would guess that a highlight falls with the light that makes it, as the diffuse term does.
cd "$(dirname "$0")/.." || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
(cd "$T" && apt-get download tachyon-bin-nox=0.99~b6+dsx-10+b1 libtachyon-mt-0=0.99~b6+dsx-10+b1 >/dev/null 2>&1 &&
    for deb in *.deb; do dpkg -x "$deb" . || exit 1; done) || exit 77
bin=$(find "$T/usr/bin" -name 'tachyon-nox' -type f | head -n 1)
lib=$T/lib && mkdir "$lib" && ln -s "$(find "$T/usr/lib" -name 'libtachyon*.so.0.0.0' | head -n 1)" "$lib/libtachyon.so.0" || exit 77
draw() {    # constant attenuation, diffuse, phong: the green byte of the pixel 20 of 100 right of the middle
    printf 'begin_scene\nresolution 100 100\ncamera\nprojection orthographic\nzoom 0.4\naspectratio 1\nantialiasing 0\nraydepth 1\ncenter 0 0 5\nviewdir 0 0 -1\nupdir 0 1 0\nend_camera\n' >"$T/a.dat"
    printf 'light center 0 0 3 rad 0.001 attenuation constant %s linear 0 quadratic 0 color 1 1 1\nbackground 0 0 0\n' "$1" >>"$T/a.dat"
    printf 'sphere center 0 0 0 rad 1\ntexture ambient 0 diffuse %s specular 0 opacity 1\nphong plastic %s phong_size 5 color 1 1 1 texfunc 0\nend_scene\n' "$2" "$3" >>"$T/a.dat"
    LD_LIBRARY_PATH="$lib" "$bin" "$T/a.dat" -o "$T/a.ppm" -format PPM -numthreads 1 >/dev/null 2>&1 || exit 77
    tail -c 30000 "$T/a.ppm" | od -An -tu1 -v -w3 | sed -n 5071p | awk '{ print $2 }'
}
d1=$(draw 1 0.8 0) d2=$(draw 4 0.8 0) s1=$(draw 1 0 0.8) s2=$(draw 4 0 0.8)
echo "Tachyon 0.99 b6, attenuation 1 and 4: diffuse $d1 $d2, highlight $s1 $s2"
[ "$d1" -gt $((3 * d2)) ] && [ "$s1" = "$s2" ] && [ "$s1" -gt 20 ]
