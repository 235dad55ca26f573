#!/bin/sh
# windows.sh - programs that mingw-w64 builds for Windows, run under Wine: all of the runner, the
# built-in scenes, thumbnail, compare and batch with threads of Windows and with names that are no
# ASCII.  Their pictures have the bits of this system's.  view needs a POSIX terminal and is left out.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
cc=x86_64-w64-mingw32-gcc TOP=$PWD
find_wine
if [ -z "$wine" ] || ! there $cc || ! "$wine" cmd /c exit >/dev/null 2>&1; then
    left_out "programs for Windows: no mingw-w64 or no Wine"
    finish
fi

built="-std=c99 -Wall -Wextra -Werror -O1 -ffp-contract=off -I."
# The implementation is in main.c: the sections are compiled once for all builds of it.
sections() {
    mkdir "$T/units" && for f in tests/unit/*.c; do
        [ "$f" = tests/unit/main.c ] || echo "$PWD/$f"
    done | (cd "$T/units" && xargs $cc $built -I"$TOP" -w -DSHADE__IMPLEMENTED -c)
}
check "the sections build" sections
check "the runner builds" $cc $built -w -static tests/unit/main.c "$T"/units/*.o -lm -o "$T/runner.exe"
check "the runner" "$wine" "$T/runner.exe"
# On any processor each build of the loops for vectors runs, by the section that calls them most.
check "the runner of all builds builds" $cc $built -w -static $level_chosen tests/unit/main.c \
    "$T"/units/*.o -lm -o "$T/level.exe"
for level in $(levels); do
    check "the runner of build $level" env LEVEL=$level "$wine" "$T/level.exe" lanes
done
check "the scenes build" $cc $built -w -static -DSCENE_MAIN tests/unit/scene.c -lm -o "$T/scenes.exe"
# G12
scenes() {
    grep '^{' tests/unit/scenes.h >"$T/want"
    "$wine" "$T/scenes.exe" | tr -d '\r' >"$T/got" && cmp "$T/want" "$T/got"
}
check "the scenes have the hashes of all systems" scenes

# zlib for Windows: libz-mingw-w64-dev
zlib=
echo 'int main(void) { return !zlibVersion(); }' | $cc -include zlib.h -x c - -static -lz -o "$T/zlib.exe" \
    2>/dev/null && zlib="-DMODEL_ZLIB -lz"
[ "$zlib" ] || left_out "3MF on Windows: no libz-mingw-w64-dev"
for p in thumbnail compare batch; do
    check "$p builds for Windows" $cc $built -DSHADE_NO_DISPATCH -static examples/programs/$p/$p.c $zlib -lm -lshell32 -o "$T/$p.exe"
    check "$p builds" cc $built -DSHADE_NO_DISPATCH -pthread examples/programs/$p/$p.c $zlib -lm -o "$T/$p"
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
ln "$T/bild ж 絵.ppm" "$T/link.ppm"
head -c 99999 /dev/zero >>"$T/link.ppm"
check "a picture that is there is written over" there_too "$name" "$T/bild ж 絵.ppm"
check "to the bit again" bits "$T/bild ж 絵.ppm"
check "it stays the same file" bits "$T/link.ppm"
head -c 1000 "$T/linux.ppm" >"$T/link.ppm"
check "a shorter one too" there_too "$name" "$T/bild ж 絵.ppm"
check "and it" bits "$T/link.ppm"
# a model's materials lie in its folder, which Windows names with a backslash
mkdir "$T/ordner"
printf 'mtllib red.mtl\nusemtl r\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >"$T/ordner/red.obj"
printf 'newmtl r\nKd 1 0 0\n' >"$T/ordner/red.mtl"
check "a red triangle here" here "$T/ordner/red.obj" "$T/red.ppm"
check "a red triangle under Wine" there_too "$(echo "Z:$T/ordner/red.obj" | tr / '\\')" "$T/red there.ppm"
check "is as red" cmp "$T/red.ppm" "$T/red there.ppm"
if [ "$zlib" ] && there python3; then
    check "a 3MF" python3 examples/programs/thumbnail/test/bomb.py "$T/a.3mf" 100
    check "a 3MF here" here "$T/a.3mf" "$T/a.ppm"
    check "a 3MF under Wine" there_too "$T/a.3mf" "$T/a there.ppm"
    check "to the bit" cmp "$T/a.ppm" "$T/a there.ppm"
fi
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

# ---- nothing is lost: the old picture stays where the new one fails, and no part of a file stays
parts() { ls "$T" | grep -c '\.part$'; }
check "no parts stay" same "$(parts)" 0
cp "$T/linux.ppm" "$T/kept.ppm"
late() {
    there_too --max-seconds 1 --size 8000x8000 --samples 2 "$name" "$T/kept.ppm" 2>"$T/said"
    same "$? $(tr -d '\r' <"$T/said" | grep -c 'gave up after --max-seconds while')" "1 1"
}
check "--max-seconds" late
check "leaves the picture that was there" bits "$T/kept.ppm"
itself() { there_too "$T/würfel куб 立方.obj" "$T/WÜRFEL куб 立方.OBJ" 2>"$T/said"; }
cp "$name" "$T/model.copy"
itself
check "a model is not replaced by its picture" cmp "$name" "$T/model.copy"

# ---- memory: Wine lets a process have more than its job allows, so here counts what Windows is asked for
cat >"$T/limit.c" <<'END'
#include <windows.h>
#include <stdio.h>
static double limit_asked;
static int limit_ours;
static BOOL limit_set(HANDLE job, JOBOBJECTINFOCLASS kind, void *data, DWORD size)
{
    const JOBOBJECT_EXTENDED_LIMIT_INFORMATION *is = data;
    if (job && kind == JobObjectExtendedLimitInformation && size == sizeof *is &&
        is->BasicLimitInformation.LimitFlags == JOB_OBJECT_LIMIT_PROCESS_MEMORY)
        limit_asked = (double)is->ProcessMemoryLimit;
    return TRUE;
}
static BOOL limit_assign(HANDLE job, HANDLE process)
{
    limit_ours = job && process == GetCurrentProcess();
    return TRUE;
}
#define SetInformationJobObject limit_set
#define AssignProcessToJobObject limit_assign
#include "examples/kit/command/guard.h"
int main(int count, char **word)
{
    guard_begin(count > 1 ? atoi(word[1]) : 0);
    printf("%.0f", limit_ours ? limit_asked / 1e6 : -1);
    return 0;
}
END
check "what asks for a limit builds" $cc $built -w -static "$T/limit.c" -lshell32 -o "$T/limit.exe"
check "--max-memory 64" same "$("$wine" "$T/limit.exe" 64)" 64
by_default() {                  # a quarter of what is free: between that of what nothing uses and of all
    limit=$("$wine" "$T/limit.exe")
    awk -v limit="$limit" '/^MemTotal/ { all = $2 / 4000 } /^MemFree/ { free = $2 / 4000 }
        END { print limit, free, all; exit !(limit >= 1000 && limit >= 0.9 * free && (limit == 1000 || limit < all)) }' \
        /proc/meminfo
}
check "by default a quarter of what is free, 1000 megabytes at least" by_default

# ---- batch
turn="--frames 5 --size 60x40 --samples 1 --quick"
there_batch() { "$wine" "$T/batch.exe" "$@"; }
check "batch here" "$T/batch" "$name" $turn --out "$T/own"
check "batch under Wine" there_batch "$name" $turn --out "$T/bilder ж 絵"
check "its frames to the bit" diff -r "$T/own" "$T/bilder ж 絵"
: >"$T/bilder ж 絵/00002.ppm"
rm "$T/bilder ж 絵/00004.ppm"
check "two are missing" same "$(there_batch "$name" $turn --out "$T/bilder ж 絵" --missing | tr -d '\r' | tr '\n' ' ')" "00002 00004 "
check "resumed" there_batch "$name" $turn --out "$T/bilder ж 絵"
check "to the bit" diff -r "$T/own" "$T/bilder ж 絵"
piped() { there_batch "$name" $turn --pipe >"$T/frames" && cat "$T"/own/*.ppm | cmp - "$T/frames"; }
check "through a pipe" piped
strips() { there_batch "$name" --strips 3 --size 61x47 --out "$T/strips" && "$T/batch" "$name" --strips 1 --size 61x47 --pipe >"$T/poster.ppm" &&
    cat "$T"/strips/*.ppm | cmp - "$T/poster.ppm"; }
check "strips of a poster" strips
# a program in ffmpeg's place: the file that its last word names gets two boxes of an MP4, an empty
# one and one with what is read
cat >"$T/ffmpeg.c" <<'END'
#include <stdio.h>
#include <fcntl.h>
#include <io.h>
#include <wchar.h>
int wmain(int n, wchar_t **word)
{
    FILE *film = _wfopen(word[n - 1], L"wb");
    unsigned size = 8;
    int c;
    _setmode(_fileno(stdin), _O_BINARY);
    if (film) fwrite("\0\0\0\10moov\0\0\0\0mdat", 1, 16, film);
    for (; film && (c = getchar()) != EOF; size++) putc(c, film);
    if (film && !fseek(film, 8, SEEK_SET))
        for (int k = 24; k >= 0; k -= 8) putc(size >> k & 255, film);
    return !film || fclose(film) || wcscmp(word[1], L"-v");
}
END
no_ffmpeg() {
    there_batch "$name" $turn --film "$T/kept.mp4" 2>"$T/said" && return 1
    grep -q 'ffmpeg, which is not installed' "$T/said" && same "$(cat "$T/kept.mp4")" kept
}
echo kept >"$T/kept.mp4"
check "a film without ffmpeg leaves what was there" no_ffmpeg
mkdir "$T/bin"
check "a program in its place" $cc -municode "$T/ffmpeg.c" -o "$T/bin/ffmpeg.exe"
film() { WINEPATH=$(echo "Z:$T/bin" | tr / '\\') there_batch "$name" $turn --film "$T/film ж 絵.mp4"; }
check "a film" film
of_all() { tail -c +17 "$T/film ж 絵.mp4" | cmp "$T/frames" -; }
check "of all frames" of_all
check "no parts stay" same "$(parts)" 0
finish
