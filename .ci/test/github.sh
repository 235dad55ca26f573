#!/bin/sh
# github.sh - .github: workflows by a validator of npm; each make target, script and file that a step
# or a page names is there.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
W=.github/workflows
if there npm && npm install --silent --no-audit --no-fund --prefix "$T/npm" @action-validator/core@0.6.0 \
    @action-validator/cli@0.6.0 >"$T/log" 2>&1; then
    # its schema is older than the permission to attest, without which it takes the file
    mkdir -p "$T/all/.github/workflows"
    for f in $W/*.yml; do
        sed '/^  attestations: write$/d' "$f" >"$T/all/$f"
        check "$f" "$T/npm/node_modules/.bin/action-validator" "$T/all/$f"
    done
    sed '/runs-on/d' $W/nightly.yml >"$T/wrong.yml"
    mkdir -p "$T/.github/workflows" && mv "$T/wrong.yml" "$T/.github/workflows"
    check "the validator tells a mistake" no "$T/npm/node_modules/.bin/action-validator" \
        "$T/.github/workflows/wrong.yml"
else left_out "the validator: npm cannot fetch it"; fi
for target in $(grep -oh 'run: make [a-z]*' $W/*.yml | sed 's/.* //' | sort -u); do
    check "make $target" grep -q "^$target:" Makefile examples/products.mk
done
for page in .github/*.md; do
    for link in $(grep -oE '\]\([^)]*\)' "$page" | tr -d '])('); do
        check "$page: $link" test -e ".github/$link"
    done
done
# what a step of mingw compiles, by mingw where it is there; the scripts and files that steps name
mingw=x86_64-w64-mingw32-gcc
there $mingw || mingw=
sed -n 's/.*run: gcc \(.*\) -o [a-z_]*$/\1/p' $W/ci.yml >"$T/steps"
check "steps compile" test -s "$T/steps"
while read -r words; do
    if [ "$mingw" ]; then check "gcc $words" $mingw $words -fsyntax-only
    else left_out "gcc $words: no mingw-w64"; fi
done <"$T/steps"
for file in $(grep -oE '(tests|examples|\.ci)[/\\][A-Za-z0-9_./\\-]+' $W/*.yml | sed 's/.*yml://' | tr '\\' / | sort -u); do
    check "$file" test -e "$file"
done
# clang-cl and cl get C11 without what Microsoft's compiler lacks
if there clang; then
    check "the tests have no arrays of variable length and nothing of GNU's" clang -std=c11 -pedantic -Wvla -Wgnu \
        -Werror -fsyntax-only -I. tests/unit/*.c
fi
finish
