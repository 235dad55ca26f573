#!/bin/sh
# windows.sh - programs that mingw-w64 builds for Windows, run under Wine: all of the runner, the
# built-in scenes, thumbnail and compare with threads of Windows and with names that are no ASCII.
# Their pictures have the bits of this system's.  batch and view need POSIX and are left out.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
cc=x86_64-w64-mingw32-gcc
wine=
for w in wine64 wine /usr/lib/wine/wine64; do there "$w" && wine=$w && break; done
export WINEPREFIX="$T/wine" WINEDEBUG=-all
if [ -z "$wine" ] || ! there $cc || ! "$wine" cmd /c exit >/dev/null 2>&1; then
    left_out "programs for Windows: no mingw-w64 or no Wine"
    finish
fi
# Wine's server writes into its folder until it ends.
stop_wine() {
    for w in wineserver /usr/lib/wine/wineserver64; do there "$w" && "$w" -k && "$w" -w && break; done
}
trap 'stop_wine >/dev/null 2>&1; rm -rf "$T"' EXIT

built="-std=c99 -Wall -Wextra -Werror -O1 -ffp-contract=off -I."
check "the runner builds" $cc $built -w -static tests/unit/main.c -lm -o "$T/runner.exe"
check "the runner" "$wine" "$T/runner.exe"
check "the scenes build" $cc $built -w -static -DSCENE_MAIN tests/unit/scene.c -lm -o "$T/scenes.exe"
# G12
scenes() {
    grep '^{' tests/unit/scenes.h >"$T/want"
    "$wine" "$T/scenes.exe" | tr -d '\r' >"$T/got" && cmp "$T/want" "$T/got"
}
check "the scenes have the hashes of all systems" scenes

for p in thumbnail compare; do
    check "$p builds for Windows" $cc $built -static examples/programs/$p/$p.c -lm -lshell32 -o "$T/$p.exe"
    check "$p builds" cc $built -pthread examples/programs/$p/$p.c -lm -o "$T/$p"
done
# A cube cut from a grid of triangles, under a name of three alphabets.
name="$T/würfel куб 立方.obj"
awk 'BEGIN {
    n = 24
    for (face = 0; face < 6; face++) for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
        a = 2 * i / n - 1; b = 2 * j / n - 1; c = face % 2 ? 1 : -1
        if (face < 2) print "v", c, a, b; else if (face < 4) print "v", a, c, b
        else print "v", a, b, c
    }
    for (face = 0; face < 6; face++) for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
        v = face * (n + 1) * (n + 1) + i * (n + 1) + j + 1
        print "f", v, v + 1, v + n + 2; print "f", v, v + n + 2, v + n + 1
    }
}' >"$name"
here() { "$T/thumbnail" --size 300x200 "$@"; }
there_too() { "$wine" "$T/thumbnail.exe" --size 300x200 "$@"; }
bits() { cmp "$T/linux.ppm" "$1"; }
check "thumbnail here" here "$name" "$T/linux.ppm"
check "thumbnail under Wine" there_too "$name" "$T/bild ж 絵.ppm"
check "its picture to the bit" bits "$T/bild ж 絵.ppm"
check "a picture that is there is replaced" there_too "$name" "$T/bild ж 絵.ppm"
check "to the bit again" bits "$T/bild ж 絵.ppm"
piped() { there_too "$name" - >"$T/piped.ppm"; }
check "thumbnail to standard output" piped
check "bytes, not lines of text" bits "$T/piped.ppm"
no_model() {
    there_too "$T/fehlt ж.obj" "$T/none.ppm" >"$T/said" 2>&1 && return 1
    grep -q 'fehlt ж.obj' "$T/said" && [ ! -e "$T/none.ppm" ]
}
check "a model that is not there is named in UTF-8" no_model
check "compare: the same" "$wine" "$T/compare.exe" "$T/linux.ppm" "$T/bild ж 絵.ppm"
check "compare: a model in place of a picture" "$wine" "$T/compare.exe" "$T/linux.ppm" "$name"
differs() {                     # the status is 1, the difference is a picture; twice, over itself
    head -c 90000 "$T/linux.ppm" >"$T/other.ppm"
    head -c 90015 /dev/zero | tail -c 90015 >>"$T/other.ppm"
    for turn in 1 2; do
        "$wine" "$T/compare.exe" --difference "$T/unterschied ж.ppm" "$T/linux.ppm" "$T/other.ppm"
        [ $? -eq 1 ] || return 1
    done
    "$T/compare" --difference "$T/difference.ppm" "$T/linux.ppm" "$T/other.ppm"
    cmp "$T/difference.ppm" "$T/unterschied ж.ppm"
}
check "compare: a difference, its picture to the bit" differs
from_input() { "$wine" "$T/compare.exe" - "$T/linux.ppm" <"$T/linux.ppm"; }
check "compare: from standard input" from_input
finish
