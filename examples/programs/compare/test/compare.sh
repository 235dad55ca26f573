#!/bin/sh
# compare.sh - examples/programs/compare/compare.c: its numbers beside sums by awk, its exit status, its difference
# picture, models in place of pictures, and what it says of bad input.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}

status() {
    want=$1; shift
    "$@" >"$T/out" 2>"$T/err"
    same $? "$want" || { cat "$T/err"; return 1; }
}
# Status 2, one line on stderr that holds a text, nothing on stdout
refused() {
    text=$1; shift
    status 2 "$@" && same "$(wc -l <"$T/err")" 1 && grep -q "^compare: .*$text" "$T/err" &&
        test ! -s "$T/out" || { cat "$T/err"; return 1; }
}

compare=$T/compare
FLAGS="-std=c99 -Wall -Wextra -O1 -ffp-contract=off -pthread -I."
$CC $FLAGS -DSHADE_IMPLEMENTATION -x c -c shade.h -o "$T/shade.o"
check "it compiles" $CC $FLAGS -DSHADE__IMPLEMENTED examples/programs/compare/compare.c "$T/shade.o" -lm -o "$compare"
[ -x "$compare" ] || finish

# ---- numbers ------------------------------------------------------------------------------------
# Two pictures of 23 x 17 as lists of numbers, the second up to 9 above the first here and there, as
# plain and as binary files
awk -v dir="$T" 'BEGIN {
    srand(7)
    for (k = 0; k < 3 * 23 * 17; k++) {
        v = int(rand() * 247); print v >(dir "/a.txt")
        print v + (rand() < 0.2 ? int(rand() * 10) : 0) >(dir "/b.txt")
    }
}'
{ echo "P3 23 17 255"; cat "$T/a.txt"; } >"$T/a.ppm"
{ printf 'P3 # text, 9 9 9\n23\t17\n255\r\n'; cat "$T/b.txt"; } >"$T/b.ppm"
binary() {                      # list, binary PPM of it
    printf 'P6\n23 17\n255\n' >"$2"
    printf "$(awk '{ printf "\\%03o", $1 }' "$1")" >>"$2"
}
binary "$T/a.txt" "$T/a6.ppm"
binary "$T/b.txt" "$T/b6.ppm"
# max, mean, PSNR and count beyond $1, as compare prints them
oracle() {
    paste "$T/a.txt" "$T/b.txt" | awk -v limit="$1" '
        { d = $2 - $1; sum += d; squares += d * d; if (d > max) { max = d; at = int((NR - 1) / 3) }
          if (d > limit) beyond[int((NR - 1) / 3)] = 1 }
        END {
            for (k in beyond) n++
            printf "max    %.4g at %d,%d\nmean   %.4g\n", max, at % 23, int(at / 23), sum / NR
            printf "PSNR   %.2f dB\n", 10 * log(255 * 255 / (squares / NR)) / log(10)
            printf "count  %d of %d pixels beyond %s, 0 allowed\n", n, NR / 3, limit
        }'
}
numbers() {                     # limit, first, second
    status 1 "$compare" --limit "$1" "$2" "$3"
    oracle "$1" >"$T/want"
    echo different >>"$T/want"
    diff "$T/want" "$T/out"
}
check "the oracle sees differences" test "$(oracle 5 | sed -n 's/^count  \([0-9]*\) .*/\1/p')" -gt 9
for limit in 0 2 5; do
    check "max, mean, PSNR, count beyond $limit" numbers $limit "$T/a.ppm" "$T/b.ppm"
done
check "binary files" numbers 2 "$T/a6.ppm" "$T/b6.ppm"
check "binary beside plain" numbers 2 "$T/a6.ppm" "$T/b.ppm"
n=$(oracle 5 | sed -n 's/^count  \([0-9]*\) .*/\1/p')
check "as many as may differ" status 0 "$compare" --limit 5 --count "$n" "$T/a.ppm" "$T/b.ppm"
check "one more" status 1 "$compare" --limit 5 --count $((n - 1)) "$T/a.ppm" "$T/b.ppm"
check "percent, enough" status 0 "$compare" "$T/a.ppm" "$T/b.ppm" --limit 5 \
    --count "$(((n * 100 + 390) / 391))%"
check "percent, too few" status 1 "$compare" "$T/a.ppm" "$T/b.ppm" --limit 5 \
    --count "$((n * 100 / 391 - 1))%"
check "all within the limit" status 0 "$compare" --limit 9 "$T/a.ppm" "$T/b.ppm"
check "the same picture" status 0 "$compare" "$T/a.ppm" "$T/a6.ppm"
check "its PSNR" grep -q '^PSNR   infinite$' "$T/out"
check "standard input" sh -c "'$compare' - '$T/a.ppm' <'$T/a6.ppm'"
printf 'P6 2 1 65535\n\0\0\377\377\200\0\1\1\2\2\3\3' >"$T/wide.ppm"
printf 'P6 2 1 255\n\0\377\200\1\2\3' >"$T/narrow.ppm"
check "16 bits beside 8" status 0 "$compare" --limit 0.5 "$T/wide.ppm" "$T/narrow.ppm"
check "32768 of 65535 is no 128 of 255" grep -q '^max    0.4981 at 0,0$' "$T/out"
printf 'P5 3 1 255\n\1\2\3' >"$T/grey.pgm"
printf 'P3 3 1 255 1 1 1 2 2 2 3 3 3' >"$T/grey.ppm"
printf 'P3 2 1 255 1 1 1 2 2 2' >"$T/g1.ppm"
printf 'P3 2 1 255 1 1 1 2 5 2' >"$T/g2.ppm"
check "quiet" status 1 "$compare" --quiet "$T/a.ppm" "$T/b.ppm"
check "no word" same "$(cat "$T/out" "$T/err")" ""
check "JSON" status 1 "$compare" --json --limit 2 "$T/g1.ppm" "$T/g2.ppm"
check "has all numbers" python3 -c 'import json, sys
assert json.load(sys.stdin) == {"result": "different", "width": 2, "height": 1, "max": 3, "x": 1, "y": 0,
    "mean": .5, "psnr": 46.37, "count": 1, "pixels": 2, "limit": 2, "allowed": 0}' <"$T/out"
check "JSON of what is the same" status 0 "$compare" --json "$T/g1.ppm" "$T/g1.ppm"
check "has no PSNR" python3 -c 'import json, sys
assert json.load(sys.stdin)["psnr"] is None' <"$T/out"
check "JSON of two sizes" status 1 "$compare" --json "$T/g1.ppm" "$T/grey.pgm"
check "has both" python3 -c 'import json, sys
assert json.load(sys.stdin) == {"result": "different", "sizes": [[2, 1], [3, 1]]}' <"$T/out"
check "grey is three equal channels" status 0 "$compare" "$T/grey.pgm" "$T/grey.ppm"
check "another size is different" status 1 "$compare" --limit 255 "$T/a.ppm" "$T/grey.ppm"
check "and said" grep -q '^size   23 x 17 and 3 x 1$' "$T/out"

# ---- the difference picture ---------------------------------------------------------------------
printf 'P3 4 1 255  80 80 80  80 80 80  80 80 80  80 80 80' >"$T/g.ppm"
printf 'P3 4 1 255  80 80 80  80 81 80  80 80 83  255 80 80' >"$T/h.ppm"
colors() {
    status 1 "$compare" --limit 2 --difference "$T/d.ppm" "$T/g.ppm" "$T/h.ppm" || return 1
    same "$(head -c 11 "$T/d.ppm" | tr '\n' ' ')" "P6 4 1 255 " &&
        same "$(tail -c +12 "$T/d.ppm" | od -An -v -tu1 | tr -s ' \n' ' ')" \
            " 40 40 40 120 120 0 156 0 0 223 0 0 "
}
check "grey, yellow, red by the difference" colors
check "two sizes have a picture" status 1 "$compare" --difference "$T/d.ppm" "$T/g.ppm" "$T/grey.ppm"
check "of the larger one" same "$(head -c 11 "$T/d.ppm" | tr '\n' ' ')" "P6 4 1 255 "
check "red where there is one alone" same "$(tail -c 3 "$T/d.ppm" | od -An -v -tu1 | tr -s ' \n' ' ')" " 255 0 0 "
status 1 "$compare" --limit 2 --difference "$T/d.ppm" "$T/g.ppm" "$T/h.ppm"
check "the numbers stay" grep -q '^count  2 of 4 pixels beyond 2, 0 allowed$' "$T/out"
check "nothing is left beside it" test ! -e "$T/d.ppm.part"
mkdir "$T/directory"
check "difference into no directory" refused "/d.ppm: No such file" "$compare" \
    --difference "$T/none/d.ppm" "$T/g.ppm" "$T/h.ppm"
check "difference over a directory" refused "irectory" "$compare" --difference "$T/directory" \
    "$T/g.ppm" "$T/h.ppm"
check "and nothing beside it" test ! -e "$T/directory.part"
if [ -c /dev/full ]; then
    check "difference onto a full device" refused "/dev/full: No space" "$compare" \
        --difference /dev/full "$T/g.ppm" "$T/h.ppm"
    full() { "$compare" "$T/a.ppm" "$T/a.ppm" >/dev/full 2>"$T/err"; same $? 2; }
    check "numbers onto a full device" full
    check "help onto a full device" refused "output: No space" \
        sh -c "exec '$compare' --help >/dev/full"
fi

# ---- bad input ----------------------------------------------------------------------------------
bad() {                         # what, text, bytes by printf
    printf "$3" >"$T/bad.ppm"
    check "$1" refused "$2" "$compare" "$T/a.ppm" "$T/bad.ppm"
    check "$1, first" refused "$2" "$compare" "$T/bad.ppm" "$T/a.ppm"
}
bad "an empty file" "bad.ppm: an empty file" ''
bad "another kind of file" "neither PPM nor PGM" 'solid cube'
bad "a bit map" "neither PPM nor PGM" 'P4 8 1\n\1'
bad "a header cut off" "a header without" 'P6 23'
bad "a negative width" "a header without" 'P6 -23 17 255\n'
bad "no height" "a header without" 'P6 23 0 255\n'
bad "a maximum of 0" "a header without" 'P6 23 17 0\n'
bad "a maximum of 65536" "a header without" 'P6 23 17 65536\n'
bad "a row beyond memory" "more than 16777216 pixels" 'P6 2000000000 2000000000 255\n'
bad "a number beyond 32 bits" "more than 16777216 pixels" 'P6 99999999999999999999 1 255\n'
bad "rows cut off" "ends too early" 'P6 23 17 255\nabc'
bad "numbers cut off" "ends too early" 'P3 23 17 255 1 2 3'
bad "a negative number" "what is no number" 'P3 23 17 255 1 2 -3'
bad "a number above the maximum" "above its own maximum" 'P3 23 17 255 1 2 256'
bad "a sample above the maximum" "above its own maximum" 'P6 23 17 100 \377\377\377\377%069d'
check "no file" refused "none.ppm: No such file" "$compare" "$T/none.ppm" "$T/a.ppm"
check "a directory" refused "directory: Is a directory" "$compare" "$T/a.ppm" "$T/directory"
cut() {
    refused "ends too early" "$compare" --difference "$T/cut.ppm" "$T/a.ppm" "$T/bad.ppm" &&
        test ! -e "$T/cut.ppm" && test ! -e "$T/cut.ppm.part"
}
head -c 700 "$T/a6.ppm" >"$T/bad.ppm"
check "no difference picture of a picture cut off" cut
check "an unknown option" refused "unknown option --frobnicate" "$compare" --frobnicate "$T/a.ppm" "$T/a.ppm"
check "an option without value" refused "needs a value" "$compare" "$T/a.ppm" "$T/a.ppm" --limit
for value in x -1 nan 3x ''; do
    check "a limit of \"$value\"" refused "--limit $value: a channel" "$compare" "$T/a.ppm" \
        "$T/a.ppm" --limit "$value"
done
check "a bad count" refused "--count x: N pixels, or N % of them" "$compare" --count x "$T/a.ppm" "$T/a.ppm"
# ---- files that stay ----------------------------------------------------------------------------
kept() {                        # text, file, command ...
    text=$1 file=$2; shift 2
    cp "$file" "$T/before"
    refused "$text" "$@" && cmp "$file" "$T/before"
}
cp "$T/a.ppm" "$T/d.jpg"; cp "$T/a.ppm" "$T/d.obj"
for k in d.jpg d.obj; do
    check "no PPM into $k" kept "--difference .*$k: FILE ends in .ppm" "$T/$k" "$compare" "$T/a.ppm" \
        "$T/b.ppm" --difference "$T/$k"
done
check "no difference over a picture that is compared" kept "a.ppm is read" "$T/a.ppm" "$compare" \
    "$T/b.ppm" "$T/a.ppm" --difference "$T/./a.ppm"
if mkfifo "$T/rows" 2>/dev/null; then
    for signal in INT TERM; do  # rows that do not come
        env --default-signal=INT "$compare" "$T/a.ppm" - --difference "$T/cut.ppm" <>"$T/rows" \
            >/dev/null 2>&1 &
        printf 'P6 23 17 255\n' >"$T/rows"
        soon sh -c "ls $T/cut.ppm.*.part"
        kill -$signal $!
        wait $!
        check "SIG$signal ends it" test $? -gt 128
        check "SIG$signal: no difference picture" no test -e "$T"/cut.ppm*
    done
    check "time is up" sh -c "printf 'P6 23 17 255\n' >'$T/rows' & '$compare' '$T/a.ppm' - --max-seconds 1 \
        <>'$T/rows' 2>'$T/err'; [ \$? -eq 2 ] && grep 'gave up after --max-seconds while comparing' '$T/err'"
fi
check "a limit of all" refused "--limit 256: a channel" "$compare" --limit 256 "$T/a.ppm" "$T/a.ppm"
check "more than all" refused "--count 101%: N pixels" "$compare" --count 101% "$T/a.ppm" "$T/a.ppm"
check "a size of pictures" refused "--size, --rotate" "$compare" --size 8x8 "$T/a.ppm" "$T/a.ppm"
check "a limit in percent" refused "--limit 3%: a channel" "$compare" --limit 3% "$T/a.ppm" "$T/a.ppm"
check "three pictures" refused "one file too many" "$compare" "$T/a.ppm" "$T/b.ppm" "$T/a.ppm"
check "standard input twice" refused "only one picture" "$compare" - -
check "one picture: how to call it" status 2 "$compare" "$T/a.ppm"
check "that is printed" grep -q '^usage: compare' "$T/err"
for k in "--limit 0x2" "--limit inf" "--limit 256" "--count 0x10" "--count 0x10%" "--count inf" "--count 101%"; do
    check "$k" refused "$k: " "$compare" "$T/a.ppm" "$T/a.ppm" $k
done
check "help" status 0 "$compare" --help
check "that too" grep -q '^usage: compare' "$T/out"

# ---- models in place of pictures ----------------------------------------------------------------
awk 'BEGIN { print "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0"
             print "f 1 2 3 4\nf 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1" }' >"$T/tent.obj"
sed 's/^v 0 2 0/v 0 2.2 0/' "$T/tent.obj" >"$T/higher.obj"
check "a model is itself" status 0 "$compare" "$T/tent.obj" "$T/tent.obj" --size 60x40
check "as large as --size says" grep -q '^count  0 of 2400 pixels' "$T/out"
check "and no other" status 1 "$compare" "$T/tent.obj" "$T/higher.obj" --size 60x40
check "thumbnail" $CC $FLAGS -DSHADE__IMPLEMENTED examples/programs/thumbnail/thumbnail.c "$T/shade.o" -lm -o "$T/thumbnail"
drawn() {                       # options: what thumbnail draws, beside the model itself
    "$T/thumbnail" "$T/tent.obj" "$T/tent.ppm" --size 64x48 "$@" &&
        status 0 "$compare" "$T/tent.ppm" "$T/tent.obj" "$@" &&
        status 0 "$compare" "$T/tent.obj" "$T/tent.ppm" "$@"
}
check "a model is the picture that thumbnail draws" drawn
check "with options" drawn --samples 1 --rotate 70 --up -z --material gold --background '#204060'
check "and others" drawn --no-shadow --model phong --shading face --color red --threads 1
check "a view" drawn --view 200,-30,1.5
check "the quick light" drawn --quick
check "not with other options" status 1 "$compare" "$T/tent.ppm" "$T/tent.obj"
check "its difference picture" status 1 "$compare" "$T/a.ppm" "$T/tent.obj" --difference "$T/tent.d.ppm"
check "has the picture's size" same "$(head -c 11 "$T/tent.d.ppm" | tr '\n' ' ')" "P6 23 17 25"
check "a size of its own is another size" status 1 "$compare" "$T/a.ppm" "$T/tent.obj" --size 9x9
check "which is said" grep -q '^size   23 x 17 and 9 x 9$' "$T/out"
printf 'v 0 0 0\nv 1 0\n' >"$T/bad.obj"
check "a bad model" refused "bad.obj:2: expected a number" "$compare" "$T/a.ppm" "$T/bad.obj"
check "no model" refused "none.obj: No such file" "$compare" "$T/none.obj" "$T/a.ppm"
check "a format that needs assimp" refused "tent.glb" "$compare" "$T/a.ppm" "$T/tent.glb"
check "a size that is none" refused "--size 0x5: pixels of the picture" "$compare" "$T/a.ppm" \
    "$T/tent.obj" --size 0x5
# ---- PNG, by stb --------------------------------------------------------------------------------
if printf '#include "stb/stb_image.h"\n' | $CC -fsyntax-only -x c - 2>/dev/null; then
    check "it compiles with stb" $CC $FLAGS -DSHADE__IMPLEMENTED -DMODEL_STB \
        examples/programs/compare/compare.c "$T/shade.o" -lm -o "$compare"
    # 2 x 1, 8 bits a channel: 1 2 3, 4 5 6
    {   printf '\211PNG\15\12\32\12\0\0\0\15IHDR\0\0\0\2\0\0\0\1\10\2\0\0\0\173\100\350\335'
        printf '\0\0\0\22IDATx\1\1\7\0\370\377\0\1\2\3\4\5\6\0\77\0\26hA\137\215'
        printf '\0\0\0\0IEND\256B\140\202'
    } >"$T/two.png"
    printf 'P3 2 1 255 1 2 3 4 5 6' >"$T/two.ppm"
    printf 'P3 2 1 255 1 2 3 4 5 7' >"$T/other.ppm"
    check "PNG beside PPM" status 0 "$compare" "$T/two.png" "$T/two.ppm"
    check "not the same" status 1 "$compare" "$T/two.png" "$T/other.ppm"
    check "from standard input" sh -c "'$compare' '$T/two.ppm' - <'$T/two.png'"
    head -c 50 "$T/two.png" >"$T/cut.png"
    check "PNG cut off" refused "cut.png: " "$compare" "$T/cut.png" "$T/two.ppm"
    check "no picture" refused "shade.h: " "$compare" shade.h "$T/two.ppm"
    # alpha and 16 bits, by a writer of PNG in Python
    python3 - "$T" <<'END'
import struct, sys, zlib
def png(name, width, depth, kind, *samples):
    raw = b"\0" + b"".join(struct.pack(">H" if depth == 16 else "B", s) for s in samples)
    def chunk(k, d): return struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d))
    open(f"{sys.argv[1]}/{name}.png", "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(
        b"IHDR", struct.pack(">IIBBBBB", width, 1, depth, kind, 0, 0, 0)) +
        chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))
png("solid", 2, 8, 6, 1, 2, 3, 255, 4, 5, 6, 255)
png("half", 2, 8, 6, 1, 2, 3, 255, 4, 5, 6, 128)
png("clear", 2, 8, 6, 1, 2, 3, 0, 4, 5, 6, 0)
png("clear_too", 2, 8, 6, 9, 200, 3, 0, 4, 255, 6, 0)
png("ids", 3, 16, 0, 1, 2, 258)
png("no_ids", 3, 16, 0, 0, 0, 256)
END
    check "alpha of 255 is that of PPM" status 0 "$compare" "$T/solid.png" "$T/two.ppm"
    check "what covers half is different" status 1 "$compare" --limit 126 "$T/solid.png" "$T/half.png"
    check "by its alpha" grep -q '^max    127 at 1,0$' "$T/out"
    check "its mean is that of four channels" grep -q "^mean   $(awk 'BEGIN {
        printf "%.4g", (127 + 15 * (1 - 128 / 255)) / 8 }')$" "$T/out"
    check "an invisible picture is another one" status 1 "$compare" --limit 254 "$T/clear.png" "$T/two.ppm"
    check "what cannot be seen does not count" status 0 "$compare" "$T/clear.png" "$T/clear_too.png"
    check "a map of ids is no empty map" status 1 "$compare" "$T/ids.png" "$T/no_ids.png"
    check "by 2 of 65535" grep -q '^max    0.007782 at 1,0$' "$T/out"
    check "and is itself" status 0 "$compare" "$T/ids.png" "$T/ids.png"
    status 1 "$compare" --limit 2 --difference "$T/d.ppm" "$T/g.ppm" "$T/h.ppm"
    check "a difference as PNG" status 1 "$compare" --limit 2 --difference "$T/d.png" "$T/g.ppm" "$T/h.ppm"
    check "is that as PPM" status 0 "$compare" "$T/d.png" "$T/d.ppm"
    $CC $FLAGS -DSHADE__IMPLEMENTED -DMODEL_STB examples/programs/thumbnail/thumbnail.c "$T/shade.o" -lm -o "$T/thumbnail"
    "$T/thumbnail" "$T/tent.obj" "$T/clear.png" --size 64x48 --background none --no-shadow
    check "a model without a background" status 0 "$compare" "$T/clear.png" "$T/tent.obj" --background none --no-shadow
    check "with one it is another" status 1 "$compare" "$T/clear.png" "$T/tent.obj" --no-shadow
else echo "compare: no stb_image.h: PNG left out"
fi
finish
