#!/bin/sh
# thumbnailer.sh PREFIX - prints the entry by which file managers call build/thumbnail, installed as
# shade-thumbnail, with bounds of time and memory, because folders hold any files.  The program shows
# whether it has assimp, stb and zlib.  Types that shared-mime-info does not know have the names that
# f3d gives them, in mime.xml.
types="model/obj model/stl application/vnd.ply model/gltf+json model/gltf-binary"
! grep -q inflateInit2_ build/thumbnail || types="$types model/3mf"
! grep -q aiImportFile build/thumbnail || types="$types image/x-3ds application/vnd.fbx \
model/vnd.collada+xml"
png=
! grep -q IHDR build/thumbnail || png=' --png'
cat <<END
[Thumbnailer Entry]
TryExec=$1/bin/shade-thumbnail
Exec=$1/bin/shade-thumbnail$png --quiet --max-seconds 30 --max-memory 2000 --size %sx%s %i %o
MimeType=$(printf '%s;' $types)
END
