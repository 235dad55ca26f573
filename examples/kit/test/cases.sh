#!/bin/sh
# cases.sh - the table of cases in C, with the sanitizers where there are some, and the table itself, which
# is what cases.py writes.  The packages run it in their own tests.
cd "$(dirname "$0")/../../.." || exit 1
. tests/scripts/tools.sh

K=examples/kit/test
quick_compiler cc cc
cc="$T/bin/cc -std=c99 -w -ffp-contract=off"
$cc -fsanitize=address,undefined -I. $K/cases.c -lm -pthread -o "$T/cases" 2>"$T/log" ||
    check "cases.c compiles" $cc -I. $K/cases.c -lm -pthread -o "$T/cases"
check "the cases in C" "$T/cases" $K/cases.json
find_python "PIL"
if [ "$python" ]; then
    check "cases.py" sh -c "$python $K/cases.py >'$T/cases.json'"
    check "the table is what it writes" cmp "$T/cases.json" $K/cases.json
else left_out "the table by cases.py: no Python with Pillow"; fi
finish
