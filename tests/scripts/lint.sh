#!/bin/sh
# lint.sh [--update] - the house rules that a script can hold.  make format lays out the files that
# it names; elsewhere columns, tabs and trailing blanks are held here, indents by .editorconfig.
# --update writes the line numbers of the banners into the contents table of shade.h, and ends.
cd "$(dirname "$0")/../.." || exit 1
H=shade.h
# shade.h, its contents table with the line numbers of the banners
numbered() {
    awk 'NR == FNR { if (/^\/\*-+ >>/) line[$2] = FNR; next }
        />>contents$/ { inside = 1 }
        !NF { inside = 0 }
        inside {
            rest = $0; done = ""
            while (match(rest, />>[a-z]+ +[0-9]+/)) {
                entry = substr(rest, RSTART, RLENGTH); tag = entry; sub(/ .*/, "", tag)
                done = done substr(rest, 1, RSTART - 1) sprintf("%s%" (RLENGTH - length(tag)) "d", tag, line[tag])
                rest = substr(rest, RSTART + RLENGTH)
            }
            $0 = done rest
        }
        { print }' $H $H
}
if [ "$1" = --update ]; then
    numbered >/tmp/lint_numbered.$$ && cat /tmp/lint_numbered.$$ >$H && rm /tmp/lint_numbered.$$
    exit
fi
passed=0 failed=0
check() {                                    # what, the lines that offend
    if [ -z "$2" ]; then passed=$((passed + 1)); return; fi
    failed=$((failed + 1)); echo "lint: $1"; printf '%s\n' "$2" | head -n 12 | sed 's/^/    /'
}

C="examples/*/*.[ch] examples/*/*/*.[ch] examples/*/*/*/*.[ch] .ci/test/*.[ch] tests/*/*.[ch] bench/*.[ch] bench/*/*.[ch]"
check "lines within 100 columns" "$(awk 'length > 100 { print FILENAME ":" FNR ": " length " columns" }' \
    $H Makefile examples/products.mk $C)"
check "no tabs, no trailing blanks" "$(grep -nE '	| $' $H $C)"

# contents table equals banners, in order
sed -n '/>>contents$/,/^$/p' $H | grep -oE '>>[a-z]+' | grep -v '>>contents' >/tmp/lint_contents.$$
grep -oE '^/\*-+ >>[a-z]+' $H | grep -oE '>>[a-z]+' >/tmp/lint_banners.$$
printf '>>about\n>>contents\n>>conventions\n>>model\n' | cat - /tmp/lint_banners.$$ | grep -v '>>contents' >/tmp/lint_want.$$
check "the contents table has the banners' lines (sh tests/scripts/lint.sh --update)" "$(numbered | diff $H -)"
check "contents table equals banners" "$(diff /tmp/lint_contents.$$ /tmp/lint_want.$$)"
rm -f /tmp/lint_contents.$$ /tmp/lint_banners.$$ /tmp/lint_want.$$

check "a banner ends in the tag of the next, with a blank line before it" "$(awk '
    /^\/\*-+ >>/ {
        if (before != "") print FNR ": no blank line before " $2
        if ($2 == ">>refs") exit
        if (want != "" && want != $2) print FNR ": the banner before names " want ", this is " $2
        want = ""; open = 1
    }
    open && /\*\/$/ { n = split($0, word, " "); want = word[n - 1]; open = 0 }
    { before = $0 }' $H)"
check "at least 8 % of the implementation is air" "$(awk '
    /^#ifdef SHADE_IMPLEMENTATION/ { inside = 1 }
    !inside { next }
    / >>refs$/ { exit }
    { lines++; blank += !NF }
    END { if (blank < 0.08 * lines) print blank " blank lines of " lines }' $H)"
check "no blank line after the declarations of a function: blank lines stand between steps" "$(awk '
    BEGIN { type = "^    (const|static|unsigned|int|float|double|u?int[0-9]+_t|size_t|ptrdiff_t|long|char|shade_[a-z0-9_]+|SHADE_ALIGNED) " }
    /^\{$/ { head = 1; next }
    head && !NF && declared { print FNR ": blank" }
    head && $0 !~ type && !(declared && /^     /) { head = declared = 0 }
    head { declared = 1 }' $H)"
check "the first struct within the first 285 lines" "$(awk '
    /^typedef struct/ { if (FNR > 285) print FNR ": " $0; exit }' $H)"
check "sections of at most 450 lines" "$(awk '
    /^\/\*-+ >>/ { if (tag && FNR - start > 450) print start ": " tag " has " FNR - start; tag = $2; start = FNR }' $H)"
check "functions of at most 80 lines" "$(awk '/^\{$/ { start = FNR } /^\}$/ && start { if (FNR - start > 80) print FNR ": " FNR - start; start = 0 }' $H)"
check "#if on compilers and targets only in >>config, >>plumbing and >>machine" "$(awk '
    /^\/\*-+ >>/ { section = $2 }
    /^#[ \t]*(if|ifdef|ifndef|elif)/ && section !~ /^>>(config|plumbing|machine)$/ &&
        !/SHADE_H$|SHADE_IMPLEMENTATION|SHADE__IMPLEMENTED|SHADE_NO_STDIO|SHADE_NO_EXPLAIN|__cplusplus/ { print FNR ": " $0 }' $H)"
check "forward declarations of private functions only in >>state" "$(awk '
    /^\/\*-+ >>/ { section = $2 }
    /^static [^=]*\);$/ && section != ">>state" { print FNR ": " $0 }' $H)"
check "every source key stands in >>refs" "$(grep -oE '\[[A-Z][A-Za-z]+[0-9]+\]' $H | sort -u | while read -r k; do
    sed -n '/>>refs$/,$p' $H | grep -qF "$k" || echo "$k"; done)"
check "every reference is used" "$(sed -n '/>>refs$/,$p' $H | grep -oE '^ +\[[A-Za-z0-9]+\]' | tr -d ' ' | while read -r k; do
    [ "$(grep -cF "$k" $H)" -gt 1 ] || echo "$k"; done)"
check "a comment above every public declaration, or beside it" "$(awk '
    /^#ifdef SHADE_IMPLEMENTATION/ { exit }
    /^SHADEDEF .*\(/ && !/\/\*/ && prev !~ /\*\/$|^SHADEDEF |^ .*\);$|^(typedef|#if)/ { print FNR ": " $0 }
    NF { prev = $0 } !NF { prev = "" }' $H)"
check "lessons of fewer than 80 lines" "$(wc -l examples/lessons/[0-9]*.c |
    awk '$1 >= 80 && $2 != "total" { print $2 ": " $1 " lines" }')"
# but for the choice of a processor's build and of copies, which bench measures one by one
check "no private name of shade.h in examples and bench" "$(
    grep -rnIE --exclude-dir=test '\b(shade|SHADE)__[A-Za-z]' examples bench | grep -vE '^bench/(level.h:.*#define SHADE__LEVEL |run.sh:.*-DSHADE__SPECIALIZE=)')"
if command -v clang >/dev/null; then
    check "no comma expressions but in the head of a for" "$(
        clang -std=c99 -Wcomma -fsyntax-only -DSHADE_IMPLEMENTATION -x c $H 2>&1 | grep Wcomma)"
    # examples with what libraries add to them, where those are installed; one needs a file that is made
    mkdir -p /tmp/lint_include.$$ && : >/tmp/lint_include.$$/teapot_table.h
    flags="-std=gnu99 -Wno-everything -Wcomma -fsyntax-only -I. -DSHADE__IMPLEMENTED"
    has() { echo | clang -fsyntax-only -include "$1" -x c - 2>/dev/null && flags="$flags $2"; }
    has stb/stb_image_write.h -DMODEL_STB
    has assimp/cimport.h -DMODEL_ASSIMP
    has SDL2/SDL.h "-DVIEW_SDL -isystem /usr/include/SDL2"
    has sixel/sixel.h -DVIEW_SIXEL
    check "no comma expressions in examples but in the head of a for" "$(
        clang $flags -I/tmp/lint_include.$$ -x c $(find examples -name '*.c') \
            examples/shared/recipes.h examples/teaching/playground/libc.h 2>&1 | grep Wcomma)"
    rm -rf /tmp/lint_include.$$
    # Where a header is missing clang reads no further.
    for file in tests/*/*.c bench/*.c; do
        clang -std=c99 -w -Wcomma -fsyntax-only -I. $file 2>&1
    done >/tmp/lint_clang.$$
    check "none in tests and bench either" "$(
        grep Wcomma /tmp/lint_clang.$$ | grep -E '^(\./)?(tests|bench)/' | grep -v '/\.\./' | sort -u)"
    echo "left out: comma expressions of $(grep -c 'fatal error' /tmp/lint_clang.$$) files without their headers"
    rm -f /tmp/lint_clang.$$
else echo "left out: comma expressions (no clang)"; fi
if command -v gcc >/dev/null && ctags --version 2>/dev/null | grep -q Universal; then
    gcc -std=c99 -w -fsyntax-only -aux-info /tmp/lint_aux.$$ -DSHADE_IMPLEMENTATION -DSHADE__ASK_PROCESSOR -x c $H
    sed -n 's/ (.*//; s|^/\* shade.h:[0-9]*:.F .*[ *]||p' /tmp/lint_aux.$$ | sort -u >/tmp/lint_functions.$$
    ctags -x $H | awk '$2 == "function" { print $1 }' | sort -u | cat - /tmp/lint_functions.$$ | sort | uniq -u |
        grep -vE '_(any|sse41|avx2|avx512)$' >/tmp/lint_missed.$$    # made by SHADE__DISPATCH of name_body
    check "ctags sees every function" "$(cat /tmp/lint_missed.$$)"
    rm -f /tmp/lint_aux.$$ /tmp/lint_functions.$$ /tmp/lint_missed.$$
else echo "left out: ctags (no gcc or no Universal Ctags)"; fi
# but for the program in the comment at its top
# names of shade.h that proofs speak of: a place stands in it once, and the drivers compile
check "places of tests/prove/known.txt stand in shade.h once" "$(sed -n 's/^\[[a-z]*\] //p' tests/prove/known.txt | sort -u |
    while read -r place; do
        [ "$(grep -cF -- "$place" $H)" -eq 1 ] || echo "$place"
    done)"
builtins=$(mktemp -d)
printf 'int Frama_C_interval(int, int);\nfloat Frama_C_float_interval(float, float);\n' >"$builtins/__fc_builtin.h"
check "the drivers of tests/prove compile" "$(sed -n 's/^#ifdef PROVE_//p' tests/prove/*.c | while read -r driver; do
    ${CC:-cc} -std=c99 -w -fsyntax-only -I. -I"$builtins" "-DPROVE_$driver" -DPROVE_HEADER='"shade.h"' \
        "$(grep -lx "#ifdef PROVE_$driver" tests/prove/*.c)" 2>&1
done)"
rm -rf "$builtins"

check "no heap, no exit, no print" "$(sed '1,/^#ifndef SHADE_H/s/.*//' $H | grep -nE '\b(malloc|calloc|realloc|free|exit|abort|printf|fprintf|puts)[ ]*\(')"

check "every file of tests stands in tests/README.md" "$(for file in tests/unit/*.c tests/scripts/*.sh; do
    grep -qF "\`${file##*/}\`" tests/README.md || echo "$file"; done)"
P="tests/README.md tests/CALLS.md tests/CHANGING.md"
check "the pages of tests speak of files and names that are there" "$(
    grep -ohE '`[a-z_/]+\.[a-z]+`' $P | tr -d '`' | sort -u | while read -r file; do
        [ -e "tests/unit/$file" ] || [ -e "tests/scripts/$file" ] || [ -e "tests/$file" ] || [ -e "$file" ] || echo "$file"; done
    grep -ohE '`[A-Za-z0-9]+_[A-Za-z0-9_]*`' $P | tr -d '`' | sort -u | while read -r name; do
        grep -qwF "$name" $H tests/*/*.[ch] || echo "$name"; done
    grep -ohE '>>[a-z]+' $P | sort -u | while read -r place; do
        grep -qE "^/\*-+ $place\$" $H || echo "$place"; done)"
check "tests/README.md is one screen and a table" "$(sed '/^|/d' tests/README.md | awk 'END { if (NR > 30) print NR " lines" }')"

# The guarantees of tests/GUARANTEES.md, and the numbers that tests carry: a comment above a TEST, a line of a script
grep -oE '^\* \*\*G[0-9]+' tests/GUARANTEES.md | grep -oE 'G[0-9]+' | sort >/tmp/lint_promised.$$
awk '/^\/\* G[0-9]+(, G[0-9]+)* \*\/$/ { mark = $0; next }
     mark && /^TEST\(/ { print mark }
     { mark = "" }' tests/unit/*.c >/tmp/lint_marks.$$
grep -hE '^ *# G[0-9]+(, G[0-9]+)*$' tests/scripts/*.sh >>/tmp/lint_marks.$$
grep -oE 'G[0-9]+' /tmp/lint_marks.$$ | sort -u >/tmp/lint_held.$$
check "the guarantees have different numbers" "$(uniq -d /tmp/lint_promised.$$)"
check "every guarantee has a test" "$(comm -23 /tmp/lint_promised.$$ /tmp/lint_held.$$)"
check "tests carry numbers of guarantees" "$(comm -13 /tmp/lint_promised.$$ /tmp/lint_held.$$)"
check "a number stands in a line of its own directly above a TEST" "$(awk '
    FNR == 1 && mark { print mark; mark = "" }
    mark && !/^TEST\(/ { print mark }
    { mark = /^ *\/\* *G[0-9]/ ? FILENAME ":" FNR ": " $0 : "" }' tests/unit/*.c)"
rm -f /tmp/lint_promised.$$ /tmp/lint_marks.$$ /tmp/lint_held.$$
# Relative clauses in place of nouns, in the comments and sentences of shade.h and in README.md: the
# most that each word may stand there, half of its count before 1.3
tics="10 whose|5 those of|5 that of|5 so many|5 where no|4 nobody|4 what is|3 asks|7 whatever"
check "words that stand for nouns" "$(
    { cat README.md; sed -n '/\/\*/,/\*\//p; /^ *".*"/p' $H; } | tr -s ' \n' ' ' >/tmp/lint_text.$$
    echo "$tics" | tr '|' '\n' | while read -r most words; do
        n=$(grep -oiw "$words" /tmp/lint_text.$$ | wc -l)
        [ "$n" -le "$most" ] || echo "\"$words\" $n times, $most allowed"
    done
    rm -f /tmp/lint_text.$$)"
if clang-format --version 2>/dev/null | grep -q 'version 14\.'; then
    check "what make format lays out" "$(${MAKE:-make} -s format-check 2>&1 | grep 'error:')"
else echo "left out: what make format lays out (no clang-format 14)"; fi
if git cat-file -e fe84f40 2>/dev/null; then
    check "titles of commits of at most 72 characters" "$(git log --format='%s' fe84f40.. | awk 'length > 72')"
else echo "left out: titles of commits (no history)"; fi
if command -v python3 >/dev/null; then
    check "no part of shade.h names what stands in a later part" "$(
        python3 tests/scripts/halves.py $H 2>&1)"
    check "entries of mutation.txt are current" "$(
        python3 tests/scripts/mutate.py --check $H tests/scripts/mutation.txt 2>&1 | grep -v '^[0-9]* entries$')"
else echo "left out: the parts of shade.h, entries of mutation.txt (no python3)"; fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
