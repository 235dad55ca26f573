#!/bin/sh
# thumbnail.sh - build/thumbnail without libraries, and with those that are here: polygons, readers,
# surfaces, formats, options, and what goes wrong.  What is not installed is named and left out.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}
export LC_ALL=C
trap 'chmod -R u+w "$T"; rm -rf "$T"' EXIT
ulimit -c 0

check() {                       # what, command ...
    what=$1; shift
    if "$@" >"$T/log" 2>&1; then passed=$((passed + 1)); return; fi
    fail "$build: $what" "$T/log"
}

# ---- programs ------------------------------------------------------------------------------------
build=programs
find_libraries
[ "$STB" ] || echo "no stb (libstb-dev): PNG and textures are left out"
[ "$ZLIB" ] || echo "no zlib (zlib1g-dev): packed 3MF is left out"
[ "$ASSIMP" ] || echo "no assimp (libassimp-dev): its formats are left out"
# what is compiled here is compiled in a fifth of the time, and its pictures are as small
FLAGS="-std=c99 -O0 -ffp-contract=off -pthread -I."
compile() { $CC $FLAGS "$@" || { echo "0 passed, 1 failed"; exit 1; }; }
${MAKE:-make} -s build/shade.o build/thumbnail || { echo "0 passed, 1 failed"; exit 1; }
compile -DSHADE__IMPLEMENTED examples/programs/thumbnail/thumbnail.c build/shade.o -lm -o "$T/plain"
compile -DSHADE__IMPLEMENTED -DBANDS_ALONE examples/programs/thumbnail/thumbnail.c build/shade.o -lm -o "$T/alone"
compile examples/programs/thumbnail/test/models.c -lm -o "$T/models"
compile $STB examples/programs/thumbnail/test/look.c -lm -o "$T/look"
compile examples/kit/test/ears.c -lm -o "$T/ears"
for build in hidden closed meshopt pieces; do
    compile -DSHADE__IMPLEMENTED -Wno-unused-function examples/kit/test/$build.c build/shade.o -lm -o "$T/$build"
done
check "models" "$T/models" "$T"

for line in ears hidden closed "meshopt examples/kit/test/meshopt.txt" "pieces $T"; do
    build=${line%% *}
    "$T"/$line >"$T/$build.log" || grep FAIL "$T/$build.log"
    passed=$((passed + $(sed -n 's/^\([0-9]*\) passed.*/\1/p' "$T/$build.log")))
    failed=$((failed + $(sed -n 's/.* \([0-9]*\) failed$/\1/p' "$T/$build.log")))
done

# ---- what both builds do -------------------------------------------------------------------------
# model, picture, options: a small picture of a file in T
draw() {
    model=$1 picture=$2; shift 2
    "$THUMBNAIL" "$T/$model" "$T/$picture" --size 120x90 --samples 1 "$@" 2>"$T/err" </dev/null
}
# draws both and compares: what, A, B, difference at most, options
same() {
    check "$1: $2" draw "$2" a.ppm $5
    check "$1: $3" draw "$3" b.ppm $5
    check "$1" "$T/look" same "$T/a.ppm" "$T/b.ppm" "$4"
}
# x, y of the picture a.ppm has the display's color of linear r g b
pixel() { "$T/look" pixel "$T/a.ppm" "$1" "$2" $("$T/look" display "$3" "$4" "$5") 1; }
refused() {                     # text, command ...: and no picture
    rm -f "$T/none.ppm"
    refused_by thumbnail "$@" && [ ! -e "$T/none.ppm" ] && no test -e "$T"/*.part
}
bad_model() { check "$1" refused "$3" "$THUMBNAIL" "$T/$2" "$T/none.ppm"; }

# what needs no lamps
flat="--model emissive --background black --no-shadow"

# A square with colours of its own is lit as one whose material has that colour, and a colour or a
# material that is asked for takes the place of both.
own_colors() {
    square="v -1 0 -1 C\nv 1 0 -1 C\nv 1 0 1 C\nv -1 0 1 C\n"
    printf 'newmtl skin\nKd 0.8 0.6 0.5\n' >"$T/skin.mtl"
    printf "mtllib skin.mtl\n$(printf '%s' "$square" | sed 's/ C//g')usemtl skin\nf 1 2 3 4\n" >"$T/skin.obj"
    printf "$(printf '%s' "$square" | sed 's/ C/ 0.8 0.6 0.5/g')f 1 2 3 4\n" >"$T/scan.obj"
    printf "$(printf '%s' "$square" | sed 's/ C//g')f 1 2 3 4\n" >"$T/bare.obj"
    printf 'OFF\n4 1 0\n-1 0 -1\n1 0 -1\n1 0 1\n-1 0 1\n4 0 1 2 3 204 153 128\n' >"$T/face.off"
    for k in scan.obj face.off; do
        for light in "" --quick; do
            same "colours and no material $light" skin.obj $k 3 "--model lambert --up z $light"
        done
        for how in "--color 8090A0" "--material gold" "--color 8090A0 --quick" "--color 8090A0 --shading vertex"; do
            same "asked for, not the file's" bare.obj $k 0 "--up z $how"
        done
        for file in bare.obj $k; do
            check "views of $file" sh -c "'$THUMBNAIL' - '$T/$file.ppm' --up z --views front \
                --size 200x150 --color 8090A0 <'$T/$file'"
        done
        check "show what was asked for" cmp "$T/bare.obj.ppm" "$T/$k.ppm"
    done
    same "asked for, not the material" bare.obj skin.obj 0 "--up z --color 8090A0"
    check "clay before" draw bare.obj a.ppm --up z
    check "in colour" draw scan.obj b.ppm --up z
    check "clay is another picture" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 8
}

formats() {
    for k in torus.ply torus.little.ply torus.big.ply torus.stl torus.binary.stl; do
        same "the same mesh" torus.obj $k 0 "--up y"
    done
    for k in star comb; do
        check "$k drawn" draw $k.obj a.ppm $flat
        check "its triangles drawn" draw $k.parts.obj b.ppm $flat
        check "$k covers what its triangles cover" "$T/look" area "$T/a.ppm" "$T/b.ppm" 0.005
        check "$k and its triangles are one picture" "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.3
    done
    check "one color" draw flat.obj a.ppm $flat
    check "k_e of the MTL is what one sees" pixel 0.5 0.5 0.448 0.1329 0.0331
    check "glass before" draw glass.obj a.ppm $flat --rotate 0
    check "glass is mixed, d is believed" pixel 0.5 0.5 0.2390 0 0.0797
    same "glass, whatever comes first in the file" glass.obj glass2.obj 0 "$flat"
    check "colors of vertices" draw colors.ply a.ppm --model lambert
    check "PLY's colors are a display's" sh -c "'$T/look' pixel '$T/a.ppm' .5 .6 200 100 50 60"
    check "matte" draw matte.obj a.ppm --rotate 0
    check "a lit face has about its color" "$T/look" pixel "$T/a.ppm" .5 .6 170 62 21 45
    own_colors
    for k in x y z -x -y -z; do check "up $k" draw torus.obj a.ppm --up $k $flat; done
    same "three shadings draw" flat.obj flat.obj 0 "--shading vertex"
    check "faces" draw torus.obj a.ppm --shading face
    check "fragments" draw torus.obj b.ppm
    printf 'newmtl black\nKd 0 0 0\n' >"$T/black.mtl"
    { printf 'mtllib black.mtl\nusemtl black\n'; cat "$T/torus.obj"; } >"$T/black.obj"
    check "black without gloss" draw black.obj c.ppm --no-shadow
    check "and by Lambert" draw black.obj d.ppm --no-shadow --model lambert
    check "shows form by what it reflects" no "$T/look" same "$T/c.ppm" "$T/d.ppm" 60
    check "faces show" no "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.2
    check "a plain background" draw torus.obj a.ppm --background 204060 --no-shadow
    check "is the color asked for" "$T/look" pixel "$T/a.ppm" 0.01 0.01 32 64 96 0
    check "a shadow" draw torus.obj b.ppm --background 204060
    check "darkens below" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 20
    for k in white black; do
        check "white on $k" draw torus.obj $k.ppm --color white --background $k --no-shadow --samples 1
    done
    check "white parts are seen on white" "$T/look" area "$T/white.ppm" "$T/black.ppm" 0.005
    printf 'v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n' >"$T/sheet.obj"
    check "a white sheet from above" draw sheet.obj a.ppm --color white --background white --view top --no-shadow
    check "is not white" no "$T/look" pixel "$T/a.ppm" .5 .5 255 255 255 9
    # a plate so flat that ground within its maps of shadows lies behind their far planes
    awk 'BEGIN { for (i = 0; i < 8; i++) print "v", i % 2 * 2 - 1, (i > 3) / 25, int(i / 2) % 2 * 2 - 1
                 print "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 2 6 8 4\nf 4 8 7 3\nf 3 7 5 1" }' >"$T/plate.obj"
    check "a plate" draw plate.obj plate.ppm --background white --view 30,40,0.5 --size 100x100
    check "throws no shadow on ground that the lamp sees" "$T/look" pixel "$T/plate.ppm" .29 .34 255 255 255 0
    for k in torus glass; do
        check "$k by one thread" draw $k.obj one.ppm --threads 1
        for n in 2 5 256; do
            check "$k by $n threads" draw $k.obj many.ppm --threads $n
            check "$k, the same bits by $n threads" cmp "$T/one.ppm" "$T/many.ppm"
        done
        check "$k, no threads" "$T/alone" "$T/$k.obj" "$T/many.ppm" --size 120x90 --samples 1
        check "$k, the same bits without threads" cmp "$T/one.ppm" "$T/many.ppm"
    done
    for k in "128x128 4" "120x136 4" "129x128 2"; do
        check "a picture at ${k% *}" "$THUMBNAIL" "$T/torus.obj" "$T/one.ppm" --size "${k% *}"
        check "with samples" "$THUMBNAIL" "$T/torus.obj" "$T/many.ppm" --size "${k% *}" --samples "${k#* }"
        check "has ${k#* } samples of itself" cmp "$T/one.ppm" "$T/many.ppm"
    done
    cp "$T/torus.ply" "$T/torus"
    check "name without an end" draw torus b.ppm $flat
    "$THUMBNAIL" "$T/torus.obj" - --size 120x90 >"$T/b.ppm" 2>"$T/err"
    check "standard output" "$T/look" near "$T/a.ppm" "$T/b.ppm" 200
    check "no progress into a file" test ! -s "$T/err"
}

# The program gets a signal while it reads, which more bytes than a pipe holds tell: a status, a line
ended() {                       # signal, status, line
    # a job of a shell without job control is deaf to INT and QUIT
    env --default-signal=INT,QUIT,HUP,TERM "$THUMBNAIL" - "$T/none.ppm" --max-seconds 60 \
        <"$T/pipe.obj" 2>"$T/err" &
    exec 3>"$T/pipe.obj"
    head -c 200000 /dev/zero >&3
    kill -"$1" $!
    wait $!
    status=$?
    exec 3>&-
    echo "status $status"; cat "$T/err"
    [ $status -eq "$2" ] && [ "$(cat "$T/err")" = "thumbnail: $3 while reading standard input" ]
}
. examples/programs/thumbnail/test/reports.sh

bad_input() {
    : >"$T/empty.obj"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1' >"$T/cut.obj"
    printf 'v 0 0 0\nv 1 0 0\nf 1 2\nf 1\nf\n' >"$T/lines.obj"
    printf 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/nan.obj"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4000000000\n' >"$T/index.obj"
    head -c 300 "$T/torus.big.ply" >"$T/cut.ply"
    sed 's/^element face.*/element face 4000000000/' "$T/torus.ply" >"$T/huge.ply"
    sed 's/vertex 288/vertex 10/' "$T/torus.ply" >"$T/few.ply"
    printf 'ply\nformat ascii 1.0\nelement vertex 3\n' >"$T/head.ply"
    head -c 1000 "$T/torus.binary.stl" >"$T/cut.stl"
    # no letters: by chance they would begin a statement
    awk 'BEGIN { for (i = 0; i < 100000; i++) { x = (x * 75 + 74) % 65537
                 printf "%c", x % 97 ? 128 + x % 128 : 10 } }' >"$T/noise.obj"
    printf 'v 1e38 1e38 -1e38\nv -1e38 1e38 1e38\nv 1e38 -1e38 0\nf 1 2 3\n' >"$T/large.obj"
    printf 'v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n' >"$T/point.obj"
    printf 'hello\n' >"$T/words.xyzw"
    printf 'hello\n' >"$T/line
break.obj"
    mkdir -p "$T/folder.obj"
    bad_model "missing" missing.obj "No such file"
    bad_model "empty" empty.obj "empty"
    bad_model "a folder" folder.obj "directory"
    bad_model "cut off" cut.obj "expected a number"
    bad_model "faces of two corners and fewer" lines.obj "no faces in it"
    { cat "$T/torus.obj"; printf 'f 1 2\nf\n'; } >"$T/torus.lines.obj"
    same "such faces beside others" torus.obj torus.lines.obj 0 "$flat"
    bad_model "a face of what is no number" nan.obj "no face of it has corners that are all finite"
    bad_model "an index too large" index.obj "out of range"
    bad_model "PLY cut off" cut.ply "too early"
    bad_model "PLY with more faces than bytes" huge.ply "expected a number"
    bad_model "PLY without those vertices" few.ply "no vertex\|out of range"
    bad_model "PLY that is all header" head.ply "header does not end"
    bad_model "STL cut off" cut.stl "ends after"
    bad_model "noise" noise.obj "is no OBJ"
    bad_model "an unknown format is named" words.xyzw "\.xyzw"
    bad_model "a line break in its name" "line
break.obj" "is no OBJ"
    check "numbers as large as they get" draw large.obj a.ppm --no-shadow
    check "a triangle as large" test ! -s "$T/err"
    bad_model "a point shows nothing" point.obj "point.obj: no triangle of it has an area"
    check "too many triangles" refused "more than 100 triangles" "$THUMBNAIL" "$T/torus.obj" \
        "$T/none.ppm" --max-triangles 100
    check "too many in PLY" refused "more than 100 triangles" "$THUMBNAIL" "$T/torus.ply" \
        "$T/none.ppm" --max-triangles 100
    check "too many in STL" refused "more than 100 triangles" "$THUMBNAIL" "$T/torus.stl" \
        "$T/none.ppm" --max-triangles 100
    awk 'BEGIN { for (i = 0; i < 200000; i++) print "v", cos(i), sin(i), 0; printf "f"
                 for (i = 1; i <= 200000; i++) printf " %d", i; print "" }' >"$T/tangle.obj"
    check "one polygon of 200000 corners" refused "more than 150000" "$THUMBNAIL" \
        "$T/tangle.obj" "$T/none.ppm" --max-triangles 150000
    # three million vertices take 36 MB of floats, and half as much again while the array grows
    if (ulimit -v 4000000) 2>/dev/null; then
        awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"
                     for (i = 0; i < 3000000; i++) print "v 0 0 0" }' >"$T/sparse.obj"
        check "less memory than the model takes" refused "out of memory" "$THUMBNAIL" \
            "$T/sparse.obj" "$T/none.ppm" --threads 2 --max-memory 64
        check "enough" draw sparse.obj a.ppm $flat --threads 2 --max-memory 1000
    fi
    check "processor time is up" refused "gave up after --max-seconds while drawing" "$THUMBNAIL" \
        "$T/torus.obj" "$T/none.ppm" --size 8192x8192 --samples 2 --max-seconds 1 --quiet
    if mkfifo "$T/pipe.obj" 2>/dev/null; then
        check "time is up" sh -c "began=\$(date +%s)
            '$THUMBNAIL' - '$T/none.ppm' --max-seconds 1 <>'$T/pipe.obj' 2>'$T/err'
            [ \$? -eq 1 ] && grep 'gave up after --max-seconds' '$T/err' && [ \$((\$(date +%s) - began)) -ge 3 ]"
        check "a crash of the reader" ended SEGV 1 crashed
        check "an abort" ended ABRT 1 crashed
        for k in INT:130 TERM:143 HUP:129 QUIT:131; do
            check "SIG${k%:*} ends the program itself" ended ${k%:*} ${k#*:} interrupted
        done
        check "SIGINT while it reads a large file" interrupted "$THUMBNAIL" "$T/noise.stl" "$T/none.ppm"
        check "a pipe for a model" bounded refused "pipe.obj: is no regular file" "$THUMBNAIL" \
            "$T/pipe.obj" "$T/none.ppm"
        { printf 'mtllib pipe.obj\n'; cat "$T/torus.obj"; } >"$T/piped.obj"
        check "a pipe for an MTL" bounded draw piped.obj a.ppm $flat
        check "is left out" grep "pipe.obj: is no regular file (left out)" "$T/err"
        printf 'newmtl m\nmap_Kd pipe.obj\nmap_Ke /dev/zero\n' >"$T/piped.mtl"
        { printf 'mtllib piped.mtl\nusemtl m\n'; cat "$T/torus.obj"; } >"$T/piped.obj"
        check "a pipe for a picture" bounded draw piped.obj a.ppm $flat
        check "is left out, too" grep "is no regular file (left out); /dev/zero: it lies outside" "$T/err"
        check "and /dev/zero for a model" bounded refused "zero: is no regular file" "$THUMBNAIL" \
            /dev/zero "$T/none.ppm"
    fi
    for k in torus.obj torus.binary.stl torus.big.ply; do
        check "$k" draw $k a.ppm $flat
        check "$k from standard input" sh -c "'$THUMBNAIL' - - --size 120x90 --samples 1 $flat \
            <'$T/$k' >'$T/b.ppm'"
        check "$k: the same picture" cmp "$T/a.ppm" "$T/b.ppm"
    done
    check "nothing from standard input" refused "standard input: the file is empty" "$THUMBNAIL" - \
        "$T/none.ppm"
    check "no v 4000, and how many there are" sh -c "printf 'v 0 0 0\nv 1 0 0\n\nf 1 2 4000\n' >'$T/i.obj'"
    bad_model "as a message says" i.obj "i.obj:4: there is no v number 4000: the file has 2"
    printf 'v 0 0 0\nv 1 0 0\nf 1 2 -3\n' >"$T/i.obj"
    bad_model "back from the last" i.obj 'i.obj:3: index "-3" is out of range: 2 v stand before it'
}

# A command that ends within seconds, or is ended
bounded() {
    ("$@") & waited=$!
    (sleep 20; kill $waited) >/dev/null 2>&1 & watch=$!
    wait $waited
    status=$?
    kill $watch 2>/dev/null
    return $status
}

# A picture is written to a name that says what it is, never over what was read.
kept() {                        # text, file that stays, command ...
    text=$1 file=$2; shift 2
    cp "$file" "$T/before"
    refused "$text" "$@" && cmp "$file" "$T/before"
}
data_loss() {
    cp "$T/torus.obj" "$T/v2.obj"
    for k in v2.mtl v2.jpg v2 v2.ppm.gz; do
        cp "$T/torus.obj" "$T/$k"
        check "no picture over $k" kept "$k: .*\.ppm or \.png" "$T/$k" "$THUMBNAIL" "$T/torus.obj" "$T/$k"
    done
    for k in "shade-sheets" "--views"; do
        check "two models name $k" kept "v2.obj is a model.*$k" "$T/v2.obj" "$THUMBNAIL" \
            "$T/torus.obj" "$T/v2.obj"
        check "three name $k" kept "one file too many.*$k" "$T/v2.obj" "$THUMBNAIL" "$T/torus.obj" \
            "$T/v2.obj" "$T/v2.obj"
    done
    cp "$T/colors.ply" "$T/ply.ppm"
    check "no picture over its model" kept "ply.ppm is read" "$T/ply.ppm" "$THUMBNAIL" "$T/ply.ppm" \
        "$T/./ply.ppm"
    check "a JSON over a model" kept "FILE ends in .json" "$T/v2.obj" "$THUMBNAIL" "$T/torus.obj" \
        "$T/none.ppm" --views front --json "$T/v2.obj"
    cp "$THUMBNAIL" "$T/shade-thumbnail"
    "$T/shade-thumbnail" >"$T/out" 2>"$T/err"
    check "the installed program's name" grep -q "^usage: shade-thumbnail model" "$T/err"
    check "where to read on, and no more" same_text "$(sed 1d "$T/err")" \
        "shade-thumbnail: --help lists the options"
    "$T/shade-thumbnail" "$T/empty.obj" "$T/none.ppm" 2>"$T/err"
    check "begins its lines" grep -q "^shade-thumbnail: " "$T/err"
}

bad_output() {
    cp "$T/torus.obj" "$T/kept.ppm"
    data_loss
    check "a picture stays where the model is bad" refused "empty" "$THUMBNAIL" \
        "$T/empty.obj" "$T/kept.ppm"
    check "as it was" cmp "$T/torus.obj" "$T/kept.ppm"
    mkdir -p "$T/folder.ppm"
    check "a folder as the picture" refused "directory" "$THUMBNAIL" "$T/torus.obj" \
        "$T/folder.ppm" $flat
    check "no such folder" refused "No such file" "$THUMBNAIL" "$T/torus.obj" \
        "$T/nowhere/a.ppm" $flat
    [ -e /dev/full ] &&
        check "a full device" refused "No space left" "$THUMBNAIL" "$T/torus.obj" /dev/full $flat &&
        check "a full standard output" sh -c "'$THUMBNAIL' '$T/torus.obj' - $flat >/dev/full \
            2>'$T/err'; [ \$? -eq 1 ] && grep 'No space left' '$T/err'"
    check "a closed pipe" sh -c "{ '$THUMBNAIL' '$T/flat.obj' - $flat --size 900x900 2>'$T/err'
        echo \$? >'$T/status'; } | head -c 1 >/dev/null; [ \$(cat '$T/status') = 1 ] &&
        grep 'Broken pipe' '$T/err'"
    check "a full disk" sh -c "ulimit -f 8; trap '' XFSZ
        '$THUMBNAIL' '$T/torus.obj' '$T/none.ppm' $flat 2>'$T/err'; [ \$? -eq 1 ] &&
        grep 'File too large' '$T/err' && [ ! -e '$T/none.ppm' ] && ! ls '$T'/*.part"
    check "a full disk, with a shell that lets the signal through" sh -c "ulimit -f 8
        '$THUMBNAIL' '$T/torus.obj' '$T/none.ppm' $flat 2>'$T/err'; [ \$? -eq 1 ] &&
        grep 'File too large' '$T/err' && [ ! -e '$T/none.ppm' ] && ! ls '$T'/*.part"
    check "rights as others have" sh -c "umask 027; '$THUMBNAIL' '$T/flat.obj' '$T/r.ppm' $flat &&
        ls -l '$T/r.ppm' | grep '^-rw-r-----'"
    # a file that exists stays the same file, as who holds it open wants it
    mkdir -p "$T/kept"
    check "a picture" draw flat.obj kept/a.ppm
    chmod 640 "$T/kept/a.ppm"
    ln -f "$T/kept/a.ppm" "$T/kept/hard.ppm"
    ln -sf a.ppm "$T/kept/link.ppm"
    ln -sf b.ppm "$T/kept/new.ppm"
    exec 3<"$T/kept/a.ppm"
    check "another one" draw torus.obj b.ppm
    check "by a link" draw torus.obj kept/link.ppm
    cat <&3 >"$T/c.ppm"
    exec 3<&-
    for k in c kept/a kept/hard; do check "is in $k" cmp "$T/b.ppm" "$T/$k.ppm"; done
    check "rights stay" sh -c "ls -l '$T/kept/a.ppm' | grep '^-rw-r-----'"
    check "the link stays" test -h "$T/kept/link.ppm"
    check "by a link to nothing" draw torus.obj kept/new.ppm
    check "makes what it names" cmp "$T/b.ppm" "$T/kept/b.ppm"
    check "and stays" test -h "$T/kept/new.ppm"
    check "smaller" "$THUMBNAIL" "$T/flat.obj" "$T/kept/a.ppm" --size 8x8
    check "nothing of the old one is left" test "$(wc -c <"$T/kept/a.ppm")" -eq 203
    check "a full disk leaves the old one" sh -c "ulimit -f 8; trap '' XFSZ
        '$THUMBNAIL' '$T/torus.obj' '$T/kept/b.ppm' --size 300x300 2>'$T/err'; [ \$? -eq 1 ] &&
        grep 'File too large' '$T/err' && cmp '$T/b.ppm' '$T/kept/b.ppm'"
    check "and nothing beside it" test "$(ls "$T/kept" | wc -l)" -eq 5
}

bad_options() {
    for k in "--frobnicate" "--size" "--size 0x5" "--size 10" "--size 99999x1" "--samples 3" \
        "--up w" "--color 12345" "--color redd" "--background no" "--material x" "--shading x" \
        "--model x" "--rotate x" "--threads 0" "--threads 257" "--threads x" "--threads" \
        "--max-memory 31" "--max-memory x" "--max-seconds x" "--max-triangles -1" "extra" "-v" "--png=1"; do
        check "$k" refused "${k%% *}" "$THUMBNAIL" "$T/torus.obj" "$T/none.ppm" $k
    done
    for k in "--samples 3: 1, 2 or 4" "--up w: x, y, z, -x, -y or -z" "--threads 0: a whole number: 1 .. 256" \
        "--max-seconds 0.0: a whole number: gives up" "--rotate 0x10: turns" "--view 0x10,0: from where" \
        "--section x=0x0: x, y or z" "--color red --material gold:--color does not go with --material"; do
        check "$k" refused "${k##*gold:}" "$THUMBNAIL" "$T/torus.obj" "$T/none.ppm" ${k%%:*}
    done
    check "a range of two lines" refused 'or a name that --material list prints, or another' "$THUMBNAIL" \
        "$T/torus.obj" "$T/none.ppm" --material x
    for k in jpg JPEG webp gif tga; do
        check "a picture.$k" refused "\.ppm or \.png" "$THUMBNAIL" "$T/torus.obj" "$T/none.$k"
        check "is not there" test ! -e "$T/none.$k"
    done
    check "an option and its value in one word" draw torus.obj a.ppm --up=y $flat
    check "apart" draw torus.obj b.ppm --up y $flat
    check "are the same" cmp "$T/a.ppm" "$T/b.ppm"
    cp "$T/torus.obj" "$T/-dash.obj"
    check "files behind --" sh -c "cd '$T' && '$THUMBNAIL' --size 120x90 --samples=1 $flat --up y -- -dash.obj b.ppm"
    check "are files" cmp "$T/a.ppm" "$T/b.ppm"
    check "version" sh -c "'$THUMBNAIL' --version | grep -qx 'thumbnail 1\.[0-9]*\.[0-9]*'"
    check "none needs PNG" refused "needs PNG" "$THUMBNAIL" "$T/torus.obj" "$T/none.ppm" \
        --background none
    check "help" sh -c "'$THUMBNAIL' --help | grep -q '^usage: thumbnail'"
    check "materials" sh -c "'$THUMBNAIL' --material list | grep -qx 'gold'"
    check "looks of other programs are among them" \
        sh -c "'$THUMBNAIL' --material list | grep -qx 'vtk'"
    look() { "$THUMBNAIL" "$T/torus.obj" "$T/$1.ppm" --size 60x45 --material "$2" --quiet; }
    check "a look" look vtk 'vtk(color=1,.5,.2, specular=.8, power=30)'
    check "blanks or commas" look blank 'vtk(color=1,.5,.2 specular=.8 power=30)'
    check "one picture" cmp "$T/vtk.ppm" "$T/blank.ppm"
    check "another exponent" look dull 'vtk(color=1,.5,.2 specular=.8 power=3)'
    check "is another picture" sh -c "! cmp -s '$T/vtk.ppm' '$T/dull.ppm'"
    check "an unknown number" refused "vtk has no number x" "$THUMBNAIL" "$T/torus.obj" \
        "$T/none.ppm" --material 'vtk(x=1)'
    check "an unknown program" refused "another program's numbers" "$THUMBNAIL" "$T/torus.obj" \
        "$T/none.ppm" --material 'vtp(power=1)'
    check "a law that is no material" refused "is not iteration four" "$THUMBNAIL" "$T/torus.obj" \
        "$T/none.ppm" --material jmol
}

# what MTL says of highlights: illum 1 has none, illum 0 and Ps are told, Pr is no Phong of Ks
highlights() {
    { echo 'mtllib shine.mtl'; echo 'usemtl m'; cat "$T/torus.obj"; } >"$T/shine.obj"
    shine() {
        printf "newmtl m\nKd .6 .3 .1\n$2" >"$T/shine.mtl"
        "$THUMBNAIL" "$T/shine.obj" "$T/$1.ppm" --size 60x45 2>"$T/$1.said"
    }
    check "illum 2" shine two 'Ks .8 .8 .8\nNs 30\nillum 2\n'
    check "illum 1" shine one 'illum 1\nKs .8 .8 .8\nNs 30\n'
    check "illum 0" shine zero 'Ks .8 .8 .8\nNs 30\nillum 0\n'
    check "no highlight" shine none 'Ks 0 0 0\nNs 30\n'
    check "Pr and Ps" shine rough 'Pr .4\nPs .5\n'
    check "illum 1 has none" cmp "$T/one.ppm" "$T/none.ppm"
    check "illum 2 has one" sh -c "! cmp -s '$T/two.ppm' '$T/none.ppm'"
    check "illum 0 is lit" cmp "$T/zero.ppm" "$T/two.ppm"
    check "and told" grep -q 'illum 0' "$T/zero.said"
    check "Ps is told" grep -q 'Ps' "$T/rough.said"
    check "Pr is drawn" sh -c "! cmp -s '$T/rough.ppm' '$T/none.ppm'"
}

# a file of 2 GB that takes a block of the disk
bombs() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/sparse.obj"
    check "some memory" draw sparse.obj a.ppm $flat --max-memory 512
    truncate -s 2G "$T/sparse.obj" 2>/dev/null || { echo "no truncate: a sparse file is left out"; return; }
    check "too little of it" refused "sparse.obj: out of memory; see --max-memory" "$THUMBNAIL" "$T/sparse.obj" \
        "$T/none.ppm" --max-memory 512
    rm "$T/sparse.obj"
}

# Formats like OBJ do not say which axis is up.  Points and faces of a model that stands on y become
# one that stands on another axis: name, axis, points, faces
stand() {
    echo "$3" | awk -v up="$2" -v faces="$4" '{
        sign = up ~ /-/ ? -1 : 1
        for (i = 1; i <= NF; i += 3) {
            x = $i; y = sign * $(i + 1); z = sign * $(i + 2)
            print "v", up ~ /x/ ? y " " z " " x : up ~ /y/ ? x " " y " " z : z " " x " " y
        }
        printf faces "\n" }' >"$T/$1.obj"
}
# name, axis: the guess, as --verbose says it, and the picture of --up with that axis
guessed() {
    check "$1" draw $1.obj a.ppm --verbose
    check "$1: $2 is up" grep -q "which axis is up: $2," "$T/err"
    check "$1 with --up $2" draw $1.obj b.ppm --up $2
    check "$1: is that picture" cmp "$T/a.ppm" "$T/b.ppm"
}
upright() {
    # a body with six tips, on four legs whose feet are boxes
    beast="3 2 0  -3 2 0  0 2.8 0  0 1.2 0  0 2 0.8  0 2 -0.8"
    limbs="f 3 5 1\nf 3 1 6\nf 3 6 2\nf 3 2 5\nf 4 1 5\nf 4 6 1\nf 4 2 6\nf 4 5 2"
    n=7
    for leg in "1.4 0.4" "1.4 -0.7" "-1.7 0.4" "-1.7 -0.7"; do
        set -- $leg
        beast="$beast $(echo $1 $2 | awk '{ for (y = 0; y < 3; y += 2)
            print $1, y, $2, $1 + 0.3, y, $2, $1 + 0.3, y, $2 + 0.3, $1, y, $2 + 0.3 }' | tr '\n' ' ')"
        limbs="$limbs$(echo $n | awk '{ a = $1
            printf "\\nf %d %d %d %d", a, a + 1, a + 2, a + 3
            for (k = 0; k < 4; k++)
                printf "\\nf %d %d %d %d", a + k, a + k + 4, a + (k + 1) % 4 + 4, a + (k + 1) % 4 }')"
        n=$((n + 8))
    done
    for up in x z -x -z; do
        stand beast $up "$beast" "$limbs"
        guessed beast $up
        check "drawings keep to habit" draw beast.obj b.ppm --size 400x300 --views front --json "$T/beast.json"
        check "whatever the feet are" grep -q '"up": "y"' "$T/beast.json"
    done
    for up in y -y; do          # no file is upside down
        stand beast $up "$beast" "$limbs"
        guessed beast y
    done
    # a house and a cupboard can stand on any wall; a lamp hangs on a wall by its plate
    house="0 0 0  6 0 0  6 0 4  0 0 4  0 3 0  6 3 0  6 3 4  0 3 4  1 5 2  5 5 2"
    walls="f 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\nf 5 9 10 6\nf 6 10 7\nf 7 10 9 8\nf 8 9 5"
    lamp="-1 -1 0  1 -1 0  1 1 0  -1 1 0  -0.2 0 3  0.2 0 3  0 0.3 3"
    plate="f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 7\nf 4 1 5 7\nf 5 6 7"
    for up in x y z -x -y -z; do
        stand house $up "$house" "$walls"
        guessed house y
    done
    stand lamp y "$lamp" "$plate"
    guessed lamp y
    check "a torus" draw torus.obj a.ppm --verbose
    check "says nothing" grep -q "which axis is up: y, as usual" "$T/err"
    for k in "" "--verbose --quiet"; do
        check "no word with \"$k\"" draw torus.obj a.ppm $k
        check "at all, with \"$k\"" test ! -s "$T/err"
    done
}

# A part of 3 x 2 x 1, with eighths in it, far from the origin of its coordinates: x, name
far() {
    awk -v x="$1" -v n="$2" 'function p(k) { return sprintf("%.3f %.3f %.3f", x + 3 * (k % 2) + 0.125 * (k == 3),
            -2 * x + 2 * (int(k / 2) % 2), x + int(k / 4) + 0.125 * (k == 6)) }
        BEGIN { split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", f)
            for (k = 0; k < 8; k++) { print "v", p(k) >n ".obj"; ply = ply p(k) "\n" }
            for (i = 1; i <= 36; i += 3) {
                print "f", f[i] + 1, f[i + 1] + 1, f[i + 2] + 1 >n ".obj"
                ply = ply "3 " f[i] " " f[i + 1] " " f[i + 2] "\n"
                print "facet normal 0 0 0\nouter loop\nvertex " p(f[i]) "\nvertex " p(f[i + 1]) "\nvertex " \
                    p(f[i + 2]) "\nendloop\nendfacet" >n ".body" }
            printf "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\n" >n ".ply"
            printf "property double z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n%s", ply >n ".ply" }'
    { echo solid; cat "$2.body"; echo endsolid; } >"$2.stl"
}
# coordinates of surveyors: floats have no digits for a part and its place
surveyed() {
    far 0 "$T/here"
    for x in 1000000 100000000; do
        far $x "$T/there"
        for k in obj stl ply; do
            check "$k here" draw here.$k a.ppm --up z
            check "$k at $x" draw there.$k b.ppm --up z
            check "$k at $x: the same picture" cmp "$T/a.ppm" "$T/b.ppm"
            check "$k at $x: a drawing" "$THUMBNAIL" "$T/there.$k" "$T/b.ppm" --views front --size 300x200 \
                --json "$T/there.json"
            check "the box and that of its part, of the file" same_text 2 \
                "$(grep -c "\"low\": \[$x, -$((2 * x)), $x\].*\"size\": \[3.125, 2, 1.125\]" "$T/there.json")"
        done
    done
}

same_text() { [ "$1" = "$2" ] || { echo "got $1, want $2"; return 1; }; }

# Creases of a large mesh: a box of 202,800 triangles is the box of 12.
creases() {
    awk 'BEGIN { n = 130
        for (f = 0; f < 6; f++) for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) {
            u = 2 * i / n - 1; v = 2 * j / n - 1; s = f % 2 ? -1 : 1
            print "v", f < 2 ? s " " u " " s * v : f < 4 ? s * v " " s " " u : u " " s * v " " s }
        for (f = 0; f < 6; f++) for (j = 0; j < n; j++) for (i = 0; i < n; i++) {
            a = f * (n + 1) * (n + 1) + j * (n + 1) + i + 1
            print "f", a, a + 1, a + n + 2, a + n + 1 } }' >"$T/many.obj"
    printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' >"$T/few.obj"
    check "a box of many triangles" draw many.obj a.ppm --no-shadow --up y
    check "a box of few" draw few.obj b.ppm --no-shadow --up y
    check "have the same edges" "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.6
    check "which are sharp" draw many.obj b.ppm --no-shadow --up y --shading face
    check "as those of faces are" "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.2
}

# Two boxes, one on the other, of 12 n^2 triangles each.  A large model is sorted and lit by ways of
# its own, and looks like a small one.
boxes() {                       # n
    awk -v n="$1" 'BEGIN {
        print "ply\nformat ascii 1.0\nelement vertex " 12 * (n + 1) ^ 2
        print "property float x\nproperty float y\nproperty float z\nelement face " 24 * n * n
        print "property list uchar int vertex_indices\nend_header"
        for (box = 0; box < 2; box++) for (side = 0; side < 6; side++)
            for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
                a = side % 3; sign = side < 3 ? 1 : -1
                p[a] = sign; p[(a + 1) % 3] = 2 * i / n - 1; p[(a + 2) % 3] = sign * (2 * j / n - 1)
                size = box ? 0.4 : 1
                printf "%.6f %.6f %.6f\n", size * p[0], size * p[1] + box * 1.4, size * p[2]
            }
        for (f = 0; f < 12; f++) for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
            c = (f * (n + 1) + i) * (n + 1) + j
            print 3, c, c + n + 1, c + n + 2; print 3, c, c + n + 2, c + 1
        }
    }'
}
large() {
    boxes 4 >"$T/few.ply"
    boxes 100 >"$T/many.ply"
    same "a large model as a small one" few.ply many.ply 8
    check "in the mean of a picture" "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.02
    check "the large one by one thread" draw many.ply one.ppm --threads 1
    check "has the same bits" cmp "$T/one.ppm" "$T/b.ppm"
    # at 256 pixels the foot of the upper box shows what thinned casters round off
    check "a small one at 256 pixels" draw few.ply a.ppm --size 256x192 --samples 2
    check "a large one" draw many.ply b.ppm --size 256x192 --samples 2
    check "in the mean of it" "$T/look" near "$T/a.ppm" "$T/b.ppm" 0.02
}

# A cube with a colour for each side, seen from each side: +z is the front.
shown() { "$T/look" pixel "$T/a.ppm" "$@" 1; }   # x, y, red, green, blue
views() {
    { echo "mtllib sides.mtl"
      printf 'v %s\n' "-1 -1 -1" "1 -1 -1" "1 1 -1" "-1 1 -1" "-1 -1 1" "1 -1 1" "1 1 1" "-1 1 1"
      printf 'usemtl %s\nf %s\n' front "5 6 7 8" back "1 4 3 2" right "2 3 7 6" left "1 5 8 4" \
          top "3 4 8 7" bottom "1 2 6 5"; } >"$T/sides.obj"
    printf 'newmtl %s\nKd 0 0 0\nKe %s\n' front ".2 .4 .6" back ".6 .4 .2" right ".4 0 .2" \
        left "0 .6 .2" top ".6 .6 0" bottom "0 .2 .6" >"$T/sides.mtl"
    for k in "front 51 102 153" "back 153 102 51" "right 102 0 51" "left 0 153 51" "top 153 153 0" \
        "bottom 0 51 153" "90,0 102 0 51" "-90,1,2 0 153 51" "0,89 153 153 0"; do
        check "--view ${k%% *}" draw sides.obj a.ppm $flat --view "${k%% *}"
        check "sees that side" shown 0.5 0.5 ${k#* }
    done
    check "two sides and the top" draw sides.obj a.ppm $flat --view iso
    check "the front on the left" shown 0.4 0.6 51 102 153
    check "the right side on the right" shown 0.6 0.6 102 0 51
    check "the top above" shown 0.5 0.3 153 153 0
    same "degrees as a turn" sides.obj sides.obj 40 "--no-shadow --view=-30,19.8"
    check "all of the cube" draw sides.obj a.ppm $flat --view 0,0
    check "leaves a margin" shown 0.03 0.5 0 0 0
    check "nearer" draw sides.obj a.ppm $flat --view 0,0,3
    check "it fills the picture" shown 0.03 0.5 51 102 153
    for k in north 30 "30," ",30" "30,91" "30,20,0" "30,20,21" "30,20,1," "30,20,1,1" "x,y" "nan,0"; do
        check "--view $k" refused "--view $k: from where it is seen: front," "$THUMBNAIL" \
            "$T/sides.obj" "$T/none.ppm" --view "$k"
    done
    check "a view turns the model" refused "--rotate does not go with --view" "$THUMBNAIL" "$T/sides.obj" \
        "$T/none.ppm" --rotate 3 --view top
}

# Without maps of shadows the outline is the same, and what is open is lit alike.
quick() {
    check "all the light" draw torus.obj a.ppm --up y --no-shadow --background black
    check "quick" draw torus.obj b.ppm --up y --no-shadow --background black --quick
    check "covers the same pixels" "$T/look" area "$T/a.ppm" "$T/b.ppm" 0.001
    check "in about the same light" "$T/look" near "$T/a.ppm" "$T/b.ppm" 3
    check "but no shadows" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 5
    check "another shadow on the ground" draw torus.obj a.ppm --up y --quick
    check "is drawn" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 20
    check "by one thread" draw torus.obj b.ppm --up y --quick --threads 1
    check "the same" cmp "$T/a.ppm" "$T/b.ppm"
}

# A section cuts away the viewer's side.  Of a cube of one colour for each side the cut is seen in
# place of the side; where it does not cut, the message says from where to where the model reaches.
sections() {
    check "a cube seen from the right" draw sides.obj b.ppm --no-shadow --view right
    for k in "x right" "x left" "y top" "y bottom" "z front" "z back" "x=.9 right"; do
        check "--section $k" draw sides.obj a.ppm --no-shadow --section "${k% *}" --view "${k#* }"
        check "shows a hatch in place of the side" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 50
        check "covers what the cube covers" "$T/look" area "$T/a.ppm" "$T/b.ppm" 0.25
    done
    check "a section seen from its side" draw sides.obj a.ppm $flat --section x --view front
    check "shows the side that is left" shown 0.45 0.6 51 102 153
    check "one colour" draw sides.obj a.ppm --section x --view right --color white
    check "another number of threads" draw sides.obj b.ppm --section x --view right --color white --threads 1
    check "the same bits" cmp "$T/a.ppm" "$T/b.ppm"
    for k in x=1 x=-1 y=3 z=77; do
        check "--section $k" refused "--section $k.* does not cut the model, which reaches from -1 to 1" \
            "$THUMBNAIL" "$T/sides.obj" "$T/none.ppm" --section $k
    done
    for k in "" w x= x=a x=1b xy X x=nan x=1e31; do
        check "--section $k" refused "--section $k: x, y or z: cuts the model open" \
            "$THUMBNAIL" "$T/sides.obj" "$T/none.ppm" --section "$k"
    done
    printf 'v 500000000 0 0\nv 500000002 0 0\nv 500000000 2 0\nv 500000000 0 2
f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >"$T/survey.obj"
    check "in the file's coordinates" draw survey.obj a.ppm --section x=500000000.5
    check "a closed mesh is cut without a word" test ! -s "$T/err"
    open_sections
}

# A box without its lid, and one without both ends, which each line across it crosses twice, have no
# inside; one has two triangles that are turned in, one a small hole.  Closed are a box with edges that
# end in the middle of others, and a whole one.
open_sections() {
    corners='v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n'
    around='f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' floor='f 4 3 2 1\n' lid='f 5 6 7 8\n'
    box() { name=$1; shift; printf "$corners$*" >"$T/$name.obj"; }
    box lidless "$around$floor"
    box tube "$around"
    box closed "$around$floor$lid"
    box turned "${around}${lid}f 1 2 3 4\n"
    box hole "v 1 .1 2\n${around}${floor}f 6 7 9\nf 7 8 9\nf 8 5 9\n"
    for k in "lidless x" "lidless y" "tube x" "tube y"; do
        check "$k is cut" draw "${k% *}.obj" a.ppm --up z --section "${k#* }"
        check "$k: that is told" grep -q "^thumbnail: --section: the mesh is open where it is cut: the cut is not" "$T/err"
    done
    inside="--up z --section x=1.06 --view right --no-shadow"
    check "a whole box" draw closed.obj b.ppm $inside
    check "one without a lid" draw lidless.obj c.ppm $inside
    check "has no hatch" no "$T/look" same "$T/c.ppm" "$T/b.ppm" 50
    for k in turned hole; do
        check "$k is cut" draw $k.obj a.ppm $inside
        check "$k: that is told" grep -q "open, or turned both ways, where it is cut: the cut is filled between" "$T/err"
    done
    check "the one with a hole is filled" no "$T/look" same "$T/a.ppm" "$T/c.ppm" 50
    check "quietly" draw tube.obj a.ppm --up z --section x --quiet
    check "no line" test ! -s "$T/err"
    box middle "v .7 .3 2\nv 2 .7123 2\n${around}${floor}f 5 6 9\nf 6 10 9\nf 10 7 9\nf 7 8 9\nf 8 5 9\n"
    for k in "middle x=.9" "middle y=.9" "middle x=1.3" "closed x" "closed y" "closed z" "tube z" "lidless z"; do
        check "$k is cut" draw "${k% *}.obj" a.ppm --up z --section "${k#* }"
        check "$k: without a word" test ! -s "$T/err"
    done
}

# Of a picture before white: hundredths of the box of its left half, and of its right half, that are
# not white
covered() {
    set -- "$1" $(head -n 2 "$1" | tail -n 1)
    tail -c $((3 * $2 * $3)) "$1" | od -An -v -tu1 -w3 | awk -v wide="$2" '
        $1 + $2 + $3 < 765 {
            x = (NR - 1) % wide; y = int((NR - 1) / wide); h = x >= wide / 2
            if (!n[h]++) { left[h] = right[h] = x; top[h] = y }
            if (x < left[h]) left[h] = x
            if (x > right[h]) right[h] = x
            low[h] = y
        }
        END {
            for (h = 0; h < 2; h++)
                share[h] = int(100 * n[h] / ((right[h] - left[h] + 1) * (low[h] - top[h] + 1) + 1e-9))
            print share[0], share[1]
        }'
}

# Points without faces are small balls, as large as they are apart, and a line says so: of PLY and OBJ
# the same.
points() {
    awk 'BEGIN { for (i = 0; i < 1000; i++) print i % 10, int(i / 10) % 10, int(i / 100) }' >"$T/grid.txt"
    { printf 'ply\nformat ascii 1.0\nelement vertex 1000\nproperty float x\nproperty float y\n'
      printf 'property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n'
      sed 's/$/ 200 100 50/' "$T/grid.txt"; } >"$T/cloud.ply"
    sed 's/^/v /; s/$/ .7843137 .3921569 .1960784/' "$T/grid.txt" >"$T/cloud.obj"
    check "a cloud" draw cloud.ply a.ppm --up y
    check "is told" grep "cloud.ply: 1000 points have no faces: they are drawn as small balls of radius 0.4" "$T/err"
    check "of OBJ" draw cloud.obj b.ppm --up y
    check "is told as well" grep "cloud.obj: 1000 points have no faces" "$T/err"
    check "looks the same" "$T/look" same "$T/a.ppm" "$T/b.ppm" 3
    sed 's/vertex 1000/vertex 1001/; $s/$/\nnan 0 0 9 9 9/' "$T/cloud.ply" >"$T/lost.ply"
    check "one of which is no number" draw lost.ply b.ppm --up y
    check "is told both" grep "lost.ply: 1 points have coordinates that are no finite numbers (left out); 1000 points have no faces: .* or so$" "$T/err"
    check "quietly" draw cloud.obj b.ppm --up y --quiet
    check "no line" test ! -s "$T/err"
    check "a picture of balls that are small" draw cloud.ply a.ppm --model emissive --background white --no-shadow
    # two squares, of which the left one has points 4 times as far apart, and a point far from both
    awk 'BEGIN {
        for (i = 0; i < 3600; i++) print "v", i % 60 / 59 + .1, int(i / 60) / 59, 0
        for (i = 0; i < 225; i++) print "v", -.1 - i % 15 / 14, int(i / 15) / 14, 0
    }' >"$T/uneven.obj"
    { cat "$T/uneven.obj"; echo v 0 3 0; } >"$T/alone.obj"
    for k in uneven alone; do
        check "points near and far apart: $k" draw $k.obj $k.ppm --up y --view 0,0 --model emissive \
            --background white --no-shadow --quiet
    done
    set -- $(covered "$T/uneven.ppm")
    check "cover the left square: $1 of 100" test "$1" -ge 90
    check "and the right one: $2 of 100" test "$2" -ge 90
    check "one alone is no giant" "$T/look" pixel "$T/alone.ppm" .5 .12 255 255 255 0
    check "few triangles are allowed" draw cloud.ply a.ppm --max-triangles 80
    check "fewer balls" grep "one of 100" "$T/err"
    check "none are" refused "more than 7 triangles" "$THUMBNAIL" "$T/cloud.ply" "$T/none.ppm" --max-triangles 7
    sed 's/^element vertex.*/&/; s/^end_header/element face 1\nproperty list uchar int vertex_indices\nend_header/' \
        "$T/cloud.ply" >"$T/edge.ply"
    echo "2 0 1" >>"$T/edge.ply"
    bad_model "a file of faces that have no area" edge.ply "no face of it has three corners"
}

both() {
    bombs
    creases
    large
    views
    sections
    points
    quick
    surveyed
    upright
    formats
    bad_input
    reports
    gltf_reports
    line_reports
    color_reports
    habit_reports
    writer_reports
    value_reports
    highlights
    bad_output
    bad_options
}

build=plain THUMBNAIL=$T/plain
both
cp "$T/torus.gltf" "$T/torus.dxf"
bad_model "DXF is named with what it needs" torus.dxf "\.dxf files need .*libassimp-dev"
check "PNG likewise" refused "libstb-dev" "$T/plain" "$T/torus.obj" "$T/none.png"
check "a texture likewise" sh -c "'$T/plain' '$T/map.obj' '$T/a.ppm' 2>&1 | grep libstb-dev"

[ "$STB$ASSIMP" ] || finish
build=full THUMBNAIL=$PWD/build/thumbnail
both
[ "$STB" ] && map_reports
[ "$STB" ] && picture_reports
[ "$STB" ] && . examples/programs/thumbnail/test/pictures.sh
[ "$ASSIMP" ] && . examples/programs/thumbnail/test/formats.sh
finish
