#!/bin/sh
# coverage.sh - lines and branches of shade.h that tests and numbered examples reach, by gcov.
# Counted once each: hot loops are built for one processor here, inline functions are not inlined,
# and assertions (SHADE_ASSERT) are no branches.  A branch is a side of a condition of the source.
# tests/scripts/coverage.txt names what cannot be reached, with the reason.  All else is reached.
# Needs gcc, gcov and python3.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
H=$PWD
for tool in gcc gcov python3; do
    command -v $tool >/dev/null || { echo "left out: no $tool"; exit 0; }
done
FLAGS="-std=c99 -D_DEFAULT_SOURCE -w -O0 --coverage -fprofile-filter-files=shade\.h$ -Dalways_inline=unused -DSHADE__AS_COMPILED"

# An option build: its folder, its options, then the sections to run ("": all).
build() {
    dir=$T/$1 options=$2; shift 2
    mkdir "$dir" && cd "$dir" || exit 1
    printf '#include "%s"\n' "$H"/tests/unit/*.c >run.c    # one file: inline functions count once
    gcc $FLAGS '-DSHADE_ASSERT(x)=((void)0)' $options -I"$H" run.c -lm -o run || exit 1
    for section in "$@"; do
        # option builds draw with fewer lanes: what they must do is the business of make test
        (cd "$H" && "$dir/run" $section 2>&1 | tail -n 1 | sed "s|^|${dir##*/} $section: |")
    done
}
examples() {
    mkdir "$T/examples" && cd "$T/examples" || exit 1
    gcc $FLAGS '-DSHADE_ASSERT(x)=((void)0)' -DSHADE_NO_DISPATCH -DSHADE_IMPLEMENTATION \
        -x c -c "$H/shade.h" -o shade.o || exit 1
    for f in "$H"/examples/lessons/[0-9]*.c; do
        name=$(basename "$f" .c) before="-include $one_sample"
        among "$name" "$alone" && before=
        gcc $FLAGS $before -DSHADE_NO_DISPATCH -DSHADE__IMPLEMENTED -I"$H" "$f" shade.o \
            -lm -o "$name" || exit 1
        (cd "$H" && "$T/examples/$name" "$T/picture.ppm" >/dev/null) || exit 1
    done
    echo "examples: $(ls "$H"/examples/lessons/[0-9]*.c | wc -l) drawn"
}

# every level of the dispatch in turn, whatever this processor has: the bodies are plain at -O0
echo 'static int cover_level(void) { static int n; return n++ % 4; }' >"$T/level.h"
build plain -DSHADE_NO_DISPATCH ""
build small \
    "-DSHADE_LANES=16 -DSHADE_MAX_VARYINGS=12 -DSHADE__LEVEL=cover_level() -include $T/level.h" \
    lanes fragment drive mesh texture scene
build freestanding -DSHADE_NO_LIBM math light mesh
examples

cd "$T" || exit 1
for gcda in */*.gcda; do
    (cd "$(dirname "$gcda")" && gcov -b --json-format -t "$(basename "$gcda")") >"$gcda.json" \
        2>/dev/null
done
cat >merge.py <<'E2'
import json, sys
header, reasons, files = sys.argv[1], sys.argv[2], sys.argv[3:]
source = open(header).read().split("\n")
tight = lambda text: "".join(text.split())
hits, sides = {}, {}        # line -> count; (line, branches of the line, place) -> count
for name in files:
    for f in json.load(open(name))["files"]:
        if not f["file"].endswith("shade.h"): continue
        for line in f["lines"]:
            n, branches = line["line_number"], line["branches"]
            hits[n] = hits.get(n, 0) + line["count"]
            for k, b in enumerate(branches):
                key = (n, len(branches), k)
                sides[key] = sides.get(key, 0) + b["count"]
excused = {}
for text in open(reasons).read().split("\n"):
    if text and not text.startswith("#"): excused[tight(text)] = 0
def reason(n):
    for text in excused:
        if text in tight(source[n - 1]):
            excused[text] += 1
            return True
    return False
lines = [n for n in sorted(hits) if hits[n] == 0]
branches = [k for k in sorted(sides) if sides[k] == 0 and hits[k[0]]]
missing = [n for n in lines if not reason(n)]
untaken = [k for k in branches if not reason(k[0])]
for n in missing: print("line   %5d  %s" % (n, source[n - 1].strip()))
for n, count, k in untaken:
    print("branch %5d  %d of %d  %s" % (n, k + 1, count, source[n - 1].strip()))
stale = [text for text in excused if not excused[text]]
for text in stale: print("reached after all, or gone: %s" % text)
asserts = sum("SHADE_ASSERT(" in s and "define" not in s for s in source)
print("excluded: %d lines and %d branches named in tests/scripts/coverage.txt, %d assertions" % (
    len(lines) - len(missing), len(branches) - len(untaken), asserts))
total, all_sides = len(hits) - len(lines) + len(missing), len(sides) - len(branches) + len(untaken)
print("lines %d of %d, branches %d of %d" % (
    len(hits) - len(lines), total, len(sides) - len(branches), all_sides))
sys.exit(bool(stale or missing or untaken))
E2
python3 merge.py "$H/shade.h" "$H/tests/scripts/coverage.txt" */*.json
