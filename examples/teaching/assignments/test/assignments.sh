#!/bin/sh
# assignments.sh - the grader of examples/teaching/assignments: graders.py tries right answers and wrong
# ones, guards.py programs that try what they may not do; here are its pages, the steps of a student,
# and the zip for Gradescope.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
A=examples/teaching/assignments
there python3 || { left_out "all of it: no python3"; finish; }
${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
chmod 711 "$T"

# The commands of a page, and what a page shows in its block of text number $2
commands() { sed -n '/^```sh$/,/^```$/p' "$1" | grep -v '^```'; }
shown() { awk -v n="$2" '/^```/ { k += inside = /^```text/; next } inside && k == n' "$1"; }
# The same as a page's commands, in a folder with nothing but shade.h and the assignments
walk() { (cd "$T/tree" && rm -f ./*.c ./*.py && commands "$1" | sh); }
mkdir -p "$T/tree/examples/teaching" && cp shade.h "$T/tree" && cp -R $A "$T/tree/$A"
solved() {                      # a page: its commands again, the starter replaced by a solution
    commands "$1" | sed "s|^python3 .* --start \(.*\)\(\.[a-z]*\)|cp $PWD/examples/teaching/assignments/test/by_hand\2 \1\2|" >"$T/steps"
    (cd "$T/tree" && sh "$T/steps")
}
# What a starter is told: cases, what is wrong with them, points, and nothing else
told() { grep -q '^[0-9].* points$' "$T/said" && no grep -vE '^(ok  |FAIL|      |[0-9])' "$T/said"; }
# A page without its pictures, which take most of the time, and with them for Python
plain() { sed '/^python3 /s/ --picture [^ ]*//' "$1" >"$T/plain.md"; }
in_python() { sed '/^python3 .* [0-9a-z_]*\.c\>/s/\.c\>/.py/' "$1"; }

walk $A/README.md >"$T/said"
check "README shows what a starter is told" same "$(shown $A/README.md 2)" "$(cat "$T/said")"
python3 $A/grade.py 02_mirror --mistake as_printed >"$T/said"
check "README shows what a mistake is told" same "$(shown $A/README.md 1)" "$(head -n 5 "$T/said")"
check "README tells how many mistakes are known" grep -qF "one of the $(for task in $A/[0-9]*; do
    python3 $A/grade.py "${task##*/}" --mistake list 2>&1 | tr ',' '\n'; done | wc -l | tr -d ' ') that" $A/README.md
# The vectors of vectors.h beside those of shade.h, with the same numbers
for header in vectors.h shade.h; do
    check "$header: vectors and matrices compile" ${CC:-cc} -std=c99 -O1 -Wall -Wextra -Werror -I$A -I. \
        "-DHEADER=\"$header\"" examples/teaching/assignments/test/vectors.c -lm -o "$T/vectors-$header"
    "$T/vectors-$header" >"$T/$header.numbers"
done
check "vectors.h has the numbers of shade.h" python3 -c "
import sys
a, b = ([line.split() for line in open(f)] for f in sys.argv[1:])
assert len(a) == len(b) > 60 and [x[0] for x in a] == [x[0] for x in b]
for x, y in zip(a, b):
    assert all(abs(float(p) - float(q)) <= 2e-6 * max(1, abs(float(q))) for p, q in zip(x[1:], y[1:])), (x, y)
" "$T/vectors.h.numbers" "$T/shade.h.numbers"
functions() { grep -o '\bshade_[a-z0-9_]*(' "$1" | sort -u; }
check "each of its functions is tried" same "$(functions $A/vectors.h)" "$(functions examples/teaching/assignments/test/vectors.c)"
for place in $(sed -n 's/.*`>>\([a-z]*\)`.*/\1/p' $A/README.md $A/*/README.md); do
    check "shade.h has the place >>$place" grep -q "^/\*-* >>$place\$" shade.h
done
for task in $A/[0-9]*; do
    page=$task/README.md name=${task##*/}
    tr '\n' ' ' <"$page" >"$T/page"
    plain "$page"
    walk "$T/plain.md" >"$T/said" 2>&1
    check "$name: a starter in C gets points as its page says" told
    check "$name: its page says what colours mean" grep -qE 'In the picture of right answers,? [a-z]+ ' "$T/page"
    check "$name: full points after the same steps" solved "$page"
    check "$name: the picture of right answers is that of the page" python3 -c "
import sys, zlib
def rows(path):
    data = open(path, 'rb').read()
    size, at = int.from_bytes(data[data.index(b'IDAT') - 4:data.index(b'IDAT')], 'big'), data.index(b'IDAT') + 4
    width = 3 * int.from_bytes(data[16:20], 'big')
    plain, above = zlib.decompress(data[at:at + size]), bytes(width)
    for k in range(0, len(plain), width + 1):
        above = bytes((a + b) & 255 for a, b in zip(plain[k + 1:k + 1 + width], above))
        yield above
got, want = list(rows(sys.argv[1])), list(rows(sys.argv[2]))
near = lambda a, b: all(abs(x - y) <= 1 for x, y in zip(a, b))  # floats round other than doubles
assert all(map(near, got, want)) and [row[480:] for row in got] == want" "$T/tree/out.png" "$task/picture.png"
    if [ "$name" = 03_highlight ]; then     # of the other tasks graders.py has both in Python
        in_python "$page" >"$T/python.md"
        walk "$T/python.md" >"$T/said" 2>&1
        check "$name: a starter in Python gets points too" told
        check "$name: full points and a picture in Python" solved "$T/python.md"
    fi
    python3 - "$name" "$T/page" <<'END' >"$T/log" 2>&1
import sys
sys.path.insert(0, "examples/teaching/assignments")
sys.dont_write_bytecode = True
from judge.points import Task
task, page = Task(sys.argv[1]), open(sys.argv[2], encoding="utf-8").read()
assert "; ".join(f"{c.points} {c.name}" for c in task.cases) + "." in page
most = task.module.TOLERANCE
assert (f"off by {most:.0e}".replace("e-0", "e-") + " max(1, |x|)" if most else "must be exact") in page
END
    check "$name: its page has points and tolerance" test ! -s "$T/log"
done
for wrong in "01_lambert" "no_task LICENSE" "16 LICENSE" "01_lambert LICENSE --mistake half" \
    "01_lambert LICENSE --start $T/no.c"; do
    check "grade.py refuses $wrong" sh -c "python3 $A/grade.py $wrong 2>/dev/null; [ \$? -eq 2 ]"
done
python3 $A/grade.py 3 --start "$T/starter.c"
python3 $A/grade.py 3 --start "$T/starter.py"
check "what is there is no place for a starter" sh -c \
    "python3 $A/grade.py 3 --start '$T/starter.c' 2>&1 | grep -qx '$T/starter.c is not written: File exists.'"
check "without a compiler C is refused in words" sh -c \
    "CC=no_such_cc python3 $A/grade.py 3 '$T/starter.c' | grep -q 'There is no no_such_cc'"
for number in 01 1 10; do
    check "grade.py takes $number for the name of a task" python3 $A/grade.py $number examples/teaching/assignments/test/by_hand.c
done
printf '#include "shade.h"\nfloat lambert(shade_vec3 N, shade_vec3 L)\n{\n    int k;\n    return 1;\n}\n' >"$T/my own.c"
python3 $A/grade.py 01 "$T/my own.c" --json "$T/results.json" >"$T/said"
check "a warning names the student's file" grep -q '^my own.c:4:9: warning: .*k' "$T/said"
check "a warning stands in results too" grep -q 'my own.c:4:9: warning' "$T/results.json"
printf 'float lambert(shade_vec3 N, shade_vec3 L)\n{\n    return 1\n}\n' >"$T/my own.c"
python3 $A/grade.py 01 "$T/my own.c" >"$T/said"
check "an error names the student's file" grep -q '^my own.c:[34]:.*error: ' "$T/said"
check "no name of the judge stands beside an error" no grep -qE 'answer|warning|/' "$T/said"
check "a file that is not there is told" sh -c \
    "python3 $A/grade.py 01 no_such.c | grep -qx 'There is no file no_such.c.'"
check "Python needs no compiler" sh -c \
    "CC=no_such_cc python3 $A/grade.py 01_lambert examples/teaching/assignments/test/by_hand.py"

# What gradescope.sh packs, where Gradescope unpacks it, with a file that a student hands in
hands_in() {                    # file, its name, a Python expression about the tests t
    rm -rf "$T/gs/submission" "$T/gs/results" && mkdir -p "$T/gs/submission"
    [ -z "$1" ] || cp "$1" "$T/gs/submission/$2" || return 1
    AUTOGRADER=$T/gs sh "$T/gs/source/run_autograder" >"$T/said" 2>&1
    python3 -c "import json, sys; r = json.load(open(sys.argv[1])); t = r['tests']
assert $3, r" "$T/gs/results/results.json"
}
none="all(x['score'] == 0 and"
if there zip; then
    mkdir -p "$T/gs/source"
    check "gradescope.sh packs a task" sh $A/gradescope.sh 3 4711 "$T/gs.zip"
    python3 -m zipfile -e "$T/gs.zip" "$T/gs/source"
    check "what Gradescope starts lies at the root" test -s "$T/gs/source/setup.sh"
    for file in by_hand.c by_hand.py; do
        check "$file gets full points" hands_in examples/teaching/assignments/test/$file my.${file#*.} "sum(x['score'] for x in t) == 10"
    done
    check "a starter in Python gets less than half, and sentences" hands_in "$T/starter.py" my.py \
        "sum(x['score'] for x in t) < 5 and all(x['output'] for x in t if x['score'] < x['max_score'])"
    check "results have the name and the points of each case" hands_in "$T/starter.c" my.c \
        "[x['max_score'] for x in t] == [3, 1, 3, 1, 2] and t[0]['name'] == 'H'"
    check "what does not compile shows the compiler's words" hands_in LICENSE my.c \
        "$none 'does not compile' in x['output'] and 'error' in x['output'] for x in t)"
    check "Python that cannot be read says so" hands_in LICENSE my.py "$none 'cannot be read' in x['output'] for x in t)"
    check "nothing handed in says so" hands_in "" "" "$none 'there are 0' in x['output'] for x in t)"
    printf 'import os\ndef halfway(L, V):\n    os._exit(0)\n' >"$T/cheat.py"
    check "a program that ends itself leaves results" hands_in "$T/cheat.py" my.py "$none 'ended the program' in
        x['output'] or 'case' in x['output'] for x in t)"
    check "the seed stands in one file, and not in a command" same "$(grep -rl 4711 "$T/gs/source")" "$T/gs/source/seed"
    for wrong in "03_highlight x" "04_nothing 5" "judge 5" "student 5"; do
        check "gradescope.sh refuses $wrong" sh -c "! sh $A/gradescope.sh $wrong '$T/no.zip' 2>/dev/null"
    done
else left_out "gradescope.sh: no zip"; fi

# What holds a program: as root and as a user, with bubblewrap and without
guards() { python3 "$T/guarded/guards.py" "$T/guarded/assignments" "$1"; }
as_user() {
    setpriv --reuid 65534 --regid 65534 --clear-groups env -i PATH=/usr/bin:/bin ${CC:+CC="$CC"} \
        python3 "$T/guarded/guards.py" "$T/guarded/assignments" "$1"
}
mkdir "$T/guarded" && cp -R $A "$T/guarded/assignments" && cp examples/teaching/assignments/test/guards.py examples/teaching/assignments/test/by_hand.c "$T/guarded"
chmod -R a+rX "$T/guarded"
[ "$(id -u)" -eq 0 ] && who="guards as_user" || { who=guards; left_out "guards as root: this is a user"; }
for run in $who; do
    for room in plain bubblewrap; do
        if [ $room = bubblewrap ] && ! bwrap --ro-bind / / --unshare-all true 2>/dev/null; then
            left_out "guards in bubblewrap: it is not here, or may not be used"; continue
        fi
        $run $room >"$T/said" 2>&1
        check "what holds a program: $run, $room" test $? -eq 0
        grep -v passed "$T/said"
    done
done
echo 4711 >"$T/seed"
chmod 644 "$T/seed"
check "a seed that others may read is refused" sh -c \
    "python3 $A/grade.py 1 examples/teaching/assignments/test/by_hand.c --room plain --seed-file '$T/seed' 2>&1 | grep -q 'can be read by others'"
if [ "$(id -u)" -eq 0 ]; then
    check "without root and bubblewrap no seed is taken" sh -c "echo 4711 | setpriv --reuid 65534 --regid 65534 \
        --clear-groups env -i PATH=/usr/bin:/bin python3 '$T/guarded/assignments/grade.py' 1 \
        '$T/guarded/assignments/../by_hand.c' --room plain --seed-file - | grep -q 'nothing is judged with a seed'"
    check "as root one is" sh -c "echo 4711 | python3 $A/grade.py 1 examples/teaching/assignments/test/by_hand.c --room plain --seed-file -"
fi

python3 examples/teaching/assignments/test/graders.py >"$T/said" 2>&1
check "graders.py" test $? -eq 0
tail -n 60 "$T/said"
finish
