#!/bin/sh
# sizes.sh - the bytes and kilobytes that bench/README.md states are those that bench/size.sh prints,
# within 3 %.  They are those of gcc 12 on x86-64: elsewhere nothing is compared.
cd "$(dirname "$0")/../.." || exit 1
CC=${CC:-cc}
if [ "$(uname -m)" != x86_64 ] || ! $CC --version | head -n 1 | grep -qE '^(gcc|cc).* 12\.'; then
    echo "left out: the sizes are those of gcc 12 on x86-64"
    echo "0 passed, 0 failed"
    exit
fi
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT
BUILD=$T sh bench/size.sh bytes >"$T/now" || exit 1

# a row's name is what stands before its first number
awk -F' *\\| *' '
    function near(a, b) { return a - b <= 0.03 * b + 0.05 && b - a <= 0.03 * b + 0.05 }
    /^\|[ -]/ && NF > 5 {
        for (first = 2; first < NF && $first !~ /^[0-9.]+$/; first++) ;
        name = $2
        if (first >= NF) next
        if (FILENAME ~ /now$/) {
            rows++
            for (k = first; k < NF && $k != ""; k++) now[name, k] = $k
            known[name] = first
        } else if (name in known) {
            found++
            bad = 0
            for (k = first; k < NF; k++)
                if ((name, k) in now && !near($k, now[name, k])) bad = $k " is " now[name, k]
            if (bad == 0) passed++
            else { failed++; print "bench/README.md: " name ": " bad }
        }
    }
    END {
        if (found < rows) { failed += rows - found; print "bench/README.md lacks a row of bench/size.sh" }
        printf "%d passed, %d failed\n", passed, failed
        exit failed > 0
    }' "$T/now" bench/README.md
