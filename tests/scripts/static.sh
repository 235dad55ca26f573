#!/bin/sh
# static.sh - clang-tidy (checks and reasons in .clang-tidy) and cppcheck find nothing in shade.h,
# tests and examples.  A tool that is not installed is named and left out.
cd "$(dirname "$0")/../.." || exit 1
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
passed=0 failed=0
check() {                       # name, command ...: no output but of passing is wanted
    name=$1; shift
    if ! command -v "$1" >/dev/null; then echo "left out: $name"; return; fi
    if "$@" >"$T/log" 2>"$T/errors"; then passed=$((passed + 1)); echo "ok    $name"
    else
        failed=$((failed + 1)); echo "FAIL  $name"
        cat "$T/log" "$T/errors" | grep -E '(warning|error|style|performance|portability):' |
            sort -u | head -n 20
    fi
}
# Tests and examples are read without the implementation, which has its own turn.
TESTS="tests/unit/*.c tests/golden/*.c"
EXAMPLES="examples/lessons/*.c examples/pictures/*.c examples/programs/*/*.c"
FLAGS="-std=c99 -D_DEFAULT_SOURCE -I. -DSHADE_NO_DISPATCH"
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/shade.c"
check "clang-tidy, shade.h" clang-tidy -quiet "-config-file=.clang-tidy" "$T/shade.c" -- $FLAGS
# Unit tests are one file here, because what they share is analysed once.  Of several files in one
# process clang-tidy 14 at times takes a va_list for uninitialized (LLVM bug 41311), so that each has
# its own.
printf '#include "%s"\n' "$PWD"/tests/unit/*.c >"$T/unit.c"
tidy_each() {
    printf '%s\n' "$T/unit.c" tests/golden/*.c $EXAMPLES |
        xargs -P "$(nproc 2>/dev/null || echo 1)" -I FILE clang-tidy -quiet FILE -- $FLAGS -DSHADE__IMPLEMENTED
}
if command -v clang-tidy >/dev/null; then check "clang-tidy, tests and examples" tidy_each
else echo "left out: clang-tidy, tests and examples"
fi
CPPCHECK="--std=c99 --language=c --quiet --error-exitcode=1 --inline-suppr -I. -D__GNUC__=12
    --enable=warning,performance,portability -DSHADE_NO_DISPATCH"
check "cppcheck, shade.h" cppcheck $CPPCHECK -DSHADE_IMPLEMENTATION shade.h
# tests read the floats of vectors as arrays
check "cppcheck, tests" cppcheck $CPPCHECK --suppress=objectIndex -DSHADE__IMPLEMENTED $TESTS
check "cppcheck, examples" cppcheck $CPPCHECK -DSHADE__IMPLEMENTED $EXAMPLES
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
