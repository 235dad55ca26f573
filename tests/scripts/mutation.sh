#!/bin/sh
# mutation.sh [mutants [seed [commit | >>section ...]]] - small changes of shade.h, one at a time: do
# the tests notice?  With a commit only the functions are changed that have changed since then, with
# words like ">>camera shade__reduce" those of the sections, or the functions, of these names.
# Not counted: what does not compile, what compiles to the same code (gcc -O2 -S), and what
# tests/scripts/mutation.txt shows to be equivalent.  Needs gcc and python3.
cd "$(dirname "$0")/../.." || exit 1
want=${1:-200} seed=${2:-$(date +%s)} since=${3:-}
H=$PWD
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
for tool in gcc python3; do
    command -v $tool >/dev/null || { echo "left out: no $tool"; exit 0; }
done
echo "seed $seed"
python3 tests/scripts/mutate.py --check shade.h tests/scripts/mutation.txt || exit 1
if [ -n "$since" ] && ! git rev-parse -q --verify "$since^{commit}" >/dev/null; then
    awk -v words=" $since " '
        match($0, />>[a-z]+$/) && /^\/\*--/ { section = substr($0, RSTART) }
        /^[A-Za-z]/ { name = $0; sub(/\(.*/, "", name); sub(/.*[ *]/, "", name) }
        index(words, " " section " ") || index(words, " " name " ") { print NR, 1 }' shade.h >"$T/lines"
    [ -s "$T/lines" ] || { echo "shade.h has no section or function $since"; exit 1; }
elif [ -n "$since" ]; then
    git diff -U0 "$since" -- shade.h |
        sed -nE 's/^@@ [^+]*\+([0-9]+)(,([0-9]+))? @@.*/\1 \3/p' |
        awk '{ print $1, (NF > 1 ? $2 : 1) }' >"$T/lines"
    [ -s "$T/lines" ] || { echo "nothing has changed since $since"; exit 0; }
fi
python3 tests/scripts/mutate.py shade.h "$seed" $((want * 2)) "$T" ${since:+"$T/lines"} || exit 1

printf '#include "%s"\n' "$H"/tests/unit/*.c >"$T/tests.c"
# Mutants of the implementation are linked to tests compiled once; of inline functions, to all.
FLAGS="-std=c99 -w -D_DEFAULT_SOURCE -DSHADE_NO_DISPATCH -include $H/tests/unit/count.h"
gcc $FLAGS -O2 -I. -DSHADE__IMPLEMENTED -c "$T/tests.c" -o "$T/tests.o" || exit 1
build() {                       # the folder of a shade.h, public or implementation
    if [ "$2" = public ]; then gcc $FLAGS -O1 -I"$1" -I. "$T/tests.c" -lm -o "$T/run"
    else
        gcc $FLAGS -O1 -DSHADE_IMPLEMENTATION -x c -c "$1/shade.h" -o "$T/shade.o" &&
            gcc "$T/tests.o" "$T/shade.o" -lm -o "$T/run"
    fi
}
assembly() {                    # the folder of a shade.h, public or implementation
    if [ "$2" = public ]; then (gcc $FLAGS -O2 -S -I"$1" -I. "$T/tests.c" -o -)
    else (cd "$1" && gcc $FLAGS -O2 -S -DSHADE_IMPLEMENTATION -x c shade.h -o -); fi |
        grep -v '\.file\|\.ident' | md5sum
}
first() {                       # sections of the tests that know a section of shade.h best
    case $1 in
    math) echo math matrix ;; matrix) echo matrix ;; power) echo math light ;;
    base) echo math lanes store ;; pixels | store) echo store resolve texture ;;
    lamps | terms) echo light lanes ;; lit) echo lanes light ;; vertices) echo vertex clip ;;
    triangles) echo packets depth cover ;; clip) echo clip depth ;;
    tiles) echo work cover ;; cover) echo work cover depth fragment ;; fragments) echo packets fragment store ;;
    texture) echo texture ;; check) echo drive ;; drive) echo drive resolve ;;
    mesh) echo mesh texture shaders ;; lines) echo lines ;; shape) echo shape ;;
    camera) echo camera ray ;; chunks) echo chunks ;; rays) echo ray camera ;;
    survey | explain) echo explain ;; replay) echo explain_pipelines ;;
    image) echo resolve texture drive store ;;
    esac
}

tight() { sed "s/^\([-+]\)/\1:/" "$1" | tr -d " \n"; }
# an entry of mutation.txt: the reason after #, then the line before after - and the one after +,
# either continued on lines that begin with a blank; >>name is the section they stand in
awk '/^#/ || /^$/ { next }
     /^>>/ { section = $0; next }
     /^-/ { if (entry) print entry; entry = section "-:" substr($0, 2); next }
     /^\+/ { entry = entry "+:" substr($0, 2); next }
     { entry = entry $0 }
     END { print entry }' tests/scripts/mutation.txt | tr -d ' ' >"$T/listed"
mkdir "$T/plain" && cp shade.h "$T/plain/"
build "$T/plain" implementation || exit 1
"$T/run" --stop >"$T/log" 2>&1 || { cat "$T/log"; exit 1; }
# processor seconds: what runs twice as long does not end
limit=$(awk '/seconds of processor time/ { print int(2 * $1) + 5 }' "$T/log")
killed=0 survived=0 same=0 listed=0 broken=0 n=0
while [ $((killed + survived)) -lt "$want" ] && [ -f "$T/$n.h" ]; do
    read -r part section <"$T/$n.where"
    rm -rf "$T/mutant" && mkdir "$T/mutant" && mv "$T/$n.h" "$T/mutant/shade.h"
    if tight "$T/$n.diff" | grep -qxFf - "$T/listed"; then listed=$((listed + 1))
    elif ! build "$T/mutant" "$part" >/dev/null 2>&1; then broken=$((broken + 1))
    elif ! (ulimit -t "$limit"; "$T/run" --stop $(first "$section")) >"$T/log" 2>&1; then
        killed=$((killed + 1))
        [ -z "${MUTATION_VERBOSE:-}" ] || { cat "$T/$n.diff"; tail -n 1 "$T/log"; }
    else
        [ -f "$T/$part.s" ] || assembly "$T/plain" "$part" >"$T/$part.s"
        if assembly "$T/mutant" "$part" | cmp -s - "$T/$part.s"; then same=$((same + 1))
        else survived=$((survived + 1)); echo "survived:"; cat "$T/$n.diff"; fi
    fi
    n=$((n + 1))
done
echo "not counted: $broken do not compile, $same compile to the same code, $listed listed"
echo "$killed killed, $survived survived of $((killed + survived)) (seed $seed)"
[ $((survived * 20)) -lt $((killed + survived)) ]
