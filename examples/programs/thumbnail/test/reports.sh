# reports.sh - files as other programs write them, each beside a plain OBJ of the same picture: a
# wedge of four triangles.  Read by thumbnail.sh.

wedge="v 0 0 0\nv 2 0 0\nv 0 1.5 0\nv 0 0 1\n"
faces="f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
mark='\357\273\277'
ply_head="ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z
element face 4\nproperty list uchar int vertex_indices\nend_header\n"
ply_faces="3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
facet() { printf 'facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n' "$@"; }
facets() {
    facet "0 0 0" "0 1.5 0" "2 0 0"; facet "0 0 0" "2 0 0" "0 0 1"
    facet "2 0 0" "0 1.5 0" "0 0 1"; facet "0 0 0" "0 0 1" "0 1.5 0"
}
# A file says one thing, and no more; said: that this is left out.
told() { [ "$(wc -l <"$T/err")" -eq 1 ] && grep -e "$1\$" "$T/err"; }
said() { told "$1 (left out)"; }

reports() {
    printf "$wedge$faces" >"$T/wedge.obj"
    printf "v 1e6 -1e9 3\n${wedge}f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n" >"$T/spare.obj"
    same "a vertex that no face has, first and far away" wedge.obj spare.obj 0 "--up y"
    printf "$ply_head${wedge}-7e5 2e8 nan\n$ply_faces" | sed 's/^v //' >"$T/spare.ply"
    same "in PLY, and it is no number" wedge.obj spare.ply 0 "--up y"
    check "which is no fault" test ! -s "$T/err"
    check "its drawing" "$THUMBNAIL" "$T/spare.obj" "$T/a.ppm" --views front --size 200x150
    mkdir -p "$T/without" && cp "$T/wedge.obj" "$T/without/spare.obj"
    check "the drawing without it" "$THUMBNAIL" "$T/without/spare.obj" "$T/b.ppm" --views front \
        --size 200x150
    check "one drawing" "$T/look" same "$T/a.ppm" "$T/b.ppm" 0

    printf "${wedge}v 9e4 0 0\nv 9e4 0 0\nv 9e4 0 0\n${faces}f 5 6 7\nf 5 5 5\nf 7 7 1\n" >"$T/spare.obj"
    same "faces with two corners at one place, far away" wedge.obj spare.obj 0 "--up y"
    { echo solid a; facets; facet "9e4 9 9" "9e4 9 9" "9e4 9 9"; echo endsolid; } >"$T/spare.stl"
    same "in STL" wedge.obj spare.stl 0 "--up y"

    printf "$mark$wedge$faces" >"$T/mark.obj"
    same "a byte order mark" wedge.obj mark.obj 0 "--up y"
    printf "$mark$wedge${faces}v 9 9 9\n" >"$T/mark.obj"
    same "which hides no vertex" wedge.obj mark.obj 0 "--up y"
    printf "newmtl r\nKd 1 0 0\n" >"$T/red.mtl"
    printf "${mark}newmtl r\nKd 1 0 0\n" >"$T/markred.mtl"
    printf "mtllib red.mtl\nusemtl r\n$wedge$faces" >"$T/red.obj"
    printf "${mark}mtllib markred.mtl\nusemtl r\n$wedge$faces" >"$T/markred.obj"
    same "nor a library, nor its first material" red.obj markred.obj 0 "--up y"
    { printf "$mark"; printf "$ply_head${wedge}0 0 0\n$ply_faces" | sed 's/^v //'; } >"$T/mark.ply"
    same "in text PLY" wedge.obj mark.ply 0 "--up y"
    { printf "${mark}solid a\n"; facets; echo endsolid; } >"$T/mark.stl"
    same "in text STL" wedge.obj mark.stl 0 "--up y"

    printf "v nan nan nan\nv -inf 0 1\n${wedge}f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2
f 1 3 4\nf 2 3 4\n" >"$T/hole.obj"
    same "faces with a corner that is nan or inf" wedge.obj hole.obj 0 "--up y"
    check "are counted" said "hole.obj: 2 faces have corners that are no finite numbers"
    { echo solid a; facets; facet "nan 0 0" "1 0 0" "0 1 0"; echo endsolid; } >"$T/hole.stl"
    same "in STL" wedge.obj hole.stl 0 "--up y"
    check "are counted" said "hole.stl: 1 triangles have corners that are no finite numbers"
    printf "$ply_head${wedge}inf 0 0\n${ply_faces}3 0 1 4\n" |
        sed 's/^v //; s/face 4/face 5/' >"$T/hole.ply"
    same "in PLY" wedge.obj hole.ply 0 "--up y"
    check "are counted" said "hole.ply: 1 faces have corners that are no finite numbers"
    printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >"$T/none.obj"
    bad_model "nothing else" none.obj "none.obj: no face of it has corners that are all finite"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' >"$T/points.obj"
    printf 'v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\n' >"$T/points2.obj"
    same "a point" points.obj points2.obj 0 "--up y"

    sed 's/^f \([0-9]\) \([0-9]\) \([0-9]\)/f \1\/1 \2\/2 \3\/3/' "$T/wedge.obj" >"$T/bare.obj"
    same "faces that name a vt where there is none" wedge.obj bare.obj 0 "--up y"
    check "which is told" told "bare.obj: faces name a vt, and the file has none: they do without"
}

# glTF as text; the fourth corner is moved by what a file adds
gltf_head='{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}]'
gltf_reports() {
    for k in KHR_draco_mesh_compression KHR_texture_basisu EXT_texture_webp EXT_made_up; do
        printf '%s,"extensionsRequired":["%s"]}' "$gltf_head" $k >"$T/needs.gltf"
        bad_model "$k is needed" needs.gltf "needs.gltf: it needs $k, which is not read"
    done
    # wedge.obj as gltfpack would pack it
    for k in EXT KHR; do
        printf '%s,"extensionsRequired":["%s_meshopt_compression"],"meshes":[{"primitives":[{
            "attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"count":4,"type":"VEC3",
            "componentType":5126,"bufferView":0},{"count":12,"type":"SCALAR","componentType":5123,
            "bufferView":1}],"bufferViews":[{"buffer":1,"byteLength":48,"byteStride":12,"extensions":{
            "%s_meshopt_compression":{"buffer":0,"byteLength":73,"byteStride":12,"count":4,
            "mode":"ATTRIBUTES"}}},{"buffer":1,"byteOffset":48,"byteLength":24,"extensions":{
            "%s_meshopt_compression":{"buffer":0,"byteOffset":73,"byteLength":23,"byteStride":2,
            "count":12,"mode":"TRIANGLES"}}}],"buffers":[{"byteLength":96,"uri":"data:;base64,oAAAAAE8AA
AAgH8AAAEPAAAAf4ABDwAAAH59AAABAwAAAP8BAwAAAH4AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAOH+DhID8AQAdod
WZ3iphmWJaJgBaQAA"},{"byteLength":72}]}' "$gltf_head" $k $k $k | tr -d '\n' | sed 's/  *//g' >"$T/packed.gltf"
        same "views packed by ${k}_meshopt_compression" wedge.obj packed.gltf 0 "--up y"
        check "without a word" test ! -s "$T/err"
    done
    sed 's/oAAAAAE8/pAAAAAE8/' "$T/packed.gltf" >"$T/wrong.gltf"
    bad_model "a packed view that is damaged" wrong.gltf "wrong.gltf: a packed view is damaged"
    sed 's/"count":4,"mode"/"count":400000,"mode"/' "$T/packed.gltf" >"$T/wrong.gltf"
    bad_model "one of more than it has bytes for" wrong.gltf "wrong.gltf: a packed view is cut off"
    sed 's/"mode":"TRIANGLES"/"mode":"STRIPS"/' "$T/packed.gltf" >"$T/wrong.gltf"
    bad_model "another kind of packing" wrong.gltf "packed in a way that is not read"
    cp "$T/needs.gltf" "$T/needs"
    bad_model "nor is it drawn under another name" needs "it needs EXT_made_up, which is not read"
    sed "1s/^/$(printf "$mark")/; s/{/ {\n/" "$T/torus.gltf" >"$T/mark.gltf"
    same "a byte order mark and line ends" torus.obj mark.gltf 0 "--up y"
    cp "$T/mark.gltf" "$T/mark"
    same "no name" torus.obj mark 0 "--up y"
    sed 's/"asset"/"extensionsUsed":["EXT_made_up"],&/' "$T/torus.gltf" >"$T/used.gltf"
    same "an extension that is used" torus.obj used.gltf 0 "--up y"
    check "and not read is told" told "used.gltf: it has EXT_made_up, which is not read"
    for k in '{' '{"asset":{"version":"2.0"},}' '{"asset":{"version":"2.0"}} 1' "{'asset':1}" \
        '{"asset":{"version":02}}' '{"asset":"\x"}' '{"asset":nul}'; do
        printf '%s' "$k" >"$T/wrong.gltf"
        bad_model "$k" wrong.gltf "wrong.gltf:1: its JSON is wrong: expected"
    done
    for k in "solid a" "<html>" "  version https://git-lfs" ""; do
        printf '%s\n' "$k" >"$T/wrong.glb"
        bad_model "$k" wrong.glb "wrong.glb:[12]: expected glTF or its JSON, found "
    done
    cp "$T/torus.gltf" "$T/text.glb"
    same "text named as GLB" torus.gltf text.glb 0
    sed 's/"mesh":0/&,"scale":[1,null,1]/' "$T/torus.gltf" >"$T/scale.gltf"
    bad_model "a scale that is no number" scale.gltf "scale must be 3 numbers"
    awk 'BEGIN { for (i = 0; i < 200; i++) printf "["; for (i = 0; i < 200; i++) printf "]" }' \
        >"$T/deep.gltf"
    bad_model "200 deep" deep.gltf "its JSON is more than 100 deep"
    printf '{"asset":{"version":"1.0"}}' >"$T/one.gltf"
    bad_model "glTF 1" one.gltf "glTF 1.0 is not read, 2 is"
    printf '{"asset":{"version":"2.1","minVersion":"2.1"}}' >"$T/one.gltf"
    bad_model "glTF that needs a later reader" one.gltf "it needs glTF 2.1; 2.0 is read"
    sed 's/POSITION/\\u0050OSITION/; s/"VEC3"/"VEC\\u0033"/; s/"mesh"/"m\\u0065sh"/' "$T/torus.gltf" >"$T/names.gltf"
    same "names with escapes" torus.obj names.gltf 0 "--up y"
    printf '%s,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"count":3,
        "type":"VEC3","componentType":5126,"bufferView":0}],"bufferViews":[{"buffer":0,
        "byteLength":36}],"buffers":[{"uri":"../torus.gltf"}]}' "$gltf_head" >"$T/out.gltf"
    bad_model "a buffer outside of its folder" out.gltf "torus.gltf does not lie beside the model"
    printf '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[' >"$T/bomb.gltf"
    for k in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30; do
        printf '{"children":[%d,%d]},' $k $k >>"$T/bomb.gltf"
    done
    printf '{"mesh":0}],"meshes":[{"primitives":[]}]}' >>"$T/bomb.gltf"
    bad_model "nodes that double 30 times" bomb.gltf "more than 100000 nodes"
}

# What a model of four triangles shows by other formats: its colours, in an OBJ with four materials
painted() {                     # name, four colours of MTL
    printf 'newmtl a\nKd %s\nnewmtl b\nKd %s\nnewmtl c\nKd %s\nnewmtl d\nKd %s\n' "$2" "$3" "$4" \
        "$5" >"$T/$1.mtl"
    { printf "mtllib $1.mtl\n$wedge"
        printf 'usemtl a\nf 1 3 2\nusemtl b\nf 1 2 4\nusemtl c\nf 2 3 4\nusemtl d\nf 1 4 3\n'; } \
        >"$T/$1.obj"
}
# file, header, and for each triangle its last two bytes: the wedge as binary STL
stl_colors() {
    zero='\000\000\000\000' two='\000\000\000\100' half='\000\000\300\077' one='\000\000\200\077'
    a=$zero$zero$zero b=$two$zero$zero c=$zero$half$zero d=$zero$zero$one none=$zero$zero$zero
    printf "%-80.80s" "$2" >"$T/$1"
    printf "\004\000\000\000$none$a$c$b$3$none$a$b$d$4$none$b$c$d$5$none$a$d$c$6" >>"$T/$1"
}
color_reports() {
    plain="--up y --model lambert --no-shadow"
    painted four "1 0 0" "0 1 0" "0 0 1" "1 1 0"
    stl_colors magics.stl "COLOR=@@@@" '\037\000' '\340\003' '\000\174' '\377\003'
    same "colours of Magics" four.obj magics.stl 2 "$plain"
    stl_colors viscam.stl "made by hand" '\000\374' '\340\203' '\037\200' '\340\377'
    same "of VisCAM" four.obj viscam.stl 2 "$plain"
    stl_colors junk.stl "made by hand" '\000\000' '\022\000' '\377\177' '\000\000'
    same "words that are no colours" wedge.obj junk.stl 0 "$plain"
    painted late "0.5225 0.5225 0.5225" "0 1 0" "0 0 1" "1 1 0"
    stl_colors late.stl "made by hand" '\000\000' '\340\203' '\037\200' '\340\377'
    same "colours behind a triangle without" late.obj late.stl 2 "$plain"
    stl_colors bare.stl "COLOR=@@@@" '\000\000' '\000\000' '\000\000' '\000\000'
    same "and no words" wedge.obj bare.stl 0 "$plain"

    printf "v 0 0 0 1 0 0\nv 2 0 0 0 1 0\nv 0 1.5 0 0 0 1\nv 0 0 1 1 1 1\n$faces" >"$T/tint.obj"
    ply_colored() {             # file, names of three properties, the greatest value
        { printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n'
            printf 'property float z\n'; printf 'property float %s\n' $2
            printf 'element face 4\nproperty list uchar int vertex_indices\nend_header\n'
            printf '0 0 0 %s 0 0\n2 0 0 0 %s 0\n0 1.5 0 0 0 %s\n0 0 1 %s %s %s\n' $3 $3 $3 $3 $3 $3
            printf "$ply_faces"; } >"$T/$1"
    }
    ply_colored rgb.ply "r g b" 1
    same "colours r g b" tint.obj rgb.ply 0 "$plain"
    ply_colored bytes.ply "red green blue" 255
    same "floats to 255" tint.obj bytes.ply 0 "$plain"
    ply_colored diffuse.ply "diffuse_red diffuse_green diffuse_blue" 1
    same "diffuse_red" tint.obj diffuse.ply 0 "$plain"
    faces_colored() {           # file, type, the greatest value, what else vertices have, and its value
        { printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n'
            printf 'property float z\n%belement face 4\nproperty %s red\n' "$4" $2
            printf 'property list uchar int vertex_indices\nproperty %s green\n' $2
            printf 'property %s blue\nend_header\n' $2
            printf '0 0 0%s\n2 0 0%s\n0 1.5 0%s\n0 0 1%s\n' "$5" "$5" "$5" "$5"
            printf '%s 3 0 2 1 0 0\n0 3 0 1 3 %s 0\n0 3 1 2 3 0 %s\n%s 3 0 3 2 %s 0\n' $3 $3 $3 $3 $3; } >"$T/$1"
    }
    { for k in "1 0 0" "0 1 0" "0 0 1" "1 1 0"; do
        printf "$wedge" | sed "s/$/ $k/"
    done; printf 'f 1 3 2\nf 5 6 8\nf 10 11 12\nf 13 16 15\n'; } >"$T/sides.obj"
    for k in "uchar 255" "float 1" "float 255" "ushort 65535"; do
        faces_colored sides.ply $k "" ""
        same "colours of PLY's faces, $k" sides.obj sides.ply 0 "$plain"
        check "without a word" test ! -s "$T/err"
    done
    faces_colored sides.ply uchar 255 "property uchar red\nproperty uchar green\nproperty uchar blue\n" " 255 0 0"
    { printf "$wedge" | sed "s/$/ 1 0 0/"; printf "$faces"; } >"$T/sides.obj"
    same "those of vertices count before them" sides.obj sides.ply 0 "$plain"
    check "which is told" told "sides.ply: it has red, green, blue, which are not read"

    printf "COFF\n4 4 0\n0 0 0 255 0 0 1\n2 0 0 0 255 0 1\n0 1.5 0 0 0 255 1\n0 0 1 255 255 255 1
$ply_faces" >"$T/tint.off"
    same "COFF" tint.obj tint.off 0 "$plain"
    printf "# wedge\nOFF 4 4 6\n\n$wedge$ply_faces" | sed 's/^v //' >"$T/wedge.off"
    same "OFF" wedge.obj wedge.off 0 "$plain"

    cp "$T/red.mtl" "$T/one.mtl"
    printf 'newmtl g\nKd 0 1 0\n' >"$T/two.mtl"
    printf "mtllib one.mtl two.mtl\nusemtl r\n${wedge}f 1 3 2\nf 1 2 4\nusemtl g\nf 2 3 4\nf 1 4 3\n" \
        >"$T/names.obj"
    painted half "1 0 0" "1 0 0" "0 1 0" "0 1 0"
    same "two names in mtllib" half.obj names.obj 0 "$plain"
    check "which is no fault" test ! -s "$T/err"
    sed 's/red.mtl/"red.mtl"/' "$T/red.obj" >"$T/quoted.obj"
    same "a name in quotes" red.obj quoted.obj 0 "$plain"
    check "which is no fault" test ! -s "$T/err"
}
# a picture of four colours: red, green; blue, yellow
map_reports() {
    printf 'P6\n2 2\n255\n\377\000\000\000\377\000\000\000\377\377\377\000' >"$T/quarters.ppm"
    mkdir -p "$T/inside"
    printf 'newmtl q\nmap_Kd ../quarters.ppm\n' >"$T/inside/out.mtl"
    printf "mtllib out.mtl\n${wedge}vt .75 .75\nusemtl q\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\n" \
        >"$T/inside/out.obj"
    printf 'newmtl q\nKd 1 1 1\n' >"$T/inside/bare.mtl"
    sed 's/out.mtl/bare.mtl/' "$T/inside/out.obj" >"$T/inside/bare.obj"
    same "a picture outside of the folder is not read" inside/bare.obj inside/out.obj 0 "--up y"
    check "but told" said "quarters.ppm: it lies outside of the model's folder; --outside reads it"
    check "asked for, it is" draw inside/out.obj a.ppm --up y --outside
    check "without a word" test ! -s "$T/err"
    check "and shows" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 20
    printf 'newmtl q\nmap_Kd -s 1 1 1 -o .5 0 0 quarters.ppm\n' >"$T/moved.mtl"
    printf 'newmtl q\nmap_Kd quarters.ppm\n' >"$T/still.mtl"
    printf "mtllib moved.mtl\n${wedge}vt .25 .25\nusemtl q\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1
f 1/1 4/1 3/1\n" >"$T/moved.obj"
    sed 's/moved.mtl/still.mtl/; s/vt .25/vt .75/' "$T/moved.obj" >"$T/still.obj"
    same "-o moves the picture" still.obj moved.obj 0 "--up y"
    check "without a word" test ! -s "$T/err"
    for k in 'quarters.ppm -s 1 1 1 -o .5 0 0' '-s 1 1 "quarters.ppm"  -o .5 0'; do
        printf 'newmtl q\nmap_Kd %s\n' "$k" >"$T/moved.mtl"
        same "$k" still.obj moved.obj 0 "--up y"
        check "without a word" test ! -s "$T/err"
    done
    sed 's/still.mtl/none.mtl/; s/usemtl q//' "$T/still.obj" >"$T/plain.obj"
    check "plain" draw plain.obj b.ppm --up y
    check "which shows" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 20
    printf 'newmtl q\nmap_Kd -s 3 1 -o 0 .5 quarters.ppm\n' >"$T/moved.mtl"
    sed -i 's/vt .75 .25/vt .75 .75/' "$T/still.obj"
    same "-s stretches it" still.obj moved.obj 0 "--up y"
    printf 'ply\nformat ascii 1.0\ncomment TextureFile quarters.ppm\nelement vertex 4
property float x\nproperty float y\nproperty float z\nelement face 4
property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header
0 0 0\n2 0 0\n0 1.5 0\n0 0 1\n' >"$T/corner.ply"
    for k in "3 0 2 1" "3 0 1 3" "3 1 2 3" "3 0 3 2"; do
        printf '%s 6 .75 .75 .75 .75 .75 .75\n' "$k" >>"$T/corner.ply"
    done
    printf 'newmtl q\nKd 1 1 1\nmap_Kd quarters.ppm\n' >"$T/still.mtl"
    same "PLY with texture coordinates by corner" still.obj corner.ply 0 "--up y"
    printf 'newmtl q\nKd 0 0 0\nmap_Kd quarters.ppm\n' >"$T/moved.mtl"
    sed 's/still.mtl/moved.mtl/' "$T/still.obj" >"$T/moved.obj"
    same "a picture beside black is seen" still.obj moved.obj 0 "--up y"
    sed -i '/^Kd/d' "$T/moved.mtl"
    same "and beside no colour" still.obj moved.obj 0 "--up y"
    polished() {                # file, what the material says: a triangle
        printf '%s,"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
            "materials":[{"name":"m","doubleSided":true,"pbrMetallicRoughness":{
            "baseColorFactor":[0.6,0.3,0.2,1],%s}}],"textures":[{"source":0}],"images":[{"uri":
            "data:image/x-portable-pixmap;base64,UDYKMSAxCjI1NQoAgAA="}],"accessors":[{"count":3,
            "type":"VEC3","componentType":5126,"bufferView":0},{"count":3,"type":"VEC2",
            "componentType":5126,"bufferView":1}],"bufferViews":[{"buffer":0,"byteLength":36},
            {"buffer":0,"byteOffset":36,"byteLength":24}],"buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAA
AAAAAAAAAAAAAAAIA/AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]}' "$gltf_head" "$2" |
            tr -d '\n' | sed 's/  *//g' >"$T/$1"
    }
    polished plain.gltf '"metallicFactor":0,"roughnessFactor":0.4015686'
    polished rough.gltf '"roughnessFactor":0.8,"metallicRoughnessTexture":{"index":0}'
    same "a picture of metal and roughness" plain.gltf rough.gltf 0 "--up y"
    check "without a word" test ! -s "$T/err"
    polished metal.gltf '"roughnessFactor":0.4015686'
    check "metal" draw metal.gltf b.ppm --up y
    check "which shows" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 5
    sed 's/"doubleSided"/"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_unlit":{}},&/' "$T/plain.gltf" \
        >"$T/unlit.gltf"
    for k in "--up y" --quick "--shading vertex" "--model lambert"; do
        check "unlit, $k" draw unlit.gltf a.ppm $k
        check "is the base colour" pixel 0.45 0.55 0.6 0.3 0.2
    done
    squared() {                 # file, the bytes of a PPM, its sampler
        bytes=$(printf "P6\n$2" | base64 | tr -d '\n')
        sed "s|UDYKMSAxCjI1NQoAgAA=|$bytes|; s|\"textures\":\[{|&\"sampler\":0,|
            s|,\"images\"|,\"samplers\":[{$3}]&|" "$T/map.gltf" >"$T/$1"
    }
    polished map.gltf '"metallicFactor":0,"baseColorTexture":{"index":0}'
    sed -i 's/A\{32\}"}\]}$/AAAAAAAAAAAAAIA\/AAAAAAAAAAAAAIA\/"}]}/' "$T/map.gltf"
    two='\377\000\000\000\377\000' four='\377\000\000\377\000\000\000\377\000\000\377\000'
    near='"magFilter":9728,"minFilter":9728' linear='"magFilter":9729'
    squared two.gltf "2 1\n255\n$two" $near
    squared four.gltf "4 1\n255\n$four" $near
    same "texels as squares" two.gltf four.gltf 0 "--up y --view right"
    squared two.gltf "2 1\n255\n$two" $linear
    check "without that" draw two.gltf b.ppm --up y --view right
    check "they run into each other" no "$T/look" same "$T/a.ppm" "$T/b.ppm" 20
    sed 's|UDYKMSAxCjI1NQoAgAA=|AAAA|' "$T/map.gltf" >"$T/broken.gltf"
    check "a picture that is none" draw broken.gltf a.ppm
    check "is told by its number" said "images\[0\]: no picture that stb_image reads"
    polished cut.gltf '"metallicFactor":0'
    sed -i 's/"doubleSided":true,/&"alphaMode":"MASK",/; s/0.2,1\]/0.2,0.3]/' "$T/cut.gltf"
    bad_model "less alpha than is cut away" cut.gltf "cut.gltf: nothing of it can be seen: its alpha is below"
    sed 's/\("primitives":\[\)\([^]]*\)/\1\2,{"attributes":{"POSITION":0}}/' "$T/cut.gltf" >"$T/half.gltf"
    check "of some faces" draw half.gltf a.ppm --up y --view right
    check "is told" said "half.gltf: faces whose alpha is below their alphaCutoff"
    sed 's/,{"attributes":{"POSITION":0}}//; s/{"attributes[^}]*},"material":0}/{"attributes":{"POSITION":0}}/' \
        "$T/half.gltf" >"$T/one.gltf"
    same "and the others are drawn" one.gltf half.gltf 0 "--up y --view right"
    printf 'v -3e38 0 0\nv 3e38 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/needle.obj"
    check "a needle" draw needle.obj a.ppm --no-shadow
    check "that nobody sees is told" grep "needle.obj: nothing of it can be seen" "$T/err"
    sed 's/,"TEXCOORD_0":1//' "$T/map.gltf" >"$T/bare.gltf"
    check "a picture without texture coordinates" draw bare.gltf a.ppm
    check "is told" said "bare.gltf: a picture has no texture coordinates"
    printf "mtllib still.mtl\nusemtl q\n$wedge$faces" >"$T/bare.obj"
    check "in OBJ" draw bare.obj a.ppm
    check "is told as well" said "bare.obj: a picture has no texture coordinates"
    # a chart of metal and roughness
    chart=
    for k in 0,0 0,0.25 0,0.5 0,0.75 0,1 1,0 1,0.25 1,0.5 1,0.75 1,1; do
        factors="\"baseColorFactor\":[0.8,0.4,0.2,1],\"metallicFactor\":${k%,*},\"roughnessFactor\":${k#*,}"
        sed 's/"indices":1/&,"material":0/
            s/,"bufferViews"/,"materials":[{"pbrMetallicRoughness":{'"$factors"'}}]&/' \
            "$T/torus.gltf" >"$T/chart.gltf"
        check "metal and roughness $k" draw chart.gltf "chart$k.ppm"
        for other in $chart; do
            check "$k is not $other" no "$T/look" same "$T/chart$k.ppm" "$T/chart$other.ppm" 8
        done
        chart="$chart $k"
    done
}

# What a writer of one of these files means, in a file without its habits
habit_reports() {
    printf "${wedge}v -1.#IND00 1.#QNAN0 1.#INF00\nv -nan(ind) 0 0\n${faces}f 1 2 5\nf 1 2 6\n" \
        >"$T/windows.obj"
    same "numbers that are none, as Windows prints them" wedge.obj windows.obj 0 "--up y"
    check "are counted" said "windows.obj: 2 faces have corners that are no finite numbers"
    printf "${wedge}vn -1.#IND00 -1.#IND00 -1.#IND00\n$faces" |
        sed 's/^f 1 3 2/f 1\/\/1 3 2/' >"$T/windows.obj"
    same "normals too" wedge.obj windows.obj 0 "--up y"
    check "without a word" test ! -s "$T/err"
    { echo solid; facets | sed 's/normal 0 0 0/normal -1.#IND 1.#INF 0/'
        facet "1.#QNAN 0 0" "1 0 0" "0 1 0"; } >"$T/windows.stl"
    same "in STL" wedge.obj windows.stl 0 "--up y"
    check "are counted" said "windows.stl: 1 triangles have corners that are no finite numbers"

    sed 's/"scene":0,"scenes":\[{"nodes":\[0\]}\],//' "$T/nodes.gltf" >"$T/bare.gltf"
    same "glTF without scenes has its roots where they stand" nodes.gltf bare.gltf 0 "--up y"
    check "without scenes indeed" no grep '"scene' "$T/bare.gltf"
    sed 's/"primitives":\[/&{"attributes":{"NORMAL":0}},/' "$T/torus.gltf" >"$T/bare.gltf"
    same "a primitive without positions is nothing" torus.gltf bare.gltf 0 "--up y"
    sed 's/"indices":1/&,"extensions":{"KHR_draco_mesh_compression":{}}/' "$T/torus.gltf" \
        >"$T/both.gltf"
    same "Draco beside the same without it" torus.gltf both.gltf 0 "--up y"
    sed 's/;base64,/,/' "$T/torus.gltf" >"$T/plain.gltf"
    bad_model "a data URI of other text" plain.gltf "a data URI is no base64"
    for k in "" ',"normalized":true'; do
        printf '%s,"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],
            "materials":[{"alphaMode":"BLEND"}],"accessors":[{"count":3,"type":"VEC3",
            "componentType":5126,"bufferView":0},{"count":3,"type":"VEC4","componentType":5121,
            "bufferView":1%s}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":1,
            "byteLength":12}],"buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAA
AAgD8AAAAA"},{"uri":"data:;base64,/4AAgP+AAID/gACA"}]}' "$gltf_head" "$k" | tr -d '\n' \
            >"$T/bytes$k.gltf"
    done
    same "colours of bytes, which are fractions" 'bytes,"normalized":true.gltf' bytes.gltf 0
    check "whose alpha is told" told "the alpha of its COLOR_0 does not count"
    printf '\377\376v\000 \0001\000' >"$T/wide.obj"
    bad_model "UTF-16" wide.obj "wide.obj:1: its text is UTF-16, which is not read"
    printf 'OFF\n4 4\n6\n0\n0 0 2\n0 0 0\n1.5 0 0\n0 1\n3 0 1 2\n3 0 1 3\n' >"$T/flows.off"
    bad_model "vertices that end within lines" flows.off "flows.off:5: a vertex ends in the middle"
    library() {                 # the name of a library, statements of a material that is red at last
        printf "newmtl r\n$2\nKd 1 0 0\n" >"$T/library.mtl"
        printf 'mtllib %s\nusemtl r\n'"$wedge$faces" "$1" >"$T/library.obj"
    }
    for k in 'C:\work\library.mtl' /home/nobody/library.mtl; do
        library "$k" ""
        same "a library in a folder of another machine" red.obj library.obj 0 "--up y"
        check "without a word" test ! -s "$T/err"
    done
    for k in "Ks spectral a.rfl" "Ks xyz 1 1 1" "Ns nan" "Ke 0,5 0,5 0,5"; do
        library library.mtl "$k"
        same "$k costs no other statement" red.obj library.obj 0 "--up y"
        check "and is told" said "library.mtl:2: expected a number, found .*"
    done
    library library.mtl "Kd 1 0 0\nnewmtl r\nKd 0 1 0\nd 0.5\nnewmtl s"
    same "of two materials of one name the first counts" red.obj library.obj 0 "--up y"
    sed -i 's/usemtl r/usemtl R/' "$T/library.obj"
    check "a material that is in no library" draw library.obj a.ppm
    check "is told" told "no library has its material R"
    printf "mtllib\nusemtl r\n$wedge$faces" >"$T/alone.obj"
    same "materials without a library" wedge.obj alone.obj 0 "--up y"
    check "are told" told "alone.obj: it names materials, and no library of them"
    for k in "-clamp on" "-mm 0.2 0.5"; do
        library library.mtl "map_Bump $k none.png"
        check "$k is drawn without" draw library.obj a.ppm
        check "and told" grep -e "it has ${k%% 0*}, which is not read" "$T/err"
    done
    library library.mtl "map_Kd a.png\nmap_Bump -s 2 2 b.png"
    check "pictures that differ in their places" draw library.obj a.ppm
    check "are told" grep "a.png: the -o and -s of the other pictures are not its own, and do not count" "$T/err"
    plain="--up y --model lambert --no-shadow"
    rows() { printf "$wedge" | sed "s/^v //; s/\$/ $1/"; }
    faces_of() { printf "$ply_faces" | sed "s/\$/ $1/"; }
    { rows "1 0 0" | sed 's/^/v /'; printf "$faces"; } >"$T/four.obj"
    { printf "COFF\n4 4\n"; rows "1 0 0 1"; faces_of; } >"$T/fraction.off"
    same "fractions without a point" four.obj fraction.off 0 "$plain"
    { printf "NCOFF\n4 4 0\n"; rows "0 0 1 255 0 0 255"; faces_of; } >"$T/both.off"
    same "NCOFF" four.obj both.off 0 "$plain"
    { printf "OFF\n4 4 0\n"; rows; faces_of "1 0 0"; } >"$T/face.off"
    same "faces with such fractions" four.obj face.off 0 "$plain"
    { printf "OFF4\n4\n0\n"; rows | sed 's/ 0 /\n0 # y\n\n/'; faces_of |
        sed 's/ /\n/'; } >"$T/free.off"
    same "counts behind OFF, and lines that end anywhere" wedge.obj free.off 0 "$plain"
    check "without a word" test ! -s "$T/err"
    cp "$T/free.off" "$T/free"
    same "without a name" wedge.obj free 0 "$plain"
    { printf "OFF\n4 4 0\n"; rows "255 0 0"; faces_of; } >"$T/more.off"
    same "colours that the first line denies" wedge.obj more.off 0 "$plain"
    check "are told" said "numbers behind its vertices or faces that are no colours"
    { printf "OFF\n4 4 0\n"; rows; faces_of 7; } >"$T/more.off"
    same "a number in a map of colours" wedge.obj more.off 0 "$plain"
    check "is told" said "numbers behind its vertices or faces that are no colours"
    { cat "$T/wedge.off"; echo 3 0 1 2; } >"$T/more.off"
    same "OFF with more faces than it counts" wedge.obj more.off 0 "$plain"
    check "is told" said "more.off: lines behind the vertices and faces that it counts"
    stl_counts() {              # file, count, triangles behind those of the wedge
        stl_colors $1 "made by hand" '\000\000' '\000\000' '\000\000' '\000\000'
        { head -c 80 "$T/$1"; printf "$2\000\000\000"; tail -c +85 "$T/$1"
            [ $3 -eq 0 ] || head -c $((84 + 50 * $3)) "$T/$1" | tail -c +85; } >"$T/a.stl"
        mv "$T/a.stl" "$T/$1"
    }
    stl_counts more.stl '\004' 2
    same "STL with more triangles than its count" wedge.obj more.stl 0 "--up y"
    check "which is told" said "more.stl: 2 triangles beyond the 4 that it counts"
    stl_colors own.stl "made by hand" '\003\000own' '\000\000' '\001\000.' '\056\000%046d'
    same "STL with bytes of its writer's behind triangles" wedge.obj own.stl 0 "--up y"
    check "without a word" test ! -s "$T/err"
    stl_counts none.stl '\000' 0
    same "a count of 0, from a writer that did not know it yet" wedge.obj none.stl 0 "--up y"
    check "without a word" test ! -s "$T/err"
    stl_counts few.stl '\007' 0
    bad_model "a count of more than there are" few.stl "few.stl: ends after 4 of 7 triangles"
    cp "$T/few.stl" "$T/few" && cp "$T/more.stl" "$T/more"
    bad_model "in a file without a name" few "few: ends after 4 of 7 triangles"
    same "STL without a name, with more triangles than its count" wedge.obj more 0 "--up y"
    { echo "; by hand"; echo solid; facets; } >"$T/note.stl"
    bad_model "a comment in STL" note.stl 'note.stl:1: expected facet, found ";"'

    ply_of() {                  # file, type and greatest value of colours
        { printf "$ply_head" | sed "s/vertex 5/vertex 4/; s/double z/&\nproperty $2 red\\
property $2 green\nproperty $2 blue/"; rows "$3 0 0"; printf "$ply_faces"; } >"$T/$1"
    }
    for k in "ushort 255" "int 255" "ushort 65535" "short 32767" "uint 4294967295"; do
        ply_of wide.ply $k
        same "PLY with colours of $k" four.obj wide.ply 0 "$plain"
        check "without a word" test ! -s "$T/err"
    done
    { cat "$T/wide.ply"; echo 3 0 1 2; } >"$T/more.ply"
    same "PLY with more rows than its header counts" four.obj more.ply 0 "$plain"
    check "which is told" said "more.ply: bytes behind the elements that its header counts"
    sed 's/property list/property float what\n&/; s/^3/0 3/' "$T/more.ply" >"$T/both.ply"
    same "two things that are left out" four.obj both.ply 0 "$plain"
    check "are told both" told "both.ply: bytes behind the .* (left out); it has what, which is not read"
    { printf 'mtllib '; seq -s ' ' 100 400; printf "usemtl r\n$wedge$faces"; } >"$T/many.obj"
    check "more than a line holds" draw many.obj a.ppm
    check "ends by saying so" told "many.obj: 100: .* (left out); 101: .*; and more"
    sed 's/vertex_indices/vertices/' "$T/wide.ply" >"$T/named.ply"
    bad_model "corners by another name" named.ply "no face of it has three corners, but vertices, which is not read"
    sed 's/"materials"/"extensionsUsed":["KHR_materials_transmission"],&/' "$T/bytes.gltf" \
        >"$T/glass.gltf"
    check "a material of glass" draw glass.gltf a.ppm
    check "is told" told "glass.*COLOR_0 does not count; it has KHR_materials_transmission, which is not read"
}

# Numbers of another kind than a reader expects: the picture is that of the plain file.
value_reports() {
    for k in "0 0 0" "nan nan nan" "-nan 0 inf"; do
        { printf "${wedge}vn $k\n"; printf "$faces" | sed 's/ \([0-9]\)/ \1\/\/1/g'; } >"$T/none.obj"
        same "vn $k in OBJ is made anew" wedge.obj none.obj 0 "--up y"
    done
    printf "${wedge}vn 0 0 1\nvn 0 0 0\nf 1//1 3//1 2//1\nf 1//2 2//2 4//2\nf 2//2 3//2 4//2\n" >"$T/one.obj"
    printf "${wedge}vn 0 0 1\nf 1//1 3//1 2//1\nf 1 2 4\nf 2 3 4\n" >"$T/two.obj"
    same "one vn of several" two.obj one.obj 0 "--up y"
    for k in 1 1e30 1e-30; do
        { printf "${wedge}vn $k 0 $k\n"; printf "$faces" | sed 's/ \([0-9]\)/ \1\/\/1/g'; } >"$T/vn$k.obj"
        { printf "$ply_head" | sed 's/vertex 5/vertex 4/; s/.*double z/&\nproperty double nx\
property double ny\nproperty double nz/'; printf "$wedge" | sed "s/^v //; s/\$/ $k 0 $k/"
            printf "$ply_faces"; } >"$T/n$k.ply"
        same "vn as long as $k" vn1.obj vn$k.obj 1 "--up y"
        same "in PLY" vn1.obj n$k.ply 1 "--up y"
    done
    rgb_of() {                  # a number for each vertex of the wedge: v with it, and two others
        i=0; printf "$wedge" | while read -r line; do
            i=$((i + 1)); eval k=\${$i}; echo "$line $k $k 0"
        done; printf "$faces"
    }
    rgb_of 1 0.2 0.4 0 >"$T/parts.obj"
    rgb_of 255 51 102 0 >"$T/bytes.obj"
    same "colours of vertices to 255 in OBJ" parts.obj bytes.obj 0 "$plain"
    check "without a word" test ! -s "$T/err"
    { printf 'v -1 0 0\nv -1 1 0\n'; sed 's/^f \(.\) \(.\) \(.\)/f -4 -3 -2/' "$T/bytes.obj"; } >"$T/some.obj"
    { printf 'v -1 0 0\nv -1 1 0\n'; sed 's/^f \(.\) \(.\) \(.\)/f -4 -3 -2/' "$T/parts.obj"; } >"$T/two.obj"
    same "of some vertices" two.obj some.obj 0 "$plain"
    paint="#MRGB ffffff00FF333300\n#MRGB 00666600ff000000\n"
    { printf "v -1 0 0\nv -1 1 0\n$wedge$paint"; sed -n '/^f/p' "$T/two.obj"; } >"$T/zbrush.obj"
    same "as ZBrush writes them" two.obj zbrush.obj 0 "$plain"
    check "without a word" test ! -s "$T/err"
    { printf "$wedge$paint#MRGB ffffffff\n$faces"; } >"$T/zbrush.obj"
    same "more than there are vertices" wedge.obj zbrush.obj 0 "$plain"
    check "are told" told "zbrush.obj: it has #MRGB, which is not read"
    sed '1s/ 1 1 0$//' "$T/parts.obj" >"$T/some.obj"
    sed '1s/ 1 1 0$/ 1 1 1/' "$T/parts.obj" >"$T/two.obj"
    same "and a vertex without one is white" two.obj some.obj 0 "$plain"
    painted parts "1 0 0" "0 0.2 0" "0 0 1" "0.4 0.4 0"
    sed 's/Kd 1 0 0/Kd 255 0 0/; s/0\.2/51/; s/Kd 0 0 1/Kd 0 0 255/; s/0\.4 0\.4/102 102/' "$T/parts.mtl" >"$T/bytes.mtl"
    sed 's/parts/bytes/' "$T/parts.obj" >"$T/bytes.obj"
    same "and of materials" parts.obj bytes.obj 0 "$plain"
    coff() { { printf "COFF\n4 4 0\n"; rgb_of "$@" | grep ^v | sed 's/^v //'; faces_of; } >"$T/$off"; }
    rgb_of 1 0.2 0.4 0 >"$T/parts.obj"
    off=mixed.off; coff 1 0.2 0.4 0
    same "OFF with some fractions that have no point" parts.obj mixed.off 0 "$plain"
    off=whole.off; coff 255.0 51.0 102.0 0.0
    same "and with a point in numbers to 255" parts.obj whole.off 0 "$plain"
    tinted() { { printf "OFF\n4 4 0\n"; printf "$wedge" | sed 's/^v //'
        printf "3 0 2 1 $1\n3 0 1 3 $2\n3 1 2 3 $3\n3 0 3 2 $4\n"; } >"$T/$off"; }
    off=bytes.off; tinted "255 0 0" "0 51 0" "0 0 255" "102 102 0"
    off=mixed.off; tinted "1 0 0" "0 0.2 0" "0 0 1" "0.4 0.4 0"
    same "in faces" bytes.off mixed.off 0 "$plain"
    for k in 1 0.5; do
        { printf "$wedge" | sed "s/\$/ 1 0 0 $k/"; printf "$faces"; } >"$T/clear$k.obj"
        ply_of clear$k.ply float 1
        sed "s/property float blue/&\nproperty float alpha/; s/ 1 0 0\$/& $k/" "$T/clear$k.ply" >"$T/a.ply"
        mv "$T/a.ply" "$T/clear$k.ply"
        { printf "COFF\n4 4 0\n"; rows "1.0 0 0 $k"; faces_of; } >"$T/clear$k.off"
    done
    ply_of clear.ply uchar 255
    sed "s/property uchar blue/&\nproperty uchar alpha/; s/ 255 0 0\$/& 200/" "$T/clear.ply" >"$T/clear0.5uchar.ply"
    sed 's/ 200$/ 255/' "$T/clear0.5uchar.ply" >"$T/clear1uchar.ply"
    for k in .obj .ply .off uchar.ply; do
        same "an alpha of 1" clear1.obj clear1$k 0 "$plain"
        check "is no word worth" test ! -s "$T/err"
        same "of half" clear1.obj clear0.5$k 0 "$plain"
        check "is told of" told "clear0.5.*: it has alpha, which is not read"
    done
    { printf "$ply_head" | sed 's/vertex 5/vertex 4/; s/double z/&\nproperty double x/'
        rows 9; printf "$ply_faces"; } >"$T/twice.ply"
    same "a property that PLY has twice" wedge.obj twice.ply 0 "--up y"
    check "is told" told "twice.ply: it has x, which is not read"
    for k in -4 3.5; do
        { printf "$ply_head" | sed "s/vertex 5/vertex 4/; s/face 4/face $k/"; rows
            printf "$ply_faces"; } >"$T/count.ply"
        bad_model "$k faces" count.ply "count.ply:7: a count is no whole number"
    done
    { echo solid a; facets | sed 's/endloop/end loop/; s/endfacet/END FACET/'; echo end solid a; } >"$T/ends.stl"
    same "ends in two words" wedge.obj ends.stl 0 "--up y"
    facets | tr '\n' ' ' >"$T/one.txt"
    for k in "solid $(cat "$T/one.txt")" "solid my facet $(cat "$T/one.txt")endsolid my facet" \
        "solid a $(cut -d ' ' -f -42 "$T/one.txt") endsolid a solid b facet normal $(cut -d ' ' -f 43- "$T/one.txt")" \
        "solid a facet normal
$(cat "$T/one.txt")"; do
        printf '%s' "$k" >"$T/one.stl"
        same "text STL in few lines: $k" wedge.obj one.stl 0 "--up y"
        check "without a word" test ! -s "$T/err"
    done
    for k in '\032' '\000\000\000' '\r\n\032\000'; do
        { cat "$T/ends.stl"; printf "$k"; } >"$T/fill.stl"
        same "text STL that ends in $k" wedge.obj fill.stl 0 "--up y"
        check "without a word" test ! -s "$T/err"
    done
}

# Lines: black ones on white darken as many pixels as they are long, times 1.5.  A square that is seen from the front
# fills 1 / 1.1 of the picture.
inked() {                       # model, pixels, options: within 3 %
    model=$1 wanted=$2; shift 2
    draw "$model" a.ppm --size 200x200 --samples 4 --background white --view front --no-shadow "$@" &&
        tail -c 120000 "$T/a.ppm" | od -An -v -tu1 -w3 | awk -v wanted="$wanted" '
            { s = $2 / 255; ink += 1 - (s <= 0.04045 ? s / 12.92 : exp(2.4 * log((s + 0.055) / 1.055))) }
            END { print ink; exit !(ink >= 0.97 * wanted && ink <= 1.03 * wanted) }'
}
gltf_wire() {                   # file, mode, the numbers of the corners of a unit square in octal bytes, how many
    printf '%s,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":%d,"material":0}]}],
        "materials":[{"name":"k","pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0}}],
        "accessors":[{"count":4,"type":"VEC3","componentType":5126,"bufferView":0},{"count":%d,"type":"SCALAR",
        "componentType":5121,"bufferView":1}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":1,"byteLength":%d}],
        "buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAA"},
        {"uri":"data:;base64,%s"}]}' "$gltf_head" $2 $4 $4 "$(printf "$3" | base64)" >"$T/$1"
}
line_reports() {
    printf 'newmtl k\nKd 0 0 0\nnewmtl red\nKd 1 0 0\n' >"$T/wire.mtl"
    printf 'mtllib wire.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl k\n' >"$T/corners.obj"
    { cat "$T/corners.obj"; echo "l 1 2/7 3"; echo "l -2 4 1"; } >"$T/wire.obj"
    { cat "$T/corners.obj"; echo "l 1 2"; } >"$T/line.obj"
    check "a line is 1.5 pixels wide" inked line.obj 275    # 200 / 1.1 and its caps
    check "and told, for l may have been meant as f" grep "line.obj: it has no faces: its lines are drawn" "$T/err"
    check "a square of lines" inked wire.obj 1090
    for k in "" --quick "--shading face" "--model lambert"; do check "lines, $k" inked wire.obj 1090 $k; done
    check "with a colour of the options" inked wire.obj 0 --color white
    gltf_wire loop.gltf 2 '\0\1\2\3' 4
    gltf_wire strip.gltf 3 '\0\1\2\3\0' 5
    gltf_wire list.gltf 1 '\0\1\1\2\2\3\3\0' 8
    for k in loop strip list; do same "lines of glTF" wire.obj $k.gltf 0 "--up y"; done
    check "too many lines" refused "more than 3 lines" "$THUMBNAIL" "$T/list.gltf" "$T/none.ppm" --max-triangles 3
    cube="v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv .2 .5 .5\nv .8 .5 .5\nv .2 .5 1\nv .8 .5 1\n"
    cube="mtllib wire.mtl\n${cube}f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"
    printf "$cube" >"$T/cube.obj"
    printf "${cube}usemtl red\nl 9 10\n" >"$T/inside.obj"
    printf "${cube}usemtl red\nl 11 12\n" >"$T/upon.obj"
    same "faces hide a line" cube.obj inside.obj 0 "--view front"
    check "a line upon a face" draw upon.obj a.ppm --view front --size 121x121 --samples 4
    check "without a word" test ! -s "$T/err"
    check "shows" pixel 0.5 0.5 1 0 0
    check "as long as it is" no pixel 0.2 0.5 1 0 0
    printf "${cube}usemtl red\nl 11 12\nl 2\nv 3 .5 .5\nl 10 13\n" >"$T/far.obj"
    check "the camera sees a line whole" draw far.obj a.ppm --view front --size 121x121 --samples 4
    check "to its end" pixel 0.9 0.5 1 0 0
    check "a section cuts it" draw inside.obj a.ppm --view front --section z=0.6 --size 121x121 --samples 4
    check "shows none in front" no pixel 0.5 0.5 1 0 0
    check "drawings leave lines out" "$THUMBNAIL" "$T/far.obj" "$T/a.ppm" --views front
    printf 'v 0 0 0\nv 1 1 1\nl 1 9\n' >"$T/nowhere.obj"
    bad_model "a line to nowhere" nowhere.obj "there is no v number 9: the file has 2"
    printf 'v 0 0 0\nv 1 1 1\nv nan 0 0\nl 1 2 3\n' >"$T/nan.obj"
    check "a line from nowhere" draw nan.obj a.ppm
    check "is told" grep "nan.obj: 1 lines have ends that are no finite numbers (left out)" "$T/err"
}

# What FreeCAD, VTK, OpenCTM and other writers do with formats
writer_reports() {
    printf "${wedge}vt 0 0\n$faces" | sed 's/^f 1 3 2/f 1\/9 3 2/' >"$T/far.obj"
    same "a vt past the last" wedge.obj far.obj 0 "--up y"
    check "is told" told "far.obj: faces name a vt past the last of 1: they do without"
    printf "${wedge}vn 0 0 1\n$faces" | sed 's/^f 1 3 2/f 1\/\/2 3 2/' >"$T/far.obj"
    same "a vn past the last" wedge.obj far.obj 0 "--up y"
    check "is told" told "far.obj: faces name a vn past the last of 1: they do without"
    { echo "# Created by FreeCAD <https://www.freecad.org>"; cat "$T/wedge.obj"; } >"$T/upright.obj"
    check "z upward" draw wedge.obj a.ppm --up z
    check "of FreeCAD's OBJ" draw upright.obj b.ppm
    check "is known" cmp "$T/a.ppm" "$T/b.ppm"
    { echo "# FreeCAD"; cat "$T/wedge.obj"; echo "# FreeCAD"; } | sed 1d >"$T/upright.obj"
    same "named behind the first line it says nothing" wedge.obj upright.obj 0 ""

    { echo solid; facets; echo endsolid; } >"$T/wedge.ast"
    cp "$T/wedge.ast" "$T/plain.stl"
    same "FreeCAD's name of STL" plain.stl wedge.ast 0 ""
    check "without a word" test ! -s "$T/err"
    sed 's/endfacet/& color 1234/' "$T/plain.stl" >"$T/tinted.stl"
    same "a colour behind endfacet" plain.stl tinted.stl 0 ""
    check "is told" told "tinted.stl: it has color, which is not read"

    vertices="0 0 0 C\n2 0 0 C\n0 1.5 0 C\n0 0 1 C\n"
    printf "COFF\n4 4 0\n$(printf '%s' "$vertices" | sed 's/C/1 0 0 1/g')$ply_faces" >"$T/red.off"
    printf "OFF\n4 4 0\n$(printf '%s' "$vertices" | sed 's/C/1.0 0.0 0.0 0.0/g')$ply_faces" >"$T/bare.off"
    same "colours of vertices without a C" red.off bare.off 0 ""
    check "whose alpha of 0 says nothing" test ! -s "$T/err"
    printf "OFF\n4 4 0\n$(printf '%s' "$vertices" | sed 's/C/255 0 0 128/g')$ply_faces" >"$T/bare.off"
    same "as whole numbers" red.off bare.off 0 ""
    check "whose alpha is told" told "bare.off: it has alpha, which is not read"
    for k in "0.0 0.0 1.0" "-1.0 0.0 0.0 1.0"; do
        printf "OFF\n4 4 0\n$(printf '%s' "$vertices" | sed "s/C/$k/g")$ply_faces" >"$T/bare.off"
        same "$k may be a normal" wedge.obj bare.off 0 "--up y"
        check "that is told" said "bare.off: numbers behind its vertices or faces that are no colours"
    done

    # Gaussian splats: red, green, blue and grey from all sides alike
    points_of() {               # names of colours, of which each point has one line
        printf "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        for k in $1; do echo "property float $k"; done
        printf 'end_header\n'
    }
    { points_of "red green blue"; printf '0 0 0 1 0 0\n2 0 0 0 1 0\n0 1.5 0 0 0 1\n0 0 1 .5 .5 .5\n'; } >"$T/points.ply"
    one=1.7724538509055159
    { points_of "f_dc_0 f_dc_1 f_dc_2"
      printf "0 0 0 $one -$one -$one\n2 0 0 -$one 9 -$one\n0 1.5 0 -$one -$one $one\n0 0 1 0 0 0\n"; } >"$T/splats.ply"
    same "colours of splats" points.ply splats.ply 0 ""
    # size and opacity: an ellipsoid where it covers half, of .3, .1 and .05 times sqrt(2 ln 2), a quarter turn about z
    { printf "ply\nformat ascii 1.0\nelement vertex 6\n"
      for k in x y z nx ny nz red green blue; do echo "property float $k"; done
      printf 'element face 8\nproperty list uchar int vertex_indices\nend_header\n'
      printf '1 2.353223 3 0 1 0 1 0 0\n1 1.646777 3 0 -1 0 1 0 0\n.882259 2 3 -1 0 0 1 0 0\n1.117741 2 3 1 0 0 1 0 0\n'
      printf '1 2 3.0588705 0 0 1 1 0 0\n1 2 2.9411295 0 0 -1 1 0 0\n'
      printf '3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n'; } >"$T/ellipsoid.ply"
    splat_of() {                # opacities of two splats, of which the second is far away
        { printf "ply\nformat ascii 1.0\nelement vertex 2\n"
          for k in x y z f_dc_0 f_dc_1 f_dc_2 opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3; do
              echo "property float $k"
          done
          printf 'end_header\n'
          printf "1 2 3 $one -$one -$one $1 -1.2039728 -2.3025851 -2.9957323 2 0 0 2\n"
          printf "9 9 9 $one -$one -$one $2 -1.2039728 -2.3025851 -2.9957323 2 0 0 2\n"; } >"$T/splats.ply"
    }
    splat_of 40 -.001
    same "sizes of splats" ellipsoid.ply splats.ply 1 ""
    check "both are told" told "splats.ply: 1 Gaussian splats that cover less than half of what is behind (left out); 1 Gaussian splats are drawn as solid ellipsoids"
    splat_of .2231436 -9           # 1 / (1 + exp(-x)) is 5/9: half is covered within sqrt(2 ln(10/9))
    awk 'NF == 9 { k = sqrt(log(10 / 9) / log(2)); $1 = 1 + ($1 - 1) * k; $2 = 2 + ($2 - 2) * k; $3 = 3 + ($3 - 3) * k }
         { print }' "$T/ellipsoid.ply" >"$T/less.ply"
    same "and by how much they hide" less.ply splats.ply 1 ""
}

# Pictures of one kind as other programs store them
picture_reports() {
    pictured() {                # picture
        printf "newmtl q\nmap_Kd $1\n" >"$T/pictured.mtl"
        printf "mtllib pictured.mtl\n${wedge}vt .2 .75\nusemtl q\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1
f 1/1 4/1 3/1\n" >"$T/pictured.obj"
        check "$1" draw pictured.obj "$1.drawn.ppm" --up y
        check "without a word" test ! -s "$T/err"
    }
    same_picture() { check "$1" "$T/look" same "$T/$2.drawn.ppm" "$T/$3.drawn.ppm" 2; }
    printf 'P5\n2 1\n255\n\200\377' >"$T/grey.pgm"
    printf 'P5\n2 1\n15\n\010\017' >"$T/grey15.pgm"
    printf 'P5\n2 1\n65535\n\200\200\377\377' >"$T/grey65535.pgm"
    printf 'P6\n2 1\n1023\n\002\001\002\001\002\001\003\377\003\377\003\377' >"$T/grey1023.ppm"
    printf 'P2\n# text\n2 1\n510\n256 510\n' >"$T/text.pgm"
    pictured grey.pgm
    for k in grey15.pgm grey65535.pgm grey1023.ppm text.pgm; do
        pictured $k
        check "its greatest value counts: $k" "$T/look" same "$T/grey.pgm.drawn.ppm" "$T/$k.drawn.ppm" 9
    done
    tga() { printf '\000\000\002\000\000\000\000\000\000\000\000\000\002\000\001\000\030'"$1" >"$T/$2"; }
    tga '\040\000\000\377\377\000\000' left.tga      # from the top left: red, blue
    tga '\060\377\000\000\000\000\377' right.tga     # from the top right
    tga '\020\377\000\000\000\000\377' low.tga       # from the bottom right
    pictured left.tga
    for k in right.tga low.tga; do
        pictured $k
        same_picture "a TGA stored from the right: $k" left.tga $k
    done
    printf 'P5\n2 1\n100\n\200\310' >"$T/wrong.pgm"
    printf 'newmtl q\nmap_Kd wrong.pgm\n' >"$T/pictured.mtl"
    check "drawn without" draw pictured.obj a.ppm --up y
    check "a value above its own maximum" said "wrong.pgm: a value above its own maximum"
}
