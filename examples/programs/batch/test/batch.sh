#!/bin/sh
# batch.sh - build/batch: pieces that are whole or absent, resumed, over several jobs and machines,
# into ffmpeg.  What is not installed is named and left out.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
HERE=$PWD BATCH=$PWD/build/batch CC=${CC:-cc}
export LC_ALL=C PARALLEL_HOME=/nonexistent
running= patience=60
trap 'kill $running 2>/dev/null; rm -rf "$T"' EXIT

${MAKE:-make} -s build/batch build/thumbnail build/compare build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
[ -x "$BATCH" ] || { echo "batch: left out, it needs POSIX"; finish; }
cd "$T" || exit 1

refused() { refused_by batch "$@"; }

# ---- frames -------------------------------------------------------------------------------------
turn="--frames 12 --size 97x60 --samples 2"
missing() { "$BATCH" $turn --out "$1" --missing | tr '\n' ' '; }
check "frames into a folder" "$BATCH" $turn --out one
check "nobody watches: no word" same "$(wc -c <log)" 0
check "twelve" same "$(ls one | tr '\n' ' ')" "$(seq -f %05g.ppm 0 11 | tr '\n' ' ')"
check "each one another" same "$(cksum one/* | cut -d ' ' -f 1 | sort -u | wc -l)" 12
check "none is missing" same "$(missing one)" ""
check "the same through a pipe" sh -c "'$BATCH' $turn --pipe | cmp - all.ppm" \
    "$(cat one/* >all.ppm)"
for k in 7 00007; do check "piece $k alone" "$BATCH" $turn --out alone --piece $k; done
check "is that piece" cmp one/00007.ppm alone/00007.ppm
check "and no other" same "$(ls alone)" 00007.ppm

check "the quick light" "$BATCH" $turn --out quick --piece 7 --quick --threads 1
check "is another one" no cmp -s one/00007.ppm quick/00007.ppm
check "by threads as well" sh -c "'$BATCH' $turn --piece 7 --quick --threads 2 --pipe | cmp - quick/00007.ppm"

# A square whose normal map leans is lit by the quick light as a square that leans itself.
leaning() {                     # name, its slopes along x and y, a line of its material: eight pixels in the middle
    awk -v name="$1" -v a="$2" -v b="$3" 'BEGIN {
        print "mtllib " name ".mtl\nusemtl m"
        for (i = 0; i < 4; i++) {
            x = (i == 1 || i == 2) - 0.5; y = (i > 1) - 0.5
            print "v", x, y, a * x + b * y
            print "vt", x + 0.5, y + 0.5
        }
        print "f 1/1 2/2 3/3 4/4"
    }' >"$1.obj"
    printf 'newmtl m\nKd .8 .5 .3\n%s\n' "$4" >"$1.mtl"
    "$BATCH" "$1.obj" --frames 1 --size 64x64 --quick --no-shadow --up z --view 20,60 --quiet --pipe |
        tail -c 6048 | head -c 24 >"$1.pixels"
    { printf 'P6 8 1 255\n'; cat "$1.pixels"; } >"$1.ppm"
}
if echo | $CC -fsyntax-only -include stb/stb_image.h -x c - 2>/dev/null; then
    printf 'P6 1 1 255\n\122\242\362' >normal.ppm    # of (-.4, .3, 1)
    leaning level 0 0
    leaning leans .4 -.3
    leaning mapped 0 0 "norm normal.ppm"
    check "a normal map bends the quick light" "$HERE/build/compare" --limit 1 leans.ppm mapped.ppm
    check "which a level square has otherwise" no "$HERE/build/compare" --limit 9 --count 7 level.ppm mapped.ppm
fi

# An unlit square has its own colour, in each light: pixels that have it.
bytes=$(printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200?\0\0\0\0\0\0\0\0\0\0\200?\0\0\200?\0\0\0\0\0\0\0\0\0\0\200?\0\0\0\0' | base64 | tr -d '\n')
printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"mode":6,
    "attributes":{"POSITION":0},"material":0}]}],"materials":[{"extensions":{"KHR_materials_unlit":{}},
    "pbrMetallicRoughness":{"baseColorFactor":[0.6,0.3,0.2,1]}}],"buffers":[{"uri":"data:;base64,%s"}],
    "bufferViews":[{"buffer":0,"byteLength":48}],"accessors":[{"bufferView":0,"count":4,"componentType":5126,
    "type":"VEC3"}]}' "$bytes" >unlit.gltf
for k in "" --quick "--again 0,0,1,0,0,l" "--again 0,0,1,0,0,ls"; do
    "$BATCH" unlit.gltf --frames 1 --size 64x64 --samples 1 $k --quiet --pipe >unlit.ppm
    count=$(tail -c 12288 unlit.ppm | od -An -v -tu1 -w3 | grep -c "203 149 124")
    check "unlit, $k: $count" test "$count" -gt 1000
done

# The first frame is from the side that thumbnail shows: of a box with a red front, a green right and
# a blue left side both see as much of each, to a part of the box.
cat >side.mtl <<END
newmtl red
Kd 1 0 0
newmtl green
Kd 0 1 0
newmtl blue
Kd 0 0 1
newmtl white
Kd 1 1 1
END
cat >side.obj <<END
mtllib side.mtl
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
usemtl red
f 5 6 7 8
usemtl green
f 2 3 7 6
usemtl blue
f 1 5 8 4
usemtl white
f 2 1 4 3
f 8 7 3 4
f 1 2 6 5
END
hues() {                        # a picture: hundredths of red, green, blue among its coloured pixels
    tail -c 27648 "$1" | od -An -v -tu1 -w3 | awk '
        function most(a, b, c) { return a > 2 * b && a > 2 * c }
        { red += most($1, $2, $3); green += most($2, $1, $3); blue += most($3, $1, $2) }
        END { n = (red + green + blue) / 100 + 1e-9; print int(red / n), int(green / n), int(blue / n) }'
}
alike() {                       # two lists of hundredths
    echo "$1 $2" | awk '{ for (k = 1; k < 4; k++) if (($k - $(k + 3)) ^ 2 > 36) exit 1 }'
}
"$BATCH" side.obj --frames 1 --size 96x96 --no-shadow --pipe >side.ppm
"${BATCH%batch}thumbnail" side.obj side_thumbnail.ppm --size 96x96 --no-shadow
first() { "$BATCH" side.obj --frames 1 --size 96x96 --no-shadow --pipe "$@"; }
first >side.ppm
first --view 30,19.8 >right.ppm
first --view -30,19.8 >left.ppm
"${BATCH%batch}thumbnail" side.obj thumbnail.ppm --size 96x96 --no-shadow
hue=$(hues thumbnail.ppm)
check "the first frame is from thumbnail's side: $hue" alike "$hue" "$(hues side.ppm)"
check "not from the other one" no alike "$hue" "$(hues right.ppm)"
check "which has a name" "$HERE/build/compare" --limit 2 left.ppm side.ppm

# a turn begins where --view stands; a quarter of it later the left side is seen
check "four frames from the front" "$BATCH" --frames 4 --size 97x60 --view front --out turned
check "and two from the left" "$BATCH" --frames 2 --size 97x60 --view left --out left
check "begin where the second was" "$HERE/build/compare" --limit 3 turned/00001.ppm left/00000.ppm
check "which the first was not" no "$HERE/build/compare" --limit 3 --count 20 turned/00000.ppm left/00000.ppm
check "from above" "$BATCH" --strips 1 --size 97x60 --view top --out above
check "is another picture" no "$HERE/build/compare" --limit 3 --count 20 turned/00000.ppm above/00000.ppm

for n in 1 2 7 256; do
    check "by $n threads" "$BATCH" $turn --out threads$n --threads $n
    check "the same frames by $n threads" diff -r one threads$n
done

# resumed: what is there stays, what is cut or of another size is drawn again
cp -r one two
rm two/00003.ppm
: >two/00004.ppm
head -c 5000 one/00005.ppm >two/00005.ppm
sed '1,2s/^97 60$/60 97/' one/00006.ppm >two/00006.ppm
check "four are missing" same "$(missing two)" "00003 00004 00005 00006 "
: >before
sleep 1.1                       # the clock of any file system
check "resumed" "$BATCH" $turn --out two
check "to the same bits" diff -r one two
check "four were drawn" same "$(find two -name '*.ppm' -newer before | wc -l)" 4

# what is there and of something else is refused, and stays
other() { "$BATCH" "$@" --out one; }
refuses() { refused "one: holds pieces of another model or of other options" other "$@"; }
cp -r one before_one
printf 'v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >wedge.obj
check "another model into these frames" refuses wedge.obj $turn
check "one that does not exist" refused "none.obj: No such file" other none.obj $turn
for k in "--quick" "--no-shadow" "--view top" "--color red" "--up z" "--shading face" "--model phong" \
    "--section x --quiet" "--section x=0.5 --quiet" "--view 0,0,1.5" "--again 28.6,20,1,0.2,0" "--again 28.6,20,1,0,0,w"; do
    check "$k" refuses $turn $k
done
check "fewer frames" refuses --frames 11 --size 97x60
check "strips" refuses --strips 12 --size 97x60
check "which are missing then" refuses $turn --quick --missing
check "more threads are the same" other $turn --threads 3 --max-triangles 9000000 --quiet
check "they stay" diff -r one before_one
"$BATCH" wedge.obj $turn --out edited
sed 's/^v 0 2 0/v 0 3 0/' wedge.obj >wedge2.obj && mv wedge2.obj wedge.obj
check "a model that has changed" refused "edited: holds" "$BATCH" wedge.obj $turn --out edited
# a picture on the model is more than its texels: 2 x 1 or 1 x 2 of them, and what is beyond its edges
leaf() {                        # how the texture goes on, its size
    printf 'P6 %s 255\n\377\0\0\0\377\0' "$2" >leaf.ppm
    cat >leaf.gltf <<END
{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":$1}],"images":[{"uri":"leaf.ppm"}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},
{"bufferView":1,"componentType":5126,"type":"VEC2","count":3}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"buffers":[{"byteLength":60,"uri":
"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAEBAAAAAAAAAAAAAAEBA"}]}
END
    "$BATCH" leaf.gltf --frames 1 --size 97x60 --out leaf
}
if echo | $CC -fsyntax-only -include stb/stb_image.h -x c - 2>/dev/null; then
    check "a model with a picture" leaf 10497 "2 1"
    check "which is the same" leaf 10497 "2 1"
    check "which ends at its edges" refused "leaf: holds" leaf 33071 "2 1"
    check "which is mirrored there" refused "leaf: holds" leaf 33648 "2 1"
    check "which is as high as it was wide" refused "leaf: holds" leaf 10497 "1 2"
else echo "batch: no stb_image.h: pictures on models are left out"
fi
rm edited/*.ppm
check "where no frame is left" "$BATCH" wedge.obj $turn --out edited
check "all are drawn" same "$(ls edited | wc -l)" 12
# another job takes the folder while the first piece of this one is drawn
"$BATCH" --frames 2 --size 3000x2000 --samples 4 --out taken 2>taken.err & running=$!
soon test -s taken/.shade-batch
check "a folder without pieces is anybody's" "$BATCH" wedge.obj --frames 2 --size 60x40 --out taken
wait $running; check "the job that had it" same $? 1
running=
check "is told" grep -q "^batch: taken: holds pieces of another model" taken.err
check "and leaves it to the other" same "$(cat taken/*.ppm | wc -c) $(ls taken | tr '\n' ' ')" \
    "14426 00000.ppm 00001.ppm "
: >unknown.txt; mkdir unknown; cp one/00003.ppm unknown
check "frames without a word of what they are" refused "unknown: holds" "$BATCH" $turn --out unknown

# ended in the middle
slow="--frames 40 --size 600x400 --out cut"
for signal in TERM HUP INT KILL; do
    rm -rf cut
    # a job of a shell without job control is deaf to INT
    env --default-signal=INT,TERM,HUP "$BATCH" $slow & running=$!
    soon test -s cut/00001.ppm
    kill -$signal $running
    wait $running 2>/dev/null
    check "SIG$signal: ends it" test $? -gt 128
    check "SIG$signal: frames that are there are whole" \
        same "$(find cut -name '*.ppm' ! -size 720015c | wc -l)" 0
    [ $signal = KILL ] || check "SIG$signal: nothing else stays" same "$(ls cut | grep -c part)" 0
done
running=
check "SIGINT while it reads a large file" interrupted "$BATCH" "$T/noise.stl" --frames 2 --out none
# parts: of a process of this machine that is gone, of one that lives, of another machine
host=$(uname -n | sed 's|[].*?[/\\]|-|g')
dead=$(sh -c 'echo $$')
mkdir swept
for part in $host.$dead $host.$$ elsewhere.$dead; do : >"swept/00000.ppm.$part.part"; done
check "one frame" "$BATCH" --frames 1 --size 60x40 --samples 1 --out swept
check "sweeps what a killed job has left, nothing else" same "$(ls swept | tr '\n' ' ')" \
    "$(printf '%s\n' 00000.ppm "00000.ppm.$host.$$.part" "00000.ppm.elsewhere.$dead.part" |
        sort | tr '\n' ' ')"

# the six axes: a model and its copy with turned coordinates are one picture
printf 'v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >y.obj
printf 'v 0 0 0\nv 0 -1 0\nv 2 0 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >x.obj
printf 'v 0 0 0\nv 0 1 0\nv -2 0 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >-x.obj
for up in y x -x; do
    check "--up $up" "$BATCH" ./$up.obj --up $up --frames 1 --size 60x40 --samples 1 --out up$up
    check "is upright" cmp upy/00000.ppm up$up/00000.ppm
done

# ---- strips -------------------------------------------------------------------------------------
poster="--size 301x407 --samples 2"
check "a poster in one" "$BATCH" $poster --strips 1 --out whole
check "is a picture" same "$(head -c 15 whole/00000.ppm | tr '\n' ' ')" "P6 301 407 255 "
check "of its size" same "$(wc -c <whole/00000.ppm)" $((15 + 301 * 407 * 3))
for n in 2 7 61; do
    check "in $n strips" "$BATCH" $poster --strips $n --out strips$n
    check "the same bits in $n strips" sh -c "cat strips$n/*.ppm | cmp - whole/00000.ppm"
done
check "five strips by 3 threads" sh -c \
    "'$BATCH' $poster --strips 5 --pipe --threads 3 | cmp - whole/00000.ppm"
check "through a pipe" sh -c "'$BATCH' $poster --strips 5 --pipe | cmp - whole/00000.ppm"
rm strips7/00002.ppm
check "a strip is missing" same "$("$BATCH" $poster --strips 7 --out strips7 --missing)" 00002
# in cells, as a picture larger than 16384 samples is: within the rounding of their cameras
cells="$CC -std=c99 -O2 -w -pthread -I. -DSHADE__IMPLEMENTED -DSHEET_CELL=150 -DSHEET_BAND=9000"
check "smaller cells" sh -c "cd '$OLDPWD' && $cells examples/programs/batch/batch.c build/shade.o -lm -o $T/cells"
check "their poster" ./cells $poster --strips 3 --out cells3
cat cells3/*.ppm >cells.ppm
check "cells leave no seam" "${BATCH%batch}compare" --limit 2 --count 0 whole/00000.ppm cells.ppm
check "strips of cells" sh -c "./cells $poster --strips 1 --pipe | cmp - cells.ppm"

# ---- a terminal ---------------------------------------------------------------------------------
if command -v script >/dev/null; then
    watched() { script -qec "'$BATCH' $turn $*" /dev/null </dev/null | tr '\r' '\n' >screen; }
    watched --out watched
    check "the time that is left" \
        grep -Eq "^1 of 12 frames, 8 %, [0-9]+:[0-9][0-9]:[0-9][0-9] left" screen
    check "and the time it took" grep -Eq "^12 of 12 frames, 100 %, [0-9.]+ s" screen
    watched --pipe
    check "no picture on a terminal" grep -q "^batch: standard output is a terminal" screen
else echo "no script: the progress line is left out"
fi

# ---- bad input ----------------------------------------------------------------------------------
: >empty.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1' >half.obj
check "a missing model" refused "none.obj: No such file" "$BATCH" none.obj --frames 2
check "an empty one" refused "empty" "$BATCH" empty.obj --frames 2
check "half a model" refused "half.obj:3" "$BATCH" half.obj --frames 2
check "a folder for a model" refused "directory" "$BATCH" one --frames 2
check "nothing to make" refused "what shall it make? --frames" "$BATCH" y.obj
check "no frame of them" same "$(ls frames 2>/dev/null | wc -l)" 0
for bad in "--samples 3: 1, 2 or 4" "--up w: x, y, z, -x, -y or -z" "--threads 0: a whole number: 1 .. 256 (one a core)" \
    "--frames 0: one turn in N pictures"; do
    # the option and its value end at the colon
    check "$bad" refused "$bad" "$BATCH" ${bad%%:*}
done
for bad in "--frames 0" "--strips 100000" "--size 0x5" "--size 5" "--size 300000x5" "--size 5x5x5" \
    "--samples 9" "--threads 0" "--threads 257" "--piece -1" "--up w" \
    "--color redd" "--material x" "--model x" "--shading x" "--max-triangles -1" "--max-memory 31"; do
    check "$bad" refused "$bad: " "$BATCH" $bad
done
check "a piece too far" refused "count from 0" "$BATCH" --frames 3 --piece 3
check "strips and frames" refused "frames does not go with --strips" "$BATCH" --strips 2 --frames 2
check "frames and strips" refused "frames does not go with --strips" "$BATCH" --frames 2 --strips 2
check "a pipe into a folder" refused "pipe does not go with --out" "$BATCH" --frames 2 --pipe --out a
check "a film into a folder" refused "film does not go with --out" "$BATCH" --film a.webp --out a
check "numbers into a pipe" refused "pipe does not go with --missing" "$BATCH" --frames 2 --pipe --missing
check "the rate of no film" refused "rate needs --film" "$BATCH" --frames 2 --rate 25 --out a
check "a view that is none" refused "view 1,2,99: from where it is seen" "$BATCH" --frames 2 --view 1,2,99
check "more strips than rows" refused "more strips than rows" "$BATCH" --size 9x9 --strips 10
check "an unknown option" refused "unknown option --frob" "$BATCH" --frob
check "an option without its value" refused "size needs a value" "$BATCH" --size
check "two models" refused "one file too many: b.obj" "$BATCH" a.obj b.obj
check "a file for a folder" refused "Not a directory" "$BATCH" $turn --out empty.obj
check "a folder in none" refused "No such file" "$BATCH" $turn --out none/frames
check "help" sh -c "'$BATCH' --help | grep -q '^usage: batch'"
[ -w /dev/full ] && check "no room" refused "No space" sh -c "'$BATCH' $turn --pipe >/dev/full"
[ -w /dev/full ] && check "no room for numbers, and for help" sh -c "
    ! '$BATCH' $turn --missing >/dev/full && ! '$BATCH' --help >/dev/full &&
    ! '$BATCH' --material list >/dev/full"
check "no room for a file" refused "too large" \
    sh -c "trap '' XFSZ; ulimit -f 4; exec '$BATCH' $turn --out full"
check "nothing half-written" same "$(ls full | wc -l)" 0
if (ulimit -v 100000) 2>/dev/null; then
    check "no memory for a large picture" refused "out of memory" sh -c "ulimit -v 100000
        exec '$BATCH' --frames 1 --size 262144x100 --samples 4 --pipe >/dev/null"
fi
check "nobody reads" refused "Broken pipe" \
    sh -c "trap '' PIPE; { '$BATCH' $turn --pipe; echo \$? >status; } | :; exit \$(cat status)"

for bad in "--film a.gif" "--rate 0" "--rate 241"; do
    check "$bad" refused "$bad: " "$BATCH" $bad
done
mkdir bare; ln -s "$(command -v uname)" bare/uname
check "a film without ffmpeg" refused "which is not installed" env PATH="$T/bare" "$BATCH" $turn --size 96x60 \
    --film a.mp4

# ---- several jobs, and machines -----------------------------------------------------------------
if command -v parallel >/dev/null; then
    mkdir home; export PARALLEL_HOME=$T/home; : >home/will-cite
    jobs() {                    # folder, options of parallel
        folder=$1; shift
        "$BATCH" $turn --out "$folder" --missing |
            parallel "$@" "$BATCH" $turn --out "$folder" --piece '{}'
    }
    check "two jobs" jobs local -j 2
    check "the same frames" diff -r one local
    rm local/00002.ppm local/00009.ppm
    check "resumed by jobs" jobs local --sshlogin 2/:
    check "the same again" diff -r one local
    # ssh to machines that have this folder, too; as sshd does, it names the user's shell
    printf '#!/bin/sh\n%s\n%s\n' 'echo "$1" >>asked; shift; [ "$1" = -- ] && shift' \
        'SHELL=/bin/sh exec sh -c "$*"' >ssh
    chmod +x ssh
    check "two machines" jobs machines --ssh "$T/ssh" --sshlogin 1/ann,1/bob --workdir "$T"
    check "their frames" diff -r one machines
    check "both worked" same "$(sort -u asked | tr '\n' ' ')" "ann bob "
    check "a poster by two jobs" sh -c \
        "seq 0 6 | parallel -j 2 '$BATCH' $poster --strips 7 --out jobs --piece {}"
    check "put together" sh -c "cat jobs/*.ppm | cmp - whole/00000.ppm"
    # a sheet for each model of a folder, resumed; one model is broken
    mkdir -p parts/inner
    cp y.obj "parts/a part.obj"; cp x.obj parts/inner/x.obj; cp half.obj parts/half.obj; : >parts/notes.txt
    sheets() {
        THUMBNAIL=${BATCH%batch}thumbnail sh "$HERE/examples/programs/batch/sheets.sh" parts sheets --size 400x300 "$@" \
            2>sheets.err
    }
    check "sheets of a folder, but for a broken model" no sheets --edges
    check "which is named" grep -q "half.obj:3" sheets.err
    check "the others are there" same "$(find sheets -name '*.png' | sort | tr '\n' ' ')" \
        "sheets/a part.obj.png sheets/inner/x.obj.png "
    rm parts/half.obj sheets/inner/x.obj.png
    touch -d '2001-01-01' parts/*.obj parts/inner/*.obj
    sleep 1.1; : >before; sleep 1.1
    for k in "nowhere made:nowhere: is no folder" "parts half.obj:half.obj: is no folder" \
        "parts made --json=x.json:--json=x.json names one file, for many models"; do
        check "$k" refused_by shade-sheets "${k##*:}" sh "$HERE/examples/programs/batch/sheets.sh" ${k%%:*}
    done
    check "no folder is made" test ! -e made
    mkdir bare_parts
    THUMBNAIL=$BATCH sh "$HERE/examples/programs/batch/sheets.sh" bare_parts made 2>sheets.err
    check "no models" grep -q "^shade-sheets: bare_parts has no models" sheets.err
    check "resumed" sheets --edges
    check "the missing one is drawn" test sheets/inner/x.obj.png -nt before
    check "the other stays" no test "sheets/a part.obj.png" -nt before
    touch "parts/a part.obj"
    check "a model that has changed" sheets --edges
    check "is drawn again" test "sheets/a part.obj.png" -nt before
else echo "no parallel: several jobs are left out"
fi

# ---- a film -------------------------------------------------------------------------------------
if command -v ffmpeg >/dev/null; then
    film() { ffmpeg -v error -nostdin -y "$@"; }
    check "frames through ffmpeg" sh -c "'$BATCH' $turn --pipe | ffmpeg -v error -f image2pipe \
        -framerate 30 -i - -f image2pipe -c:v ppm - | cmp - all.ppm"
    check "from the folder" film -framerate 30 -i one/%05d.ppm -f image2pipe -c:v ppm film.ppm
    check "the same frames" cmp film.ppm all.ppm
    check "a film" sh -c "'$BATCH' $turn --size 96x60 --pipe | ffmpeg -v error -y -f image2pipe \
        -framerate 30 -i - -pix_fmt yuv420p film.mp4"
    check "of twelve frames" same "$(ffprobe -v error -count_frames -select_streams v \
        -show_entries stream=nb_read_frames -of csv=p=0 film.mp4)" 12
    for k in webp mp4; do
        check "one command for $k" "$BATCH" $turn --size 96x60 --film turn.$k --rate 25
        check "no word" same "$(wc -c <log)" 0
        check "no part" same "$(ls -d *.part 2>/dev/null)" ""
    done
    check "twelve frames" same "$(ffprobe -v error -count_frames -select_streams v \
        -show_entries stream=nb_read_frames,r_frame_rate -of csv=p=0 turn.mp4)" 25/1,12
    # RIFF, WEBP, and a chunk of animation with a frame for each that differs from the last
    check "an animation" same "$(head -c 12 turn.webp | tr -d '\0' | cut -c 1-4)" RIFF
    check "of twelve frames" same "$(grep -ao ANMF turn.webp | wc -l)" 12
    film -i turn.mp4 -frames:v 1 first.ppm
    "$BATCH" $turn --size 96x60 --piece 0 --out even
    check "that shows the first frame" "${BATCH%batch}compare" --limit 40 --count 5% even/00000.ppm first.ppm
    # its colours say what they are, and are what the frames have
    check "an MP4 tells its colours" same "$(ffprobe -v error -show_entries \
        stream=color_range,color_space,color_transfer,color_primaries -of csv=p=0 turn.mp4)" \
        tv,bt709,iec61966-2-1,bt709
    "$BATCH" wedge.obj --frames 2 --size 96x60 --color '#e60000' --shading face --film red.mp4
    "$BATCH" wedge.obj --frames 2 --size 96x60 --color '#e60000' --shading face --out red
    film -i red.mp4 -frames:v 1 -vf scale=in_color_matrix=bt709:flags=accurate_rnd red.ppm
    check "red plays as red" "${BATCH%batch}compare" --limit 12 --count 6% red/00000.ppm red.ppm
    full() { (trap '' XFSZ; ulimit -f 8; exec "$BATCH" $turn --size 96x60 --film "$1"); }
    for k in full.mp4 full.webp; do
        echo old >$k
        full $k 2>err; check "$k: a full disk" same $? 1
        check "is said" grep -q "^batch: $k: ffmpeg could not make it" err
        check "leaves the old film" same "$(cat $k)" old
        check "and no part" no test -e $k.*.part
    done
    # an encoder that makes its file late, as ffmpeg does with its first frame
    mkdir late; printf '#!/bin/sh\nsleep 1\nfor k; do :; done\necho late >"$k"\n' >late/ffmpeg; chmod +x late/ffmpeg
    for signal in INT TERM; do
        env --default-signal=INT PATH="$T/late:$PATH" "$BATCH" --frames 90 --size 600x400 --film late.mp4 2>/dev/null &
        running=$!
        soon sh -c 'ls late.mp4.*.part'
        kill -$signal $running
        wait $running 2>/dev/null
        sleep 1.5
        check "SIG$signal: nothing comes later" no test -e late.mp4.*.part
    done
    check "an MP4 of odd size" refused "size 97x60: MP4 needs even" "$BATCH" $turn --film odd.mp4
    check "a film of strips" refused "does not go with" "$BATCH" --strips 3 --film a.mp4
    check "a film where nothing can be" refused "none/a.webp" "$BATCH" $turn --film none/a.webp 2>/dev/null
    for signal in TERM KILL; do
        "$BATCH" --frames 90 --size 600x400 --film cut.mp4 2>/dev/null & running=$!
        soon sh -c 'ls cut.mp4.*.part'
        kill -$signal $running
        wait $running 2>/dev/null
        check "SIG$signal: no half film" test ! -e cut.mp4
        [ $signal = KILL ] || check "SIG$signal: nothing stays" no test -e cut.mp4.*.part
    done
    running=
else echo "no ffmpeg: the film is left out"
fi
finish
