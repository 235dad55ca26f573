#!/bin/sh
# project.sh - the project of examples/teaching/project: what students get, walked as its README says;
# judge.py tries solutions, starters and mistakes.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
P=examples/teaching/project
there python3 || { left_out "all of it: no python3"; finish; }
chmod 711 "$T"

if there zip; then
    check "what students get is packed" sh $P/hand_out.sh "$T/project.zip"
    python3 -m zipfile -e "$T/project.zip" "$T/got"
    check "no solution is in it" same "$(find "$T/got" -name 'solution*' -o -name test -o -name '[0-9][0-9]_*.py')" ""
    check "the starter draws from the first minute" sh -c \
        "cd '$T/got/$P/starter' && ${MAKE:-make} -s pictures CC='${CC:-cc}' && test -s 6.png"
    check "what it draws is a PNG" python3 -c "
import sys, zlib
data = open(sys.argv[1], 'rb').read()
at, rows = 8, b''
while at < len(data):
    size, name = int.from_bytes(data[at:at + 4], 'big'), data[at + 4:at + 8]
    assert zlib.crc32(data[at + 4:at + 8 + size]) == int.from_bytes(data[at + 8 + size:at + 12 + size], 'big')
    rows += data[at + 8:at + 8 + size] if name == b'IDAT' else b''
    at += 12 + size
assert name == b'IEND' and len(zlib.decompress(rows)) == 384 * (3 * 512 + 1)" "$T/got/$P/starter/1.png"
    (cd "$T/got/$P/starter" && python3 ../check.py 1 renderer.c --picture difference.png) >"$T/said"
    check "it is judged, and told what to do" grep -q '^checkpoint 1: 0 of 10 points$' "$T/said"
    check "with a picture of what differs" test -s "$T/got/$P/starter/difference.png"
    cp $P/test/solution.c "$T/got/$P/starter/renderer.c"
    (cd "$T/got/$P/starter" && python3 ../check.py 1 renderer.c --json r.json) >"$T/said"
    (cd "$T/got/$P/starter" && ${MAKE:-make} -s renderer CC="${CC:-cc}" && ./renderer 3 && ./renderer 6 2) >/dev/null
    check "its own scene of clipping is cut" sh -c "! cmp -s '$T/got/$P/starter/3.png' '$T/got/$P/starter/6.png'"
    check "a right one gets full points" grep -q '^checkpoint 1: 10 of 10 points$' "$T/said"
    check "results are those of Gradescope" python3 -c "
import json, sys
assert sum(t['score'] for t in json.load(open(sys.argv[1]))['tests']) == 10" "$T/got/$P/starter/r.json"
else left_out "what students get: no zip"; fi
sed 's/corner\[j\]\.value + 6, c)/corner[j].value + 6, v[0]->color)/' $P/test/solution.c >"$T/renderer.c"
python3 $P/check.py 2 "$T/renderer.c" | grep -v '^ok' >"$T/said"
check "README shows what a mistake is told" grep -qF "$(sed -n '/^```text/,/^```$/p' $P/README.md | sed -n 4p)" "$T/said"
python3 $P/test/judge.py >"$T/said" 2>&1
check "judge.py" test $? -eq 0
tail -n 30 "$T/said"
finish
