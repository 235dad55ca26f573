# pictures.sh - what stb gives: PNG, its alpha, textures, bump and normal maps.  Read by
# thumbnail.sh.

check "PNG by its name" draw torus.obj a.png --samples 1
check "PPM" draw torus.obj a.ppm --samples 1
check "the same picture" "$T/look" same "$T/a.png" "$T/a.ppm" 0
"$THUMBNAIL" "$T/torus.obj" - --png --size 120x90 --samples 1 >"$T/b.png"
check "PNG to standard output" "$T/look" same "$T/b.png" "$T/a.ppm" 0
check "no background" draw flat.obj a.png --background none --no-shadow --rotate 0 --model emissive
check "nothing around" "$T/look" alpha "$T/a.png" 0.01 0.01 0
check "the model is opaque" "$T/look" alpha "$T/a.png" 0.5 0.5 255
color=$("$T/look" display 0.448 0.1329 0.0331)
check "in its own color" "$T/look" pixel "$T/a.png" 0.5 0.5 $color 1
check "glass over nothing" draw glass.obj a.png --background none --no-shadow --rotate 0 \
    --model emissive --size 90x90
check "is as clear as d says" "$T/look" alpha "$T/a.png" 0.5 0.9 64
check "a full device" refused "No space left" "$THUMBNAIL" "$T/torus.obj" /dev/full --png

# quarters of the texture on a square seen from the front, times k_e 0.448
quarters="--model emissive --background black --no-shadow --rotate 0 --size 200x200"
check "texture" draw map.obj a.ppm $quarters
check "no warning" test ! -s "$T/err"
check "blue" pixel 0.28 0.3 0.00945 0.0360 0.2587
check "green" pixel 0.72 0.3 0.00593 0.1572 0.0203
check "red" pixel 0.28 0.75 0.3200 0.0143 0.00302
check "grey" pixel 0.72 0.75 0.0573 0.0573 0.0573
sed 's/map_Kd/map_Ke/' "$T/map.mtl" >"$T/glow.mtl"
sed 's/map.mtl/glow.mtl/' "$T/map.obj" >"$T/glow.obj"
check "a texture of what shines" draw glow.obj b.ppm $quarters
check "shines as a colored surface does" "$T/look" same "$T/a.ppm" "$T/b.ppm" 0
check "no warning about it" test ! -s "$T/err"
sed '/^Ke/d' "$T/glow.mtl" >"$T/bare.mtl"
sed 's/map.mtl/bare.mtl/' "$T/map.obj" >"$T/bare.obj"
check "without Ke" draw bare.obj b.ppm $quarters
check "it shines as it is" sh -c "'$T/look' pixel '$T/b.ppm' 0.72 0.75 $("$T/look" display 0.128 0.128 0.128) 3"
check "holes" draw holes.obj a.ppm $quarters
check "blue stays" pixel 0.28 0.3 0.00945 0.0360 0.2587
check "red is cut out" pixel 0.28 0.75 0 0 0
check "the same alpha, which no map_d asks for" draw whole.obj a.ppm $quarters
check "cuts nothing out" pixel 0.28 0.75 0.3200 0.0143 0.00302
check "map_d with a picture of its own" draw other.obj a.ppm $quarters
check "is a warning" grep "mask.tga.*map_d counts only where it is the picture of map_Kd$" "$T/err"
check "a lost texture" draw lost.obj a.ppm $quarters
check "is a warning" grep "no such file.png.*No such file" "$T/err"
check "and the plain color" pixel 0.5 0.5 0.448 0.1329 0.0331
check "quietly" draw lost.obj a.ppm $quarters --quiet
check "says nothing" test ! -s "$T/err"
printf 'no picture' >"$T/no such file.png"
check "a broken texture" draw lost.obj a.ppm $quarters
check "is a warning too" grep "no such file.png.*no picture" "$T/err"
rm "$T/no such file.png"

# ---- bump and normal maps: a level square whose picture says how it is tilted is lit as the tilted
# square

# A square whose picture lies on it turned or mirrored: name, slopes along x and y, the directions of
# u and v as four numbers.  Writes NAME.obj, level, with a material of its name, and tilted.obj.
square() {
    awk -v name="$T/$1" -v tilted="$T/tilted.obj" -v a="$2" -v b="$3" -v ux="$4" -v uy="$5" -v vx="$6" -v vy="$7" 'BEGIN {
        size = 1.4                      # the file has no unit edge
        obj = name ".obj"
        n = split(name, part, "/")
        print "mtllib " part[n] ".mtl\nusemtl m" >obj
        print "mtllib plain.mtl\nusemtl m" >tilted
        for (i = 0; i < 4; i++) {
            x = (i == 1 || i == 2) - 0.5; y = (i > 1) - 0.5
            print "v", size * x, size * y, 0 >obj
            print "vt", 0.5 + x * ux + y * uy, 0.5 + x * vx + y * vy >obj
            print "v", size * x, size * y, size * (a * x + b * y) >tilted
        }
        print "f 1/1 2/2 3/3 4/4" >obj
        print "f 1 2 3 4" >tilted
    }'
}
# A normal map of one normal (-a, -b, 1), where u and v have these directions, as PPM
normals() {
    awk -v a="$2" -v b="$3" -v ux="$4" -v uy="$5" -v vx="$6" -v vy="$7" 'BEGIN {
        long = sqrt(a * a + b * b + 1)
        print "P3 2 2 255"
        for (i = 0; i < 4; i++)
            print int(127.5 * (1 - (a * ux + b * uy) / long) + 0.5),
                int(127.5 * (1 - (a * vx + b * vy) / long) + 0.5), int(127.5 * (1 + 1 / long) + 0.5)
    }' | pgm 3
}
# A bump map of 64 x 64 texels that rises by the slopes, with white 1.4 above black in the file
heights() {
    awk -v a="$2" -v b="$3" -v ux="$4" -v uy="$5" -v vx="$6" -v vy="$7" 'BEGIN {
        print "P2 64 64 255"
        for (j = 0; j < 64; j++)
            for (i = 0; i < 64; i++) {
                u = (i + 0.5) / 64 - 0.5; v = 0.5 - (j + 0.5) / 64
                print int(127.5 + 255 * ((a * ux + b * uy) * u + (a * vx + b * vy) * v) + 0.5)
            }
    }' | pgm 1
}
# The numbers of a picture as text, with so many channels, as bytes, which is what stb reads
pgm() {
    awk -v channels="$1" '
        NR == 1 { printf "P%d\n%d %d\n255\n", channels == 3 ? 6 : 5, $2, $3; next }
        { for (k = 1; k <= NF; k++) printf "\\%03o", $k }
        END { print "" }' | while IFS= read -r bytes; do
        case $bytes in \\*) printf "$bytes" ;; *) printf '%s\n' "$bytes" ;; esac; done
}
gleam='Kd 0.7 0.6 0.5\nKs 0.3 0.3 0.3\nNs 30\n'
printf "newmtl m\n$gleam" >"$T/plain.mtl"
printf "newmtl m\n${gleam}norm relief.ppm\n" >"$T/tilt.mtl"
printf "newmtl m\n${gleam}map_Bump -bm 1.4 relief.ppm\n" >"$T/ramp.mtl"
relief="--up y --rotate 0 --no-shadow --size 60x60"
tilted() {                      # what, the arguments of square without the name
    of=$1; shift
    square tilt "$@"
    square ramp "$@"
    check "the tilted square" draw tilted.obj a.ppm $relief
    normals x "$@" >"$T/relief.ppm"
    check "$of by normals" draw tilt.obj b.ppm $relief
    check "$of by normals: as the tilted square" "$T/look" middle "$T/a.ppm" "$T/b.ppm" 2
    heights x "$@" >"$T/relief.ppm"
    check "$of by heights" draw ramp.obj c.ppm $relief
    check "$of by heights: as the tilted square" "$T/look" middle "$T/a.ppm" "$T/c.ppm" 2
    check "$of: no warning" test ! -s "$T/err"
}
tilted "to the right" 0.4 0 1 0 0 1
check "a level square" sh -c "printf 'newmtl m\n$gleam' >'$T/ramp.mtl'; '$THUMBNAIL' '$T/ramp.obj' '$T/level.ppm' $relief --samples 1"
printf "newmtl m\n${gleam}map_Bump -bm 1.4 relief.ppm\n" >"$T/ramp.mtl"
check "looks otherwise" no "$T/look" middle "$T/a.ppm" "$T/level.ppm" 8
tilted "upward" 0 0.4 1 0 0 1
tilted "downward" 0.1 -0.3 1 0 0 1
tilted "with the picture turned" 0.3 0.15 0 1 -1 0
tilted "with the picture mirrored" 0.3 -0.2 -1 0 0 1
tilted "with the picture upside down" 0.2 0.3 1 0 0 -1

# of a map that holds heights under the name of normals, and the other way round, the texels tell
cp "$T/ramp.mtl" "$T/keep.mtl"
sed 's/map_Bump -bm/norm -bm/' "$T/keep.mtl" >"$T/ramp.mtl"
check "heights called norm" draw ramp.obj b.ppm $relief
check "are heights" cmp "$T/b.ppm" "$T/c.ppm"
sed 's/-bm 1.4 //' "$T/keep.mtl" >"$T/ramp.mtl"
check "heights without a number" draw ramp.obj b.ppm $relief
check "tilt by less, but tilt" no "$T/look" middle "$T/b.ppm" "$T/level.ppm" 3
check "--shading vertex" draw ramp.obj b.ppm $relief --shading vertex
check "knows no reliefs" "$T/look" middle "$T/b.ppm" "$T/level.ppm" 6
check "one color, without the file's surfaces" draw ramp.obj b.ppm $relief --color '#c08040'
check "has none either" sh -c "'$THUMBNAIL' '$T/ramp.obj' '$T/c.ppm' $relief --samples 1 --color '#c08040' &&
    cmp '$T/b.ppm' '$T/c.ppm'"
rm "$T/relief.ppm"
check "a lost relief" draw ramp.obj b.ppm $relief
check "is a warning" grep "relief.ppm.*No such file" "$T/err"
check "and level" cmp "$T/b.ppm" "$T/level.ppm"

# a sheet of waves, once as triangles and once as the picture of their heights
waves() {
    awk -v obj="$T/waves.obj" 'BEGIN {
        n = 64; print "mtllib plain.mtl\nusemtl m" >obj
        for (j = 0; j <= n; j++)
            for (i = 0; i <= n; i++)
                print "v", i / n, j / n, 0.02 * cos(6.2831853 * 3 * i / n) * cos(6.2831853 * 2 * j / n) >obj
        for (j = 0; j < n; j++)
            for (i = 0; i < n; i++) {
                k = j * (n + 1) + i + 1
                print "f", k, k + 1, k + n + 2, k + n + 1 >obj
            }
        print "P2 128 128 255"
        for (j = 0; j < 128; j++)
            for (i = 0; i < 128; i++)
                print int(128 + 127.5 * cos(0.14726 * (i + 0.5)) * cos(0.098175 * (j + 0.5)))
    }' | pgm 1 >"$T/relief.ppm"
    printf 'mtllib waves.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n' >"$T/sheet.obj"
    printf "newmtl m\n${gleam}bump -bm 0.04 relief.ppm\n" >"$T/waves.mtl"
}
waves
check "waves of triangles" draw waves.obj a.ppm $relief
check "waves of texels" draw sheet.obj b.ppm $relief
check "are lit alike" "$T/look" near "$T/a.ppm" "$T/b.ppm" 2
printf "newmtl m\n$gleam" >"$T/waves.mtl"
check "without the picture" draw sheet.obj b.ppm $relief
check "they are not" no "$T/look" near "$T/a.ppm" "$T/b.ppm" 4

# glTF as assimp writes it: the same normal map through assimp
if [ "$ASSIMP" ] && compile examples/programs/thumbnail/test/convert.c -lassimp -o "$T/convert" 2>/dev/null; then
    square tilt 0.3 -0.2 -1 0 0 1
    normals x 0.3 -0.2 -1 0 0 1 >"$T/relief.ppm"
    check "glTF is written" "$T/convert" "$T/tilt.obj" gltf2 "$T/tilt.gltf"
    check "glTF has the normal map" grep -q normalTexture "$T/tilt.gltf"
    check "the tilted square as glTF" "$T/convert" "$T/tilted.obj" gltf2 "$T/tilted.gltf"
    check "the tilted square of glTF" draw tilted.gltf a.ppm $relief
    check "normals of glTF" draw tilt.gltf b.ppm $relief
    check "glTF by normals: as the tilted square" "$T/look" middle "$T/a.ppm" "$T/b.ppm" 2
fi
