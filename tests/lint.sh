#!/bin/sh
# lint.sh - the house rules that a script can hold shade.h to.  Lines are laid out by hand: columns,
# tabs and trailing blanks are held here, indents by .editorconfig; no formatter keeps members in
# columns and short pairs of lines.
cd "$(dirname "$0")/.." || exit 1
H=shade.h
passed=0 failed=0
check() {                                    # what, the lines that offend
    if [ -z "$2" ]; then passed=$((passed + 1)); return; fi
    failed=$((failed + 1)); echo "lint: $1"; printf '%s\n' "$2" | head -n 12 | sed 's/^/    /'
}

C="examples/*.[ch] examples/*/*.[ch] tests/*.[ch] tests/*/*.[ch] bench/*.[ch] bench/*/*.[ch]"
check "lines within 100 columns" "$(awk 'length > 100 { print FILENAME ":" FNR ": " length " columns" }' \
    $H Makefile $C)"
check "no tabs, no trailing blanks" "$(grep -nE '	| $' $H $C)"

# contents table equals banners, in order
sed -n '/>>contents$/,/^$/p' $H | grep -oE '>>[a-z]+' | grep -v '>>contents' >/tmp/lint_contents.$$
grep -oE '^/\*-+ >>[a-z]+' $H | grep -oE '>>[a-z]+' >/tmp/lint_banners.$$
printf '>>about\n>>contents\n>>conventions\n>>model\n' | cat - /tmp/lint_banners.$$ | grep -v '>>contents' >/tmp/lint_want.$$
check "contents table equals banners" "$(diff /tmp/lint_contents.$$ /tmp/lint_want.$$)"
rm -f /tmp/lint_contents.$$ /tmp/lint_banners.$$ /tmp/lint_want.$$

check "functions of at most 80 lines" "$(awk '/^\{$/ { start = FNR } /^\}$/ && start { if (FNR - start > 80) print FNR ": " FNR - start; start = 0 }' $H)"
check "#if on compilers and targets only in >>config, >>inline and >>target" "$(awk '
    /^\/\*-+ >>/ { section = $2 }
    /^#[ \t]*(if|ifdef|ifndef|elif)/ && section !~ /^>>(config|inline|target)$/ &&
        !/SHADE_H$|SHADE_IMPLEMENTATION|SHADE__IMPLEMENTED|SHADE_NO_STDIO|__cplusplus/ { print FNR ": " $0 }' $H)"
check "no forward declarations of private functions" "$(grep -nE '^static [^=]*\);$' $H)"
check "every source key stands in >>refs" "$(grep -oE '\[[A-Z][A-Za-z]+[0-9]+\]' $H | sort -u | while read -r k; do
    sed -n '/>>refs$/,$p' $H | grep -qF "$k" || echo "$k"; done)"
check "every reference is used" "$(sed -n '/>>refs$/,$p' $H | grep -oE '^ +\[[A-Za-z0-9]+\]' | tr -d ' ' | while read -r k; do
    [ "$(grep -cF "$k" $H)" -gt 1 ] || echo "$k"; done)"
check "a comment above every public declaration, or beside it" "$(awk '
    /^#ifdef SHADE_IMPLEMENTATION/ { exit }
    /^SHADEDEF .*\(/ && !/\/\*/ && prev !~ /\*\/$|^SHADEDEF |^ .*\);$|^(typedef|#if)/ { print FNR ": " $0 }
    NF { prev = $0 } !NF { prev = "" }' $H)"
if command -v clang >/dev/null; then
    check "no comma expressions but in the head of a for" "$(
        clang -std=c99 -Wcomma -fsyntax-only -DSHADE_IMPLEMENTATION -x c $H 2>&1 | grep Wcomma)"
else echo "left out: comma expressions (no clang)"; fi
if command -v gcc >/dev/null && ctags --version 2>/dev/null | grep -q Universal; then
    gcc -std=c99 -w -fsyntax-only -aux-info /tmp/lint_aux.$$ -DSHADE_IMPLEMENTATION -x c $H
    sed -n 's/ (.*//; s|^/\* shade.h:[0-9]*:.F .*[ *]||p' /tmp/lint_aux.$$ | sort -u >/tmp/lint_functions.$$
    ctags -x $H | awk '$2 == "function" { print $1 }' | sort -u | cat - /tmp/lint_functions.$$ | sort | uniq -u |
        grep -vE '_(any|avx2|avx512|fn|pick)$' >/tmp/lint_missed.$$    # those of SHADE__DISPATCH
    check "ctags sees every function" "$(cat /tmp/lint_missed.$$)"
    rm -f /tmp/lint_aux.$$ /tmp/lint_functions.$$ /tmp/lint_missed.$$
else echo "left out: ctags (no gcc or no Universal Ctags)"; fi
# but for the program in the comment at its top
check "no heap, no exit, no print" "$(sed '1,/^#ifndef SHADE_H/s/.*//' $H | grep -nE '\b(malloc|calloc|realloc|free|exit|abort|printf|fprintf|puts)[ ]*\(')"

check "every file of tests stands in tests/README.md" "$(for file in tests/*.c tests/*.sh; do
    grep -qF "\`${file#tests/}\`" tests/README.md || echo "$file"; done)"
check "tests/README.md speaks of files that are there, in 40 lines" "$(
    grep -oE '`[a-z_]+\.[a-z]+`' tests/README.md | tr -d '`' | sort -u | while read -r file; do
        [ -e "tests/$file" ] || [ -e "$file" ] || echo "$file"; done
    awk 'END { if (NR > 40) print NR " lines" }' tests/README.md)"
if command -v python3 >/dev/null; then
    check "entries of mutation.txt are current" "$(
        python3 tests/mutate.py --check $H tests/mutation.txt 2>&1 | grep -v '^[0-9]* entries$')"
else echo "left out: entries of mutation.txt (no python3)"; fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
