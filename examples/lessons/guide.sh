#!/bin/sh
# guide.sh [--update] - the guide's table of lessons by course: those on a course's slides, in their order, and
# those with the course's name in their first comment. Prints it, or writes it into TEACHING.md.
cd "$(dirname "$0")" || exit 1
T=$(mktemp -d) && trap 'rm -rf "$T"' EXIT
row() {                         # UW uw "UW, CSE457"
    grep -oE 'pictures/[0-9]{2}_' "../teaching/course/$2.md" | grep -oE '[0-9]{2}' | awk '!seen[$0]++' >"$T/slides"
    for lesson in [0-9]*.c; do
        sed '/\*\//q' "$lesson" | grep -qw "$1" && echo "${lesson%%_*}"
    done | grep -vxFf "$T/slides" >"$T/besides"
    echo "| $3 | $(tr '\n' ' ' <"$T/slides")| $(tr '\n' ' ' <"$T/besides")|"
}
{
    echo "| course | on its slides | besides |"
    echo "|---|---|---|"
    row UW uw "UW, CSE457"
    row Massey massey "Massey, 159.709"
    row Shirley shirley "Shirley, chapter 10"
    row Berkeley berkeley "Berkeley, CS184"
} >"$T/table"
if [ "$1" = --update ]; then
    awk -v table="$T/table" '/^\| course / { while ((getline line <table) > 0) print line; skip = 1 }
        skip && /^\|/ { next } { skip = 0; print }' TEACHING.md >"$T/guide" && cat "$T/guide" >TEACHING.md
else cat "$T/table"; fi
