#!/bin/sh
# sheets.sh FOLDER SHEETS [options of thumbnail] - draws a sheet of views of every model in a folder
# and the folders in it, on all cores, by GNU parallel:
#
#     sh examples/programs/batch/sheets.sh parts sheets --edges --hidden --dimensions
#
# The sheet of parts/a/bolt.stl is sheets/a/bolt.stl.png.  A sheet that is newer than its model stays,
# so what was interrupted goes on where it was.  A model that cannot be read is one line on stderr,
# and the status is not 0.  THUMBNAIL names the program (shade-thumbnail), JOBS the jobs at a time.
THUMBNAIL=${THUMBNAIL:-shade-thumbnail}
usage() {
    cat <<END
usage: shade-sheets FOLDER SHEETS [options of shade-thumbnail]
  --help      prints this text
  --version   prints the version
the sheet of FOLDER/a/bolt.stl is SHEETS/a/bolt.stl.png; a sheet that is newer than its model stays.
a model that cannot be read is one line on stderr, and the status is not 0.
the environment: THUMBNAIL names the program (shade-thumbnail), JOBS the jobs at a time.
exit status: 0 every model has its sheet; others: models that could not be read, no GNU parallel
examples:
  shade-sheets parts sheets --edges --hidden --dimensions
END
}
case $1 in
--version) version=$("$THUMBNAIL" --version) && echo "shade-sheets ${version##* }"; exit ;;
--help) usage; exit ;;
esac
[ $# -ge 2 ] || { usage >&2; exit 1; }
models=$1 sheets=$2; shift 2
wrong() { echo "shade-sheets: $*" >&2; exit 1; }
[ -d "$models" ] || wrong "$models: is no folder"
[ ! -e "$sheets" ] || [ -d "$sheets" ] || wrong "$sheets: is no folder"
for word; do
    case $word in --json* | --depth* | --id-map*) wrong "$word names one file, for many models" ;; esac
done
command -v parallel >/dev/null || wrong "this needs GNU parallel"
mkdir -p "$sheets" || exit 1
sheets=$(cd "$sheets" && pwd)
command -v "$THUMBNAIL" >/dev/null || wrong "there is no $THUMBNAIL"
case $THUMBNAIL in */*) THUMBNAIL=$(cd "${THUMBNAIL%/*}" && pwd)/${THUMBNAIL##*/};; esac
export sheets THUMBNAIL
one() {                         # model, options
    sheet=$sheets/${1#./}.png model=$1; shift
    [ -n "$(find "$sheet" -newer "$model" 2>/dev/null)" ] && return
    mkdir -p "${sheet%/*}" &&
        "$THUMBNAIL" "$model" "$sheet" --views front,right,top,iso --threads 1 --quiet "$@" </dev/null
}
if [ "$1" = --one ]; then shift; cd "$models" && one "$@"; exit; fi
script=$(cd "$(dirname "$0")" && pwd)/${0##*/}
cd "$models" || exit 1
every() {
    find . -type f \( -iname '*.stl' -o -iname '*.obj' -o -iname '*.ply' -o -iname '*.3mf' \
        -o -iname '*.gltf' -o -iname '*.glb' -o -iname '*.fbx' -o -iname '*.dae' -o -iname '*.3ds' \
        -o -iname '*.off' -o -iname '*.amf' \) "$@"
}
[ "$(every -print | head -n 1)" ] || echo "shade-sheets: $models has no models" >&2
every -print0 | sort -z |
    parallel -0 ${JOBS:+-j "$JOBS"} sh "$script" . "$sheets" --one {} "$@"
