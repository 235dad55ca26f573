#!/bin/sh
# figures.sh - figures to take along: each is listed with its caption, is XML with a title, and those that
# figures.py draws are what it draws.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
F=examples/teaching/figures
there python3 || { left_out "all of it: no python3"; finish; }
mkdir -p "$T/drawn" && cp $F/figures.py "$T/drawn" && python3 "$T/drawn/figures.py"
for file in $F/*.svg examples/teaching/course/*.svg; do
    name=$(basename "$file")
    check "$name is listed" grep -q "/$name)\\|($name)" $F/README.md
    check "$name is XML with a title" python3 -c "
import sys, xml.etree.ElementTree as E
assert E.parse(sys.argv[1]).getroot().find('{http://www.w3.org/2000/svg}title').text" "$file"
done
for file in $F/*.svg; do
    check "$(basename "$file") is what figures.py draws" cmp -s "$file" "$T/drawn/$(basename "$file")"
done
# R mirrors L about N, and H lies halfway, in degrees from N
check "R, L, H are where they belong" python3 -c "
import re
arrows = re.findall(r'arrow\\(x, y, (-?\\d+), \\d+, .([NLRVH])', open('$F/figures.py').read())
at = {name: int(turn) for turn, name in arrows[:5]}
assert at['R'] == -at['L'] and at['H'] == (at['L'] + at['V']) / 2 and at['N'] == 0, at"
finish
