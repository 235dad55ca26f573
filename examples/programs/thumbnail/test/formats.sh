# formats.sh - what assimp gives, and real files.  Read by thumbnail.sh.

same "glTF as OBJ" torus.obj torus.gltf 0
same "nodes that move, turn, stretch and mirror" nodes.obj nodes.gltf 1 "--up y"
cp "$T/torus.gltf" "$T/torus.cut.gltf"
head -c 2000 "$T/torus.gltf" >"$T/torus.cut.gltf"
bad_model "glTF cut off" torus.cut.gltf "torus.cut.gltf"
sed 's/"byteOffset":3456/"byteOffset":99999999/' "$T/torus.gltf" >"$T/torus.far.gltf"
bad_model "glTF that reaches beyond its buffer" torus.far.gltf "torus.far.gltf"
printf 'glTF\002\000\000\000\377\377\377\177' >"$T/hostile.glb"
bad_model "GLB of 2 GB in 12 bytes" hostile.glb "hostile.glb"
check "too many triangles in glTF" refused "more than 100" "$THUMBNAIL" "$T/torus.gltf" \
    "$T/none.ppm" --max-triangles 100

# what assimp itself writes of matte.obj; of these formats two keep its colors and sharp edges
if compile examples/programs/thumbnail/test/convert.c -lassimp -o "$T/convert" 2>/dev/null; then
    check "matte" draw matte.obj a.ppm
    for k in collada:dae fbxa:fbx glb2:glb 3ds:3ds x:x 3mf:3mf; do
        check "${k%:*} is written" "$T/convert" "$T/matte.obj" "${k%:*}" "$T/matte.${k#*:}"
        check "${k%:*} is drawn" draw "matte.${k#*:}" b.ppm --up y
        case $k in
        collada:* | fbxa:*)
            check "${k%:*} as OBJ with MTL" "$T/look" same "$T/a.ppm" "$T/b.ppm" 2 ;;
        esac
    done
fi

# 3DS has its shininess in percent: 40 of them are an exponent of 2^4 = 16, as MTL has it
if there python3; then
    (cd "$T" && python3 -c "
from struct import pack
def chunk(kind, *inside):
    return pack('<HI', kind, 6 + sum(map(len, inside))) + b''.join(inside)
def color(kind, *rgb): return chunk(kind, chunk(0x11, bytes(rgb)))
def percent(kind, p): return chunk(kind, chunk(0x30, pack('<h', p)))
points = (0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)
faces = (0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)
surface = chunk(0xafff, chunk(0xa000, b's\0'), color(0xa020, 128, 26, 26), color(0xa030, 204, 204, 204),
                percent(0xa040, 40), percent(0xa041, 100), chunk(0xa100, pack('<H', 3)))
mesh = chunk(0x4100, chunk(0x4110, pack('<H', 4), *(pack('<3f', *p) for p in points)),
             chunk(0x4120, pack('<H', 4), *(pack('<4H', *f, 7) for f in faces),
                   chunk(0x4130, b's\0', pack('<5H', 4, 0, 1, 2, 3)), chunk(0x4150, pack('<4I', 1, 2, 4, 8))))
open('gloss.3ds', 'wb').write(chunk(0x4d4d, chunk(0x3d3d, surface, chunk(0x4000, b'o\0', mesh))))
shape = 'usemtl s\nv 0 0 0\nv 2 0 0\nv 0 0 -2\nv 0 2 0\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n'
for n in 16, 40:
    open(f'gloss{n}.obj', 'w').write(f'mtllib gloss{n}.mtl\n' + shape)
    open(f'gloss{n}.mtl', 'w').write(f'newmtl s\nKd .50196 .10196 .10196\nKs .8 .8 .8\nNs {n}\n')")
    same "40 percent of 3DS" gloss.3ds gloss16.obj 0 "--up y --view=-40,30"
    check "Ns 40" draw gloss40.obj b.ppm --up y --view=-40,30
    check "is another highlight" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 5
fi

{ echo '<?xml version="1.0"?><amf unit="inch"><object id="1"><mesh><vertices>'
    printf "$wedge" | sed 's|v \(.*\) \(.*\) \(.*\)|<vertex><coordinates><x>\1</x><y>\2</y><z>\3</z></coordinates></vertex>|'
    echo '</vertices><volume>'
    printf "$ply_faces" | sed 's|3 \(.\) \(.\) \(.\)|<triangle><v1>\1</v1><v2>\2</v2><v3>\3</v3></triangle>|'
    echo '</volume></mesh></object></amf>'; } >"$T/wedge.amf"
same "AMF without a colour is not black" wedge.obj wedge.amf 0 "--up y"
sed 's|</amf>|<constellation id="2"><instance objectid="1"><deltax>5</deltax></instance></constellation>&|' \
    "$T/wedge.amf" >"$T/placed.amf"
check "AMF with a constellation" draw placed.amf a.ppm
check "is told" said "placed.amf: the places of its constellations"
if there python3; then
    (cd "$T" && python3 -c "
import zipfile
for name, kind, inside in ('packed', 8, 'wedge.amf'), ('stored', 0, 'Wedge.AMF'), ('empty', 0, 'a.txt'):
    zipfile.ZipFile(name + '.amf', 'w', kind).write('wedge.amf', inside)")
    for k in packed stored; do
        { [ $k = packed ] && [ ! "$ZLIB" ]; } || same "AMF that is an archive, $k" wedge.amf $k.amf 0 ""
    done
    bad_model "an archive of something else" empty.amf "there is no .amf in the archive"
fi
dxf() { printf '%s\n' 0 SECTION 2 ENTITIES "$@" 0 ENDSEC 0 EOF; }
line="0 LINE 8 0 10 0 20 0 30 0 11 2 21 0 31 9"
face="0 3DFACE 8 0 10 0 20 0 30 0 11 2 21 0 31 0 12 0 22 1.5 32 0 13 0 23 1.5 33 0"
dxf $face >"$T/face.dxf"
dxf $face $line >"$T/both.dxf"
dxf $line >"$T/line.dxf"
same "a line beside a face" face.dxf both.dxf 0 "--up y"
check "is told" said "both.dxf: its points and lines"
bad_model "lines alone" line.dxf "line.dxf: points and lines alone are not drawn"

# formats beside another reader, by their triangles and the proportions of their boxes
CORPUS=/usr/share/assimp/models
shape() {                       # model: its triangles and the edges of its box
    "$THUMBNAIL" "$1" "$T/shape.ppm" --views front --size 300x200 --json "$T/shape.json" --quiet &&
        sed -n 's/.*"triangles": \([0-9]*\), "nothing".*/\1/p
            s/^  "box": .*"size": \[\(.*\)\] },/\1/p' "$T/shape.json" | tr -d , | tr '\n' ' '
}
alike() {                       # two such lines: as many triangles, edges in the same proportions
    echo "$1 $2"
    echo "$1 $2" | awk 'function rank(i, k, t) {    # the edges from i on, the longest first
            for (k = 0; k < 3; k++) for (t = i; t < i + 2; t++)
                if ($t < $(t + 1)) { swap = $t; $t = $(t + 1); $(t + 1) = swap } }
        { rank(2); rank(6); wrong = $1 != $5 || NF != 8
          for (k = 1; k < 3; k++) { d = $(2 + k) / $2 - $(6 + k) / $6; if (d * d > 4e-6) wrong = 1 } }
        END { exit wrong }'
}
formats=$(sed -n '/model_by_assimp\[\] = {/,/};/{s/^[^{]*{//;s/NULL//;s/[^a-z0-9]/ /g;p;}' examples/kit/read/read.h)
check "formats of assimp" test $(echo $formats | wc -w) -gt 15
for k in $formats; do check "$k is compared" grep -qi "^[^# ]*\.$k " examples/programs/thumbnail/test/compared.txt; done
for k in $("$THUMBNAIL" --help | sed -n 's/^formats: .* by assimp \(.*\) and more$/\1/p' | tr -d , | tr A-Z a-z); do
    check "$k, which --help names" among "$k" "$(echo $formats)"
done
for k in blend ifc bvh xyz; do
    printf 'BLENDER-v276' >"$T/other.$k"
    bad_model ".$k is not asked for" other.$k "other.$k: \.$k files are not read"
done
if [ -d "$CORPUS" ]; then
    while read -r file other; do
        case $file in "#"*) continue ;; esac
        case $other in *.*/* | */*.*) other=$(shape "$CORPUS/$other") ;; esac
        check "$file as another reader has it" alike "$(shape "$CORPUS/$file")" "$other"
    done <examples/programs/thumbnail/test/compared.txt
    cp "$CORPUS/BLEND/BlenderDefault_276.blend" "$T/nameless"
    bad_model "nor without a name" nameless "nameless:"
    cp "$CORPUS/AC/Wuson.ac" "$T/nameless"
    check "what is compared is read without a name" draw nameless a.ppm
else echo "no assimp-testmodels: formats beside another reader are left out"
fi

if [ "$STB" ]; then
    check "a picture to embed" draw matte.obj embed.png --size 24x24 --samples 1
    check "embedded" "$T/models" "$T" "$T/embed.png"
    check "glTF with a picture inside" draw embedded.gltf a.png --model emissive --rotate 0
    check "no warning" test ! -s "$T/err"
    sed 's/"baseColorTexture":{"index":0},//' "$T/embedded.gltf" >"$T/plain.gltf"
    same "emissiveFactor is all of the emission" embedded.gltf plain.gltf 0 "--model emissive"
    sed 's/"emissiveFactor"/"emissiveTexture":{"index":0},&/' "$T/plain.gltf" >"$T/glow.gltf"
    sed 's/"TEXCOORD_0":2/"TEXCOORD_0":3,"TEXCOORD_1":2/; s/"type":"VEC2"}\]/"type":"VEC2"},{"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"}]/
        s/"emissiveTexture":{"index":0}/"emissiveTexture":{"index":0,"texCoord":1}/' \
        "$T/glow.gltf" >"$T/second.gltf"
    same "the second of two sets of coordinates" glow.gltf second.gltf 0 "--model emissive"
    check "a map of emission" draw glow.gltf a.png --model emissive --rotate 0
    cp "$T/embed.png" "$T/the map.png"
    sed 's/the map.tga/the map.png/; s/Ke .*/Ke 0.7 0.7 0.7/' "$T/map.mtl" >"$T/embedded.mtl"
    sed 's/map.mtl/embedded.mtl/' "$T/map.obj" >"$T/embedded.obj"
    check "the same beside an OBJ" draw embedded.obj b.png --model emissive --rotate 0
    check "one picture" "$T/look" near "$T/a.png" "$T/b.png" 1
fi

# ---- real files of two packages, their pictures beside goldens of 64 x 64 pixels in
# real/, and a memory bomb.  Versions of assimp read some files differently: of 4096
# pixels 3 % may differ by more than 24 of 255.  A package that is not there is named and left out.
# REAL_GOLDENS=write draws the goldens anew.
[ "$STB" ] || return 0
MODELS=/usr/share/assimp/models PROFILES=build/node_modules/@webxr-input-profiles/assets/dist/profiles

real() {                        # name, model
    golden=examples/programs/thumbnail/test/real/$1.png
    check "$1 drawn" "$THUMBNAIL" "$2" "$T/$1.png" --size 64x64 --samples 4 --quiet
    [ "$REAL_GOLDENS" != write ] || cp "$T/$1.png" "$golden"
    check "$1 as it was" "$T/compare" --limit 24 --count 3% "$golden" "$T/$1.png"
}
real_file() {                   # the name of a golden by the name of a file
    name=${1%.*}
    echo "$name" | tr /A-Z -a-z
}

compile -DSHADE__IMPLEMENTED $STB examples/programs/compare/compare.c build/shade.o -lm -o "$T/compare"
if [ -d "$MODELS" ]; then
    for k in OBJ/spider.obj Collada/duck.dae FBX/huesitos.fbx MD2/sydney.md2 MS3D/jeep1.ms3d \
        PLY/Wuson.ply STL/Spider_binary.stl 3DS/fels.3ds AC/Wuson.ac FBX/phong_cube.fbx \
        STL/Wuson.stl glTF2/ClearCoat-glTF/ClearCoatTest.gltf; do
        real "$(real_file $k)" "$MODELS/$k"
    done
    check "goldens differ from one another" no "$T/compare" --limit 24 --count 3% \
        examples/programs/thumbnail/test/real/obj-spider.png examples/programs/thumbnail/test/real/stl-spider_binary.png
else echo "no assimp-testmodels: twelve real files are left out"
fi
if [ -d "$PROFILES" ]; then
    for k in oculus-touch/left.glb valve-index/left.glb htc-vive/none.glb; do
        real "$(real_file $k)" "$PROFILES/$k"
    done
else echo "no @webxr-input-profiles/assets (npm): three controllers are left out"
fi

# memory: 520 kB that unpack to gigabytes, and the same file with fewer vertices
if there python3; then
    check "a small bomb" python3 examples/programs/thumbnail/test/bomb.py "$T/small.3mf" 10000
    check "is a triangle" draw small.3mf a.ppm $flat --max-memory 512
    check "a large bomb" python3 examples/programs/thumbnail/test/bomb.py "$T/large.3mf" 8000000
    check "is refused" refused "large.3mf: out of memory; see --max-memory" "$THUMBNAIL" "$T/large.3mf" "$T/none.ppm" --max-memory 512
else echo "no python3: a memory bomb is left out"
fi
