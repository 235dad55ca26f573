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
    check "make $target" grep -q "^$target:" Makefile
done
for page in .github/*.md; do
    for link in $(grep -oE '\]\([^)]*\)' "$page" | tr -d '])('); do
        check "$page: $link" test -e ".github/$link"
    done
done
# the step of mingw and Unix, as it stands
step=$(sed -n 's/.*run: \(gcc .*test_main\)$/\1/p' $W/ci.yml)
check "a step of ci.yml compiles" sh -c "$(echo "$step" | sed "s,-o test_main,-fsyntax-only,")"
finish
