#!/bin/sh
# figures.sh - figures to take along: each is listed with its caption, is XML with a title, and those that
# figures.py draws are what it draws.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
F=examples/teaching/figures
there python3 || { left_out "all of it: no python3"; finish; }
mkdir -p "$T/drawn" "$T/playground" && cp $F/figures.py "$T/drawn" && cp examples/teaching/letters.py "$T" &&
    cp examples/teaching/playground/math.js "$T/playground" && python3 "$T/drawn/figures.py"
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
# all of them to take along: black on white, in the letters of a course
has() { grep -qE "<text[^>]*>$2" "$T/$1/$3"; }
for course in uw massey shirley berkeley; do
    check "figures for $course" python3 $F/figures.py "$T/$course" $course
    check "$course: all that the page lists" same "$(find "$T/$course" -name '*.svg' | wc -l | tr -d ' ')" \
        "$(grep -c 'includegraphics' $F/README.md)"
    check "$course: black, greys and white" same "$(cat "$T/$course"/*.svg | grep -oE '#[0-9a-fA-F]{3,6}\b' |
        grep -vE '^#(..)\1\1$|^#(.)\2\2$')" ""
    check "$course: not dark where pages are" no grep -l prefers-color-scheme "$T/$course"/*.svg
    for file in "$T/$course"/*.svg; do
        check "$course: $(basename "$file") is XML" python3 -c \
            "import sys, xml.etree.ElementTree as E; E.parse(sys.argv[1])" "$file"
    done
done
check "UW has N" has uw 'N<' setup.svg
check "Massey has l" has massey 'l<' vectors.svg
check "Massey has alpha for n" has massey 'α = 50<' lobes.svg
check "Shirley has e for V" has shirley 'e<' vectors.svg
check "Shirley has sigma for phi" has shirley 'σ<' vectors.svg
check "Shirley has c_p for k_s" grep -q 'mirrored: c<tspan[^>]*>p<' "$T/shirley/interface.svg"
check "no V is left to Shirley" no grep -lE '<text[^>]*>V<' "$T/shirley/vectors.svg" "$T/shirley/setup.svg"
check "R of red stays" has shirley 'R<' spectrum.svg
check "V of the view stays" has shirley 'V<' spaces.svg
# R mirrors L about N, and H lies halfway, in degrees from N
check "R, L, H are where they belong" python3 -c "
import re
arrows = re.findall(r'arrow\\(x, y, (-?\\d+), \\d+, .([NLRVH])', open('$F/figures.py').read())
at = {name: int(turn) for turn, name in arrows[:5]}
assert at['R'] == -at['L'] and at['H'] == (at['L'] + at['V']) / 2 and at['N'] == 0, at"
finish
