#!/bin/sh
# assignments.sh - the graders of the assignments: solutions get full points, starters less than
# half, and each common mistake loses points and is named by its sentence; results.json and Python.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}
A=examples/teaching/assignments
WARN="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"
${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
build() {                       # grader, answer, flags ...
    grader=$1 answer=$2; shift 2
    $CC -std=c99 -O1 $WARN "$@" -I. -DSHADE__IMPLEMENTED "$A/$grader/grade.c" "$answer" build/shade.o \
        -lm -o "$T/grade"
}
scored() {                      # the share of the points, in percent, that the last line tells
    sed -n '$s/.*: \([0-9.]*\) of \([0-9]*\) points$/\1 \2/p' "$1" | awk '{ print int(100 * $1 / $2) }'
}
run() { "$T/grade" "$@" >"$T/said" 2>&1; }
less_than_half() { ! run && [ "$(scored "$T/said")" -lt 50 ]; }
# The sentence of a mistake, of the lines of its strings in grade.c.
sentence() {
    awk -v name="{ \"$2\"," '
        index($0, name) { inside = 1; sub(/.*\{ "[a-z_]+", [a-z_]+,/, "") }
        inside { while (match($0, /"[^"]*"/)) { text = text substr($0, RSTART + 1, RLENGTH - 2)
                     $0 = substr($0, RSTART + RLENGTH) }
                 if (/}/) { print text; exit } }' "$A/$1/grade.c"
}
# A mistake loses points, and its sentence is among the sure ones.
named() {
    says=$(sentence "$1" "$2")
    [ -n "$says" ] && ! run --seed 3 --mistake "$2" && grep -vF 'perhaps:' "$T/said" | grep -qF "$says"
}

# Each "ok    lamps in front: 3 of 3" of a solution is "3 lamps in front" of the page.
page_has_points() {
    tr '\n' ' ' <"$1" >"$T/page"
    sed -n 's/^ok *\(.*\): \([0-9]*\) of .*/\2 \1/p' "$T/said" >"$T/points"
    while read -r points; do
        grep -qE "[ ;] ?$(printf '%s' "$points" | sed 's/[.|+()]/\\&/g')[;. ]" "$T/page" || return 1
    done <"$T/points"
}
# A golden picture is the right half of what the solution draws.
drawn() {
    there pngtopnm || return 0
    run --picture "$T/drawn.ppm" && pngtopnm "$1" >"$T/golden" &&
        pnmcut -left 160 -top 0 -width 160 -height 160 "$T/drawn.ppm" | pnmtopng | pngtopnm >"$T/right" &&
        cmp "$T/golden" "$T/right"
}
# The names of the mistakes of graders
mistakes() { sed -n '/\.mistakes/,/\.place/s/.*{ "\([a-z_]*\)", \1,.*/\1/p' "$@"; }

for task in "$A"/[0-9]*/; do
    task=$(basename "$task")
    check "$task: the solution compiles" build "$task" tests/assignments/solutions.c
    check "$task: full points" run
    check "$task: its page has the points" page_has_points "$A/$task/README.md"
    tolerance=$(sed -n 's/.*\.tolerance = \([0-9.e-]*[0-9]\)f*,.*/\1/p' "$A/$task/grade.c")
    check "$task: its page has the tolerance" grep -qE \
        "$([ "$tolerance" = 0 ] && echo "must be exact" || echo "off by $tolerance max")" "$T/page"
    check "$task: its page shows the picture of right answers" drawn "$A/$task/picture.png"
    check "$task: full points with other inputs" run --seed 20
    for mistake in $(mistakes "$A/$task/grade.c"); do
        check "$task: $mistake is named" named "$task" "$mistake"
    done
    check "$task: a name that is no mistake is refused" sh -c "! '$T/grade' --mistake nobody 2>/dev/null"
    check "$task: the starter compiles" build "$task" "$A/$task/starter.c"
    check "$task: a starter gets less than half" less_than_half
    check "$task: its page has the command" grep -qF "$A/$task/grade.c $A/$task/starter.c" "$A/$task/README.md"
done
check "README tells how many mistakes are known" grep -qF \
    "one of the $(mistakes $A/[0-9]*/grade.c | wc -l | tr -d ' ') that the graders know" $A/README.md
build 02_mirror tests/assignments/solutions.c
run --mistake as_printed
check "README shows what a student reads" test "$(sed -n '/^```text/,/^```$/p' $A/README.md | sed '1d;$d' | tr -s ' \n' ' ')" = \
    "$(head -n 2 "$T/said" | tr -s ' \n' ' ')"
there python3 || { left_out "results.json and grade.py: no python3"; finish; }

build 01_lambert "$A/01_lambert/starter.c"
"$T/grade" --json "$T/results.json" --picture "$T/out.ppm" >"$T/said"
check "a starter is told that its answer never changes" grep -q 'the same for every input' "$T/said"
check "results.json is Gradescope's" python3 -c "
import json, sys
tests = json.load(open(sys.argv[1]))['tests']
assert [t['max_score'] for t in tests] == [4, 4, 2] and tests[0]['score'] == 0 and tests[0]['output']
" "$T/results.json"
check "the picture is a PPM" sh -c "head -c 15 '$T/out.ppm' | grep -q '320 160'"

# Answers in C that are wrong in two ways, in no known way, not a number, and not at all.
wrong() { printf '#include "shade.h"\n#include <math.h>\n%s\n' "$2" >"$T/wrong.c" && build "$1" "$T/wrong.c" -w; }
LOBE='float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n)'
HALF='shade_vec3 halfway(shade_vec3 L, shade_vec3 V)'
wrong 03_highlight "$HALF { return shade_scale(shade_add(L, V), .5f); }
    $LOBE { return shade_blinn_phong_specular(N, L, V, n); }"
run
check "of two mistakes both are named" test "$(grep -F "$(sentence 03_highlight not_unit)" "$T/said" |
    grep -cF "$(sentence 03_highlight blinn)")" -ge 1
wrong 03_highlight "$HALF { return shade_halfway(L, V); } $LOBE { return n * shade_dot(shade_mirror(L, N), V); }"
run
check "an unknown mistake gets the hint of its case" grep -qF 'look at each by itself.' "$T/said"
wrong 01_lambert 'float lambert(shade_vec3 N, shade_vec3 L) { return sqrtf(-1 - shade_dot(N, L) * shade_dot(N, L)); }'
run
check "a NaN is explained" grep -qF 'A NaN comes from' "$T/said"
wrong 04_attenuation 'float attenuation(float a, float b, float c, float r) { return a; }'
run
check "an infinite wrong answer is not near to all" sh -c "! grep -qF '1 / (c r^2)' '$T/said'"
wrong 01_lambert 'float lambert(shade_vec3 N, shade_vec3 L) { __builtin_trap(); }'
run --json "$T/crash.json"
check "a crash leaves results" python3 -c "
import json, sys
tests = json.load(open(sys.argv[1]))['tests']
assert len(tests) == 3 and all(t['score'] == 0 and 'did not finish' in t['output'] for t in tests)
" "$T/crash.json"

# What gradescope.sh packs, where Gradescope unpacks it, with a file that a student hands in
hands_in() {                    # file, its name, a Python expression about the results r
    rm -rf "$T/gs/submission" "$T/gs/results" && mkdir -p "$T/gs/submission"
    [ -z "$1" ] || cp "$1" "$T/gs/submission/$2" || return 1
    AUTOGRADER=$T/gs sh "$T/gs/source/run_autograder" >"$T/said" 2>&1
    python3 -c "import json, sys; r = json.load(open(sys.argv[1])); assert $3, r" "$T/gs/results/results.json"
}
if there zip; then
    mkdir -p "$T/gs/source"
    check "gradescope.sh packs a task" sh $A/gradescope.sh 03_highlight 4711 "$T/gs.zip"
    python3 -m zipfile -e "$T/gs.zip" "$T/gs/source"
    check "what Gradescope starts lies at the root" test -s "$T/gs/source/setup.sh"
    check "a solution gets full points" hands_in tests/assignments/solutions.c my.c \
        "sum(t['score'] for t in r['tests']) == 10"
    check "a starter in Python gets none, and sentences" hands_in $A/03_highlight/starter.py my.py \
        "all(t['score'] == 0 and t['output'] for t in r['tests'])"
    check "what does not compile shows the compiler's words" hands_in LICENSE my.c \
        "r['score'] == 0 and 'does not compile' in r['output'] and 'error' in r['output']"
    check "Python that cannot be read says so" hands_in LICENSE my.py \
        "all('cannot be run' in t['output'] for t in r['tests'])"
    check "nothing handed in says so" hands_in "" "" "r['score'] == 0 and 'There is no' in r['output']"
    for wrong in "03_highlight x" "04_nothing 5"; do
        check "gradescope.sh refuses $wrong" sh -c "! sh $A/gradescope.sh $wrong '$T/no.zip' 2>/dev/null"
    done
else left_out "gradescope.sh: no zip"; fi

cat >"$T/answer.py" <<'END'
import math
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def lambert(N, L): return max(0, dot(N, L))
def mirror(L, N): return [2 * dot(N, L) * n - l for n, l in zip(N, L)]
def halfway(L, V):
    s = [l + v for l, v in zip(L, V)]
    d = math.sqrt(dot(s, s))
    return [x / d for x in s] if d > 1e-6 else [0, 0, 0]
def phong(N, L, V, n): return max(0, dot(mirror(L, N), V)) ** n if dot(N, L) > 0 else 0
def attenuation(a, b, c, r): return 1 / (a + b * r + c * r * r)
def spot(L, aim, cos_cutoff, e):
    c = -dot(L, aim)
    return c ** e if c >= cos_cutoff - 1e-9 else 0
def cross(a, b): return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]
def normal_matrix(m):
    x, y, z = m[0:3], m[4:7], m[8:11]
    sign = math.copysign(1, dot(x, cross(y, z)))
    return [[sign * e for e in c] for c in (cross(y, z), cross(z, x), cross(x, y))]
END
sed 's/max(0, dot(N, L))/dot(N, L)/; s/return \[2 \*/return [-2 */; s/n - l for/n + l for/' "$T/answer.py" >"$T/wrong.py"
for task in 01_lambert 02_mirror 03_highlight 04_attenuation 05_spot 06_normal_matrix; do
    build "$task" tests/assignments/solutions.c && "$T/grade" --vectors >"$T/v.json"
    check "$task in Python: full points" python3 "$A/grade.py" "$T/answer.py" "$T/v.json"
    check "$task in Python: the starter compiles and fails" \
        sh -c "! python3 '$A/grade.py' '$A/$task/starter.py' '$T/v.json' >'$T/said' && ! grep -q raises '$T/said'"
done
for task in 01_lambert:unclamped 02_mirror:as_printed; do
    build "${task%:*}" tests/assignments/solutions.c && "$T/grade" --vectors >"$T/v.json"
    python3 "$A/grade.py" "$T/wrong.py" "$T/v.json" >"$T/said"
    check "${task%:*} in Python: ${task#*:} is named" grep -qF "$(sentence "${task%:*}" "${task#*:}")" "$T/said"
done
finish
