#!/bin/sh
# hand_out.sh OUT.zip - packs what students get of the project: pages, starter, judge, vectors.h, shade.h.
# Solutions and tests stay here.
[ $# -eq 1 ] || { echo "usage: hand_out.sh OUT.zip" >&2; exit 2; }
case $1 in /*) zip=$1 ;; *) zip=$PWD/$1 ;; esac
cd "$(dirname "$0")/../../.." || exit 1
command -v zip >/dev/null || { echo "hand_out.sh: there is no zip (apt install zip)" >&2; exit 1; }
P=examples/teaching/project A=examples/teaching/assignments
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
mkdir -p "$T/$P" "$T/$A/judge"
cp shade.h LICENSE "$T"
cp -R $P/*.md $P/check.py $P/judge $P/starter "$T/$P"
cp $A/vectors.h "$T/$P/starter"
cp $A/vectors.h $A/grade.py "$T/$A"
for name in __init__.py points.py tools.py process.py room.py student.py student.c hold.c prototypes.h; do
    cp "$A/judge/$name" "$T/$A/judge" || exit 1
done
rm -f "$zip"
cd "$T" && zip -qr "$zip" . -x '*__pycache__*'
