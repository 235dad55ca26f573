#!/bin/sh
# readme.sh - every ```c block of README.md compiles.
# A block with main is a whole program: compiled, linked with the implementation.  Others are tried
# at file scope after the #include, then at file scope after readme_prelude.h, then inside a
# function after it.
cd "$(dirname "$0")/.." || exit 1
CC=${CC:-cc}
README=${1:-README.md}
WARN="-std=c99 -Wall -Wextra -Werror -Wno-missing-field-initializers"
FRAGMENT="$WARN -Wno-unused -Wno-unused-parameter"
[ -f "$README" ] || { echo "readme: no $README"; echo "0 passed, 1 failed"; exit 1; }
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
passed=0 failed=0

awk -v dir="$T" '
    /^[ \t]*```/ {
        if (inside) { inside = 0; close(file) }
        else if ($0 ~ /^[ \t]*```[cC][ \t]*$/) {
            inside = 1; file = sprintf("%s/block%03d.c", dir, ++n)
            print NR > (file ".line")
        } else { inside = 2; file = "/dev/null" }
        next
    }
    inside == 1 { print > file }
' "$README"

program() {                                # block
    { grep -q 'define[ \t]*SHADE_IMPLEMENTATION' "$1" || echo '#define SHADE_IMPLEMENTATION'
      grep -q 'include[ \t]*"shade.h"' "$1" || echo '#include "shade.h"'
      cat "$1"; } >"$T/program.c"
    $CC $WARN -I. "$T/program.c" -lm -o "$T/program" 2>"$T/log"
}
fragment() {                               # block; the log of the last attempt is kept
    { echo '#include "shade.h"'; cat "$1"; } >"$T/fragment.c"
    $CC $FRAGMENT -I. -fsyntax-only "$T/fragment.c" 2>/dev/null && return 0
    { echo '#include "tests/readme_prelude.h"'; cat "$1"; } >"$T/fragment.c"
    $CC $FRAGMENT -I. -fsyntax-only "$T/fragment.c" 2>"$T/log.file" && return 0
    { printf '#include "tests/readme_prelude.h"\nvoid readme_block(void)\n{\n'; cat "$1"; printf '\n}\n'
    } >"$T/fragment.c"
    $CC $FRAGMENT -I. -fsyntax-only "$T/fragment.c" 2>"$T/log"
}

for block in "$T"/block*.c; do
    [ -f "$block" ] || continue
    if grep -q 'int[ \t][ \t]*main[ \t]*(' "$block"; then program "$block"; else fragment "$block"; fi
    if [ $? = 0 ]; then passed=$((passed + 1)); continue; fi
    failed=$((failed + 1))
    echo "readme: the block at line $(cat "$block.line") of $README does not compile:"
    sed 's/^/    /;15q' "$T/log"
done
[ $((passed + failed)) -gt 0 ] || { echo "readme: no blocks of C in $README"; failed=1; }
echo "$passed passed, $failed failed"
[ $failed = 0 ]
