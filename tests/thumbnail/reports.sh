# reports.sh - files as other programs write them, each beside a plain OBJ of the same picture: a
# wedge of four triangles.  Read by tests/scripts/thumbnail.sh.

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
# A file says one thing that is left out, and no more.
said() { [ "$(wc -l <"$T/err")" -eq 1 ] && grep "$1 (left out)" "$T/err"; }

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
    check "which is told" said "faces name a vt, and the file has none"
}
