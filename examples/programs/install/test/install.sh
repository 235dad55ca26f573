#!/bin/sh
# install.sh - make install into scratch directories: which files, a client that finds the header
# through pkg-config, the thumbnailer's line run as a file manager runs it; make uninstall.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc} MAKE=${MAKE:-make}
number=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
V=$((number / 10000)).$((number / 100 % 100)).$((number % 100))

modes() {
    (cd "$1" && find . ! -type d -exec ls -l {} +) |
        awk '{ print substr($1, 1, 10), $NF }' | sort -k 2
}
files='-rwxr-xr-x ./bin/shade-batch
-rwxr-xr-x ./bin/shade-compare
-rwxr-xr-x ./bin/shade-sheets
-rwxr-xr-x ./bin/shade-thumbnail
-rwxr-xr-x ./bin/shade-view
-rw-r--r-- ./include/shade.h
-rw-r--r-- ./share/applications/shade-view.desktop
-rw-r--r-- ./share/bash-completion/completions/shade-batch
-rw-r--r-- ./share/bash-completion/completions/shade-compare
-rw-r--r-- ./share/bash-completion/completions/shade-sheets
-rw-r--r-- ./share/bash-completion/completions/shade-thumbnail
-rw-r--r-- ./share/bash-completion/completions/shade-view
-rw-r--r-- ./share/cmake/shade/shade-config-version.cmake
-rw-r--r-- ./share/cmake/shade/shade-config.cmake
-rw-r--r-- ./share/man/man1/shade-batch.1
-rw-r--r-- ./share/man/man1/shade-compare.1
-rw-r--r-- ./share/man/man1/shade-sheets.1
-rw-r--r-- ./share/man/man1/shade-thumbnail.1
-rw-r--r-- ./share/man/man1/shade-view.1
-rw-r--r-- ./share/mime/packages/shade.xml
-rw-r--r-- ./share/pkgconfig/shade.pc'

# ---- into a prefix ------------------------------------------------------------------------------
P=$T/prefix
strict_umask() { (umask 077 && $MAKE -s install PREFIX="$P") >"$T/said"; }
check "make install" strict_umask
check "no thumbnailer where GNOME cannot see it, and why" grep -qx "no thumbnails in file managers: \
GNOME shows thumbnailers /usr alone; install with PREFIX=/usr or /usr/local" "$T/said"
check "these files, readable by all" same "$(modes "$P")" "$files"
check "in directories open to all" same "$(find "$P" -type d ! -perm -755)" ""
check "the header is this one" cmp shade.h "$P/include/shade.h"
export THUMBNAIL="$P/bin/shade-thumbnail"    # which sheets calls
for p in thumbnail view batch sheets compare; do
    page="$P/share/man/man1/shade-$p.1"
    check "$p is the one built" cmp build/$p "$P/bin/shade-$p"
    check "$p has the version of shade.h" same "$("$P/bin/shade-$p" --version)" "shade-$p $V"
    check "its page has it" grep -qF "$V" "$page"
    check "its page has its exit status" sh -c "sed -n '/^.SH \"EXIT STATUS\"/,\$p' '$page' | grep -q '^0'"
    for option in $("$P/bin/shade-$p" --help | sed -n 's/^  \(--[a-z-]*\).*/\1/p'); do
        check "its page has $option" grep -q "^[.]B $(echo "$option" | sed 's/-/\\\\-/g')" "$page"
    done
    check "its page has examples" grep -q '^[.]SH EXAMPLES' "$page"
    [ $p = sheets ] || check "and formats" sh -c "grep -A1 '^[.]SH FORMATS' '$page' | grep -q 'OBJ with MTL, STL, PLY'"
    if command -v man >/dev/null 2>&1 && command -v groff >/dev/null 2>&1; then
        check "its page without a warning" same \
            "$(LC_ALL=C MANROFFOPT='' man --warnings -l "$page" 2>&1 >/dev/null)" ""
    fi
done
check "a sentence on two lines of help is one paragraph" same \
    "$(grep -A1 'as large as the$' "$P/share/man/man1/shade-compare.1" | tail -n 1)" "picture that it is compared with:"
check "what stands behind an example is no part of the command" no grep -q '^[.]B .*   ' "$P"/share/man/man1/*.1
check "and is told" grep -qx "(on one of eight machines)" "$P/share/man/man1/shade-batch.1"
sed -n 's/^    KEY("\(.*\)").*/\1/p' examples/kit/scene/scene.h >"$T/keys"
check "keys are known" test "$(wc -l <"$T/keys")" -gt 9
check "the page of view has each" same "$(sed -n '/^[.]SH KEYS/,/^[.]SH EX/p' "$P/share/man/man1/shade-view.1" |
    grep -A1 '^[.]B' | grep -v '^--$' | sed 's/^[.]B //; s/\\-/-/g' | paste -d ' ' - - | tr -s ' ')" "$(tr -s ' ' <"$T/keys")"
command -v man >/dev/null 2>&1 || echo "install: no man: warnings about pages left out"
if command -v update-mime-database >/dev/null 2>&1; then
    cp -r "$P/share/mime" "$T/mime"
    check "the types are understood" update-mime-database "$T/mime"
    for type in application/vnd.ply:ply application/vnd.fbx:fbx model/vnd.collada+xml:dae \
        model/x-geomview-off:off application/x-amf:amf model/obj:obj model/stl:stl image/x-3ds:3ds; do
        check "$type" grep -qx "60:${type%:*}:[*].${type#*:}" "$T/mime/globs2"
    done
else echo "install: no shared-mime-info: types left out"
fi

# ---- completion of bash --------------------------------------------------------------------------
# program, words: what is offered for the last word
offered() {
    bash -c 'source "$1/share/bash-completion/completions/$2" && shift || exit 1
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); "_${1//-/_}"; echo "${COMPREPLY[*]}"' bash "$P" "$@"
}
if command -v bash >/dev/null 2>&1; then
    for p in thumbnail view batch compare sheets; do
        check "all options of $p" same "$(offered shade-$p -- | tr ' ' '\n' | sort)" \
            "$("$P/bin/shade-$p" --help | sed -n 's/^  \(--[a-z-]*\).*/\1/p' | { cat; echo --version; } | sort -u)"
        [ $p = sheets ] && continue
        values=0
        for option in $(offered shade-$p --); do
            for value in $(offered shade-$p $option ''); do
                values=$((values + 1))
                check "$p $option $value is taken" "$P/bin/shade-$p" $option "$value" --help
            done
        done
        check "values of $p" test $values -gt 20
    done
    check "the begin of a value" same "$(offered shade-view --show s)" "sextants sixel"
    check "names of files are left to bash" same "$(offered shade-thumbnail --depth '')" ""
    check "it is the program's" same "$(bash -c "source '$P/share/bash-completion/completions/shade-view'; complete -p shade-view")" \
        "complete -o default -F _shade_view shade-view"
else left_out "completion: no bash"; fi

# ---- a client -----------------------------------------------------------------------------------
cat >"$T/client.c" <<'END'
#define SHADE_IMPLEMENTATION
#include <shade.h>
int main(void)
{
    shade_vec3 to_light = shade_normalize(shade_v3(0, 3, 4));
    printf("%d.%d.%d", SHADE_VERSION / 10000, SHADE_VERSION / 100 % 100, SHADE_VERSION % 100);
    return shade_lambert(shade_v3(0, 0, 1), to_light) != 0.8f;
}
END
if command -v pkg-config >/dev/null 2>&1; then
    PKG_CONFIG_PATH=$P/share/pkgconfig
    export PKG_CONFIG_PATH
    check "pkg-config finds it" pkg-config --print-errors --exists 'shade >= 1.0' 'shade < 2'
    check "a client compiles" $CC -std=c99 "$T/client.c" $(pkg-config --cflags --libs shade) \
        -o "$T/client"
    check "and runs" "$T/client"
    check "one version" same "$(pkg-config --modversion shade)" "$("$T/client")"
else echo "install: no pkg-config: the client is left out"
fi
if command -v cmake >/dev/null 2>&1; then
    mkdir "$T/found"
    cp "$T/client.c" "$T/found"
    project() {                 # version that is asked for
        printf '%s\n' 'cmake_minimum_required(VERSION 3.14)' 'project(client C)' "find_package(shade $1 CONFIG REQUIRED)" \
            'add_executable(client client.c)' 'target_link_libraries(client shade::shade)' >"$T/found/CMakeLists.txt"
        rm -rf "$T/found/build"
        cmake -S "$T/found" -B "$T/found/build" -DCMAKE_PREFIX_PATH="$P" -DCMAKE_BUILD_TYPE=Release
    }
    check "find_package(shade)" project ""
    check "a client of CMake" cmake --build "$T/found/build"
    check "finds this version" same "$("$T/found/build/client")" "$V"
    check "and this one as 1.2 or later" project 1.2
    check "not as version 2" no project 2.0
else echo "install: no cmake: find_package is left out"
fi
# the header alone, which compiles nothing
check "make install-header" sh -c "CC=false $MAKE -s install-header PREFIX='$T/header' CC=false"
check "has the header's files" same "$(cd "$T/header" && find . -type f | sort | tr '\n' ' ')" "./include/shade.h \
./share/cmake/shade/shade-config-version.cmake ./share/cmake/shade/shade-config.cmake ./share/pkgconfig/shade.pc "

# ---- the thumbnailer ----------------------------------------------------------------------------
mkdir "$T/models"
input="$T/models/it's a model (1)"
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >"$input.obj"
printf 'solid s\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 0\nvertex 1 -1 0\nvertex 0 1 0\n' \
    >"$input.stl"
printf 'endloop\nendfacet\nendsolid s\n' >>"$input.stl"
{
    printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
    printf 'property float z\nelement face 1\nproperty list uchar int vertex_indices\n'
    printf 'end_header\n-1 -1 0\n1 -1 0\n0 1 0\n3 0 1 2\n'
} >"$input.ply"
cat >"$input.dae" <<'END'
<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">-1 -1 0 1 -1 0 0 1 0</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
END
cat >"$input.fbx" <<'END'
; FBX 7.3.0 project file
FBXHeaderExtension:  {
    FBXHeaderVersion: 1003
    FBXVersion: 7300
}
Objects:  {
    Geometry: 1, "Geometry::g", "Mesh" {
        Vertices: *9 {
            a: -1,-1,0,1,-1,0,0,1,0
        }
        PolygonVertexIndex: *3 {
            a: 0,1,-3
        }
        GeometryVersion: 124
    }
    Model: 2, "Model::m", "Mesh" {
        Version: 232
    }
}
Connections:  {
    C: "OO",2,0
    C: "OO",1,2
}
END
# the same triangle of glTF: twelve floats in little endian, 0, 1 or -1
corners() {
    z='\0\0\0\0' p='\0\0\200?' m='\0\0\200\277'
    printf "$m$m$z$p$m$z$z$p$z"
}
gltf() {                        # where its buffer is, as JSON
    printf '%s' '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],' \
        '"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],' \
        '"accessors":[{"bufferView":0,' \
        '"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}],' \
        '"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{'"$1"'"byteLength":36}]}'
}
word() { printf "$(printf '\\%03o\\%03o\\%03o\\%03o' $(($1 % 256)) $(($1 / 256)) 0 0)"; }
gltf "\"uri\":\"data:application/octet-stream;base64,$(corners | base64 | tr -d '\n')\"," \
    >"$input.gltf"
size=$(gltf '' | wc -c)
padding=$(((4 - size % 4) % 4))
{
    printf 'glTF'; word 2; word $((12 + 8 + size + padding + 8 + 36))
    word $((size + padding)); printf 'JSON'; gltf ''; printf "%${padding}s" ''
    word 36; printf 'BIN\0'; corners
} >"$input.glb"
# of 3DS: nested pieces, each a number, its length, and what it holds
{
    printf 'MM'; word 86; printf '=='; word 80; printf '\0@'; word 74; printf 's\0'
    printf '\0A'; word 66; printf '\020A'; word 44; printf '\3\0'; corners
    printf '\040A'; word 16; printf '\1\0\0\0\1\0\2\0\7\0'
} >"$input.3ds"
printf 'OFF\n3 1 0\n-1 -1 0\n1 -1 0\n0 1 0\n3 0 1 2\n' >"$input.off"
{
    printf '<?xml version="1.0"?><amf unit="millimeter"><object id="0"><mesh><vertices>'
    for corner in "-1 -1" "1 -1" "0 1"; do
        printf '<vertex><coordinates><x>%s</x><y>%s</y><z>0</z></coordinates></vertex>' $corner
    done
    printf '</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>'
    printf '</mesh></object></amf>'
} >"$input.amf"
{
    printf '  0\nSECTION\n  2\nENTITIES\n  0\n3DFACE\n  8\n0\n'
    printf ' 10\n-1\n 20\n-1\n 30\n0\n 11\n1\n 21\n-1\n 31\n0\n 12\n0\n 22\n1\n 32\n0\n'
    printf ' 13\n0\n 23\n1\n 33\n0\n  0\nENDSEC\n  0\nEOF\n'
} >"$input.dxf"
# of LWO: pieces in big endian
{
    p='?\200\0\0' m='\277\200\0\0' z='\0\0\0\0'
    printf 'FORM\0\0\0\204LWO2TAGS\0\0\0\2s\0LAYR\0\0\0\022\0\0\0\0'
    printf "$z$z$z\\0\\0PNTS\\0\\0\\0\\044"
    printf "$m$m$z$p$m$z$z$p$z"
    printf 'POLS\0\0\0\014FACE\0\3\0\0\0\1\0\2PTAG\0\0\0\010SURF\0\0\0\0'
    printf 'SURF\0\0\0\004s\0\0\0'
} >"$input.lwo"
threemf() {
    python3 - "$input.3mf" <<'END'
import sys, zipfile
core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
office = "http://schemas.openxmlformats.org/package/2006/"
with zipfile.ZipFile(sys.argv[1], "w") as z:
    z.writestr("[Content_Types].xml", f'<Types xmlns="{office}content-types">'
               '<Default Extension="rels" ContentType='
               '"application/vnd.openxmlformats-package.relationships+xml"/>'
               '<Default Extension="model" ContentType='
               '"application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
    z.writestr("_rels/.rels", f'<Relationships xmlns="{office}relationships">'
               '<Relationship Id="r" Target="/3D/3dmodel.model" '
               'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
               '</Relationships>')
    z.writestr("3D/3dmodel.model", f'<model unit="millimeter" xmlns="{core}"><resources>'
               '<object id="1" type="model"><mesh><vertices><vertex x="-1" y="0" z="-1"/>'
               '<vertex x="1" y="0" z="-1"/><vertex x="0" y="0" z="1"/></vertices><triangles>'
               '<triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources>'
               '<build><item objectid="1"/></build></model>')
END
}
sample() {                      # the file of a MIME type
    case $1 in
    model/obj | *wavefront-obj) echo "$input.obj" ;;
    model/stl | */sla | model/x.stl-*) echo "$input.stl" ;;
    model/gltf+json) echo "$input.gltf" ;;
    model/gltf-binary) echo "$input.glb" ;;
    model/3mf | */vnd.ms-3mfdocument) echo "$input.3mf" ;;
    image/x-3ds | application/vnd.3ds) echo "$input.3ds" ;;
    application/vnd.ply | model/x-ply) echo "$input.ply" ;;
    application/vnd.fbx) echo "$input.fbx" ;;
    model/vnd.collada+xml | application/vnd.dae) echo "$input.dae" ;;
    */x-geomview-off | */vnd.off) echo "$input.off" ;;
    */x-amf) echo "$input.amf" ;;
    */vnd.dxf) echo "$input.dxf" ;;
    */x-lwo) echo "$input.lwo" ;;
    *) return 1 ;;
    esac
}
sh examples/programs/install/desktop.sh "$P" thumbnailer >"$T/shade.thumbnailer"
# of a build with all libraries
sh -c 'grep() { :; }; set -- "$1" thumbnailer; . examples/programs/install/desktop.sh' sh "$P" >"$T/all.thumbnailer"
entry() { sed -n "s/^$1=//p" "$T/shade.thumbnailer"; }
# Exec with %i, %o and %s put in, word by word; the output is there already, empty
thumbnail() {                   # input, output, size
    : >"$2"
    set -- "$1" "$2" "$3" $(entry Exec)
    in=$1 out=$2 size=$3
    shift 3
    for word; do
        case $word in
        %i) word=$in ;;
        %o) word=$out ;;
        *) word=$(printf '%s' "$word" | sed "s/%s/$size/g") ;;
        esac
        set -- "$@" "$word"
        shift
    done
    "$@"
}
# A PPM or PNG of 64 x 64 with more than one colour
picture() {
    case $(head -c 4 "$1" | od -An -c | tr -d ' ') in
    P6*) same "$(head -n 2 "$1" | tr '\n' ' ')" "P6 64 64 " || return 1 ;;
    '211PNG')
        same "$(tail -c +17 "$1" | head -c 8 | od -An -tu1 | tr -d ' ')" 0006400064 || return 1
        ;;
    *) echo "neither PPM nor PNG"; return 1 ;;
    esac
    [ "$(od -An -v -tx1 -w3 "$1" | sort -u | wc -l)" -gt 9 ]
}
if there parallel; then
    mkdir "$T/parts" && cp "$input.obj" "$T/parts/a.obj"
    check "shade-sheets" "$P/bin/shade-sheets" "$T/parts" "$T/sheets" --size 200x150
    check "draws what it reads" test -s "$T/sheets/a.obj.png"
else left_out "sheets: no parallel"; fi
check "a group and its three keys" same "$(sed 's/=.*//' "$T/shade.thumbnailer" |
    tr '\n' ' ')" "[Thumbnailer Entry] TryExec Exec MimeType "
check "TryExec is a program" test -x "$(entry TryExec)"
check "it has bounds" sh -c "grep -q '^Exec=.* --max-seconds [0-9]* --max-memory [0-9]* ' '$T/shade.thumbnailer'"
check "Exec is the same" same "$(entry Exec | cut -d ' ' -f 1)" "$(entry TryExec)"
check "types, each with a semicolon" same "$(entry MimeType | tr -d 'a-z0-9+./-' | tr -s ';')" ";"
for type in $(entry MimeType | tr ';' ' '); do
    file=$(sample "$type")
    if [ "${file##*.}" = 3mf ] && ! threemf; then
        echo "install: no python3: 3MF left out"
        continue
    fi
    check "a file of type $type" test -f "$file"
    check "a thumbnail of $type" thumbnail "$file" "$T/models/out put.png" 64
    check "that is a picture" picture "$T/models/out put.png"
done
# GNOME's sandbox shows a program the model and nothing beside it
mkdir "$T/alone"
sed 1i"mtllib own.mtl" "$input.obj" >"$T/alone/m.obj"
buffer='"uri":"own.bin",'
gltf "$buffer" >"$T/alone.gltf"
hidden() {                      # file beside the model, that folder, the program's output
    "$P/bin/shade-thumbnail" --size 64x64 "$2" "$T/alone.ppm" >"$T/said" 2>&1
    grep -q "$1: No such file or directory: it may be hidden, for the folder shows the model alone" "$T/said"
}
check "a library that may be hidden" hidden own.mtl "$T/alone/m.obj"
check "it is drawn without" test -s "$T/alone.ppm"
mv "$T/alone.gltf" "$T/alone/m.gltf"
check "beside another file it is not there" no hidden own.mtl "$T/alone/m.obj"
rm "$T/alone/m.obj"
check "a buffer that may be hidden" hidden own.bin "$T/alone/m.gltf"

# what a desktop calls each file, with the types of the system, of MeshLab's kind, and ours
if there gio && there update-mime-database && [ -f /usr/share/mime/packages/freedesktop.org.xml ]; then
    packages="$T/desktop/mime/packages"
    mkdir -p "$packages"
    cp /usr/share/mime/packages/freedesktop.org.xml "$packages"
    cp "$P/share/mime/packages/shade.xml" "$packages"
    {
        echo '<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">'
        for claim in application/sla:stl model/x-wavefront-obj:obj model/x-ply:ply; do
            echo "<mime-type type=\"${claim%:*}\"><glob pattern=\"*.${claim#*:}\"/></mime-type>"
        done
        echo '</mime-info>'
    } >"$packages/other.xml"
    check "types beside those of others" env XDG_DATA_DIRS="$T/desktop" \
        update-mime-database "$T/desktop/mime"
    type_of() {                 # file
        XDG_DATA_HOME="$T/none" XDG_DATA_DIRS="$T/desktop" gio info -a standard::content-type "$1" |
            sed -n 's/.*content-type: //p'
    }
    printf '####\n#\n# OBJ File Generated by Meshlab\n#\n####\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' \
        >"$T/models/signed.obj"
    check "an OBJ that begins with ##" same "$(type_of "$T/models/signed.obj")" model/obj
    for file in "$T/models/"*; do
        [ -s "$file" ] && [ "${file##*.}" != png ] || continue
        found=$(type_of "$file")
        check "${file##*/}, $found, has a thumbnail" grep -q "^MimeType=.*$found;" "$T/all.thumbnailer"
    done
else left_out "types of files on a desktop: no gio or shared-mime-info"
fi

. examples/programs/install/test/desktops.sh

# ---- what the programs' help shows as examples ---------------------------------------------------
mkdir -p "$T/shown/parts"
cp "$input.glb" "$T/shown/car.glb"
cp "$input.stl" "$T/shown/part.stl"
cp "$input.stl" "$T/shown/bolt.stl"
cp "$input.obj" "$T/shown/parts"
shown() { (cd "$T/shown" && PATH="$P/bin:$PATH" sh -c "$1"); }
shown "shade-thumbnail bolt.stl golden.png && cp golden.png drawn.png" 2>/dev/null || left_out "PNG: no stb"
if [ -f "$T/shown/golden.png" ] && there ffmpeg && there parallel; then
    for p in thumbnail compare batch sheets; do
        # fewer and smaller pictures than they show
        "$P/bin/shade-$p" --help | sed -n '/^examples:/,$s/^  //p' |
            sed 's/     .*//; s/8000x6000/800x600/; s/--frames 90/--frames 3/' >"$T/examples"
        check "$p has examples" test -s "$T/examples"
        while read -r line; do check "$line" shown "$line"; done <"$T/examples"
    done
    check "they have drawn" test -s "$T/shown/sheet.png" -a -s "$T/shown/bolt.mp4" -a -s "$T/shown/apart.png"
else left_out "the examples of the programs: no stb, ffmpeg or parallel"; fi

# ---- for a package, and away --------------------------------------------------------------------
S="$T/stage of a package"
check "make install with DESTDIR" $MAKE -s install DESTDIR="$S" PREFIX=/usr
check "the same files below it, and the thumbnailer" same "$(modes "$S/usr")" "$files
-rw-r--r-- ./share/thumbnailers/shade.thumbnailer"
check "which do not know of it" sh -c "! grep -r 'stage of' '$S'"
check "pkg-config file of the prefix" grep -qx 'prefix=/usr' "$S/usr/share/pkgconfig/shade.pc"
check "thumbnailer of the prefix" grep -q '^Exec=/usr/bin/shade-thumbnail ' \
    "$S/usr/share/thumbnailers/shade.thumbnailer"
check "it belongs below /usr/local too" sh -c "$MAKE -n uninstall PREFIX=/usr/local | grep -q shade.thumbnailer"
if there desktop-file-validate; then
    check "the entry of shade-view" desktop-file-validate "$S/usr/share/applications/shade-view.desktop"
else left_out "the entry of shade-view: no desktop-file-utils"; fi
: >"$P/include/other.h"
: >"$P/bin/thumbnail"
for again in "" " again"; do
    check "make uninstall$again" $MAKE -s uninstall PREFIX="$P"
done
check "what is not ours stays" same "$(cd "$P" && find . -type f | sort | tr '\n' ' ')" \
    "./bin/thumbnail ./include/other.h "
check "make uninstall with DESTDIR" $MAKE -s uninstall DESTDIR="$S" PREFIX=/usr
check "no file stays there" same "$(find "$S" -type f)" ""
check "and no folder that make install made" same "$(cd "$S" && find . -mindepth 1 -type d | sort | tr '\n' ' ')" ""

finish
