#!/bin/sh
# prove.sh [driver ...] - Frama-C's Eva over the drivers of tests/prove/*.c, each between #ifdef
# PROVE_driver and #endif: no overflow, no shift or conversion out of range, no access outside an
# array, every assertion true.  What Eva cannot see alone stands in tests/prove/known.txt: a fact of
# it that Eva can prove, or that it is never asked for, fails too.
# HEADER=file proves another shade.h.
cd "$(dirname "$0")/../.." || exit 1
if ! command -v frama-c >/dev/null; then
    echo "left out: no frama-c"; echo "0 passed, 0 failed"; exit 0
fi
. tests/scripts/tools.sh
known=tests/prove/known.txt

# Writes the header with what known.txt says for a driver, and the names of its facts.
annotate() {
    awk -v driver="[$1]" -v facts="$T/facts" '
        BEGIN { printf "" > facts }
        NR == FNR && /^\[/ { mine = $1 == driver; sub(/^[^ ]* /, ""); place = $0; next }
        NR == FNR && mine && $1 == "hint:" { sub(/^ *hint: */, ""); add[place] = add[place] "/*@ " $0 " */; " }
        NR == FNR && mine && $1 == "fact:" {
            sub(/^ *fact: */, "")
            add[place] = add[place] "/*@ assert fact_" FNR ": " $0 "; */ "
            print "shade.h: assertion fact_" FNR > facts
        }
        NR == FNR && mine && $1 == "prove:" {
            sub(/^ *prove: */, ""); add[place] = add[place] "/*@ assert " $0 "; */ "
        }
        NR == FNR { next }
        {
            for (place in add) {
                at = index($0, place)
                if (at) { $0 = substr($0, 1, at - 1) add[place] substr($0, at); seen[place]++ }
            }
            print
        }
        END {
            for (place in add)
                if (seen[place] != 1)
                    { print "in shade.h " seen[place] + 0 " times: " place > "/dev/stderr"; bad = 1 }
            exit bad
        }' "$known" "${HEADER:-shade.h}"
}
# The alarms of a log, one a line; those in shade.h without their line numbers.
alarms() {
    awk '/^\[eva:alarm\]/ { if (a) print a; a = $0; next }
         a && /^  / { sub(/^ +/, " "); a = a $0; next }
         { if (a) print a; a = "" }' "$1" |
        sed -E 's/^\[eva:alarm\] //; s/: Warning:/:/; s/^([^ ]*\/)?shade\.h:[0-9]+:/shade.h:/
                s/ +/ /g; s/assertion .?(fact_[0-9]+).? got status unknown.*/assertion \1/' | sort -u
}
# G1
prove() {
    source=$(grep -lx "#ifdef PROVE_$1" tests/prove/*.c) || return 1
    rm -f "$T/odd"
    sed -n "/^#ifdef PROVE_$1\$/,/^#endif/p" "$source" >"$T/part"
    annotate "$1" >"$T/shade.h" || return 1
    frama-c -machdep gcc_x86_64 -cpp-extra-args="-DPROVE_$1 -DPROVE_HEADER=\\\"$T/shade.h\\\" -U__GNUC__ -D__GNUC__=7" \
        -eva -eva-slevel 0 -eva-auto-loop-unroll 300 -warn-special-float none -no-unicode \
        $(sed -n 's/.*eva: \(-.*\) \*\/.*/\1/p' "$T/part") "$source" >"$T/log" 2>&1
    [ -z "$LOG" ] || cp "$T/log" "$LOG"
    alarms "$T/log" >"$T/alarms"
    sort "$T/facts" | comm -3 - "$T/alarms" >"$T/odd"
    grep -E 'annot-error|implicit-function|missing-spec|NON TERMINATING|[Uu]ser [Ee]rror|\[kernel\] Plug-in .* aborted|[1-9][0-9]* errors' \
        "$T/log" >>"$T/odd"
    wanted=$(($(grep -c '@ assert' "$T/part") +
              $(awk -v driver="[$1]" '/^\[/ { mine = $1 == driver } mine && $1 == "prove:" { n++ }
                                      END { print n + 0 }' "$known")))
    valid=$(sed -n 's/^ *Assertions *\([0-9]*\) valid.*/\1/p' "$T/log")
    functions=$(sed -n 's/^ *\([0-9]*\) functions\? analyzed.*/\1/p' "$T/log")
    [ "${valid:-0}" -eq "$wanted" ] || echo "$wanted assertions, ${valid:-0} proved" >>"$T/odd"
    [ -n "$functions" ] || echo "no result" >>"$T/odd"
    [ -f "$T/odd" ] && ! [ -s "$T/odd" ]
}

[ $# -gt 0 ] || set -- $(sed -n 's/^#ifdef PROVE_//p' tests/prove/*.c)
for driver in "$@"; do
    start=$(date +%s)
    if prove "$driver"; then
        passed=$((passed + 1))
        echo "ok    $driver: $functions functions, $wanted assertions," \
             "$(grep -c . "$T/facts") facts given, $(($(date +%s) - start)) s"
    else
        failed=$((failed + 1)); echo "FAIL  $driver"; head -n 30 "$T/odd" 2>/dev/null
    fi
done
finish
