#!/bin/sh
# desktop.sh PREFIX thumbnailer|view - prints the entry by which file managers draw thumbnails with
# build/thumbnail, installed as shade-thumbnail, or the entry by which they open models with build/view.
# The programs show whether they have assimp, stb, zlib and SDL2.
#
# Each type has all the names that packages of Debian 12 give it, the one of shared-mime-info first: where
# two packages claim a file's ending, a desktop takes the name of one of them.
own="model/obj model/x-wavefront-obj application/x-wavefront-obj application/prs.wavefront-obj \
model/stl application/sla model/x.stl-ascii model/x.stl-binary \
application/vnd.ply model/x-ply model/x-geomview-off application/vnd.off \
model/gltf+json model/gltf-binary"
packed="model/3mf application/vnd.ms-3mfdocument"
by_assimp="application/vnd.fbx model/vnd.collada+xml application/vnd.dae image/x-3ds application/vnd.3ds \
image/x-lwo image/vnd.dxf application/x-amf"
has() { grep -q "$2" "build/$1"; }
types() {
    list=$own
    ! has "$1" inflateInit2_ || list="$list $packed"
    ! has "$1" aiImportFile || list="$list $by_assimp"
    printf '%s;' $list
}
case $2 in
thumbnailer)    # with bounds of time and memory, because folders hold any files
    png=
    ! has thumbnail 'bad png sig' || png=' --png'    # stb's
    cat <<END
[Thumbnailer Entry]
TryExec=$1/bin/shade-thumbnail
Exec=$1/bin/shade-thumbnail$png --quiet --max-seconds 30 --max-memory 2000 --size %sx%s %i %o
MimeType=$(types thumbnail)
END
    ;;
view)
    window=' --window' terminal=false
    has view SDL_CreateWindow || window='' terminal=true
    cat <<END
[Desktop Entry]
Type=Application
Name=shade-view
GenericName=Model Viewer
Comment=Shows a model turning
Keywords=3D;mesh;STL;OBJ;PLY;glTF;
Icon=applications-graphics
TryExec=$1/bin/shade-view
Exec=$1/bin/shade-view$window %f
Terminal=$terminal
Categories=Graphics;3DGraphics;Viewer;
MimeType=$(types view)
END
    ;;
esac
