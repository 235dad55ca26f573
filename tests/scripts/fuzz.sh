#!/bin/sh
# fuzz.sh [seconds] [target ...] - fuzzes each target, of tests/fuzz and for readers of examples/kit/test,
# 60 seconds in all, from the committed corpus; what it finds grows in build/fuzz/work, and crashes stay in build/fuzz/crash.
# The last lines are the number of inputs: of this run, and of all runs since build/ was made.
# Without clang and its fuzzer library the corpus is replayed instead.
#     CC           compiler of the replay; CLANG the one that fuzzes
#     FUZZ_LANES   SHADE_LANES of the build; small packets are full sooner
#     FUZZ_CHECKS  sanitizers of the build; empty: five times as many inputs of sequence, between
#                  guards of memory alone
cd "$(dirname "$0")/../.." || exit 1
seconds=${1:-60}
[ $# -gt 0 ] && shift
# G5
targets=${*:-draw mesh sequence explain lines texture shape light reader surface}
CC=${CC:-cc} CLANG=${CLANG:-clang} LANES=${FUZZ_LANES:-16} B=build/fuzz
FLAGS="-std=c99 -O2 -g -I. -Itests/fuzz -DSHADE_LANES=$LANES"
CHECKS=${FUZZ_CHECKS--fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all}
passed=0 failed=0
# C file of a target: the readers' stand beside the readers
source_of() { ls tests/fuzz/$1.c examples/kit/test/$1.c 2>/dev/null; }
count() { if [ "$1" -eq 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi; }
mkdir -p $B/crash

# The last value of a line "name: value" of libFuzzer's statistics
value() { sed -n "s/^stat::$1: *//p" "$2" | tail -n 1; }

sum() { touch $B/inputs && awk '{ n += $1 } END { printf "%d\n", n }' $B/inputs; }

# Without trace-cmp, which keeps the loops over lanes from being vectorised, meshes are drawn four
# times as fast.
library() {                                  # object, flags ...
    object=$1; shift
    "$CLANG" $FLAGS -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp "$@" \
        -c tests/fuzz/shade.c -o $B/$object.o
}
# The target explain judges sentences; mesh, which calls shade_explain too, looks after memory.  So
# it links a library without sanitizers, whose paths count in shade_explain alone: 60 times as fast.
quick() {
    printf 'src:*\nfun:%s\n' 'shade_explain' 'shade__why*' 'shade__suspect*' >$B/paths
    library quick -fsanitize-coverage-allowlist=$B/paths
}
fuzz() {                                     # target, seconds
    t=$1 log=$B/$1.log checks=$CHECKS object=shade searches=
    mkdir -p $B/work/$t
    sh tests/fuzz/corpus.sh unpack $t $B/corpus/$t
    [ $t = explain ] && { checks= object=quick; quick; }
    # its inputs are choices without magic numbers, its pictures small: 3 times as fast
    [ $t = sequence ] && checks="$checks -fno-sanitize-coverage=trace-cmp" searches=-entropic=0
    if ! "$CLANG" $FLAGS $checks -fsanitize=fuzzer $(source_of $t) $B/$object.o -lm -o $B/$t; then
        echo "$t does not build"; count 1; return
    fi
    # G1, G4
    $B/$t -max_total_time="$2" -max_len=1024 -len_control=0 -timeout=20 -rss_limit_mb=2048 $searches \
        -print_final_stats=1 -artifact_prefix=$B/crash/$t- $B/work/$t $B/corpus/$t \
        >"$log" 2>&1
    status=$?
    value number_of_executed_units "$log" >>$B/inputs
    covered=$(grep -oE 'cov: [0-9]+' "$log" | tail -n 1)
    printf '%-8s %9s executions   %-10s %s\n' $t "$(value number_of_executed_units "$log")" \
        "$covered" "$([ $status -eq 0 ] && echo no crash || echo CRASH)"
    if [ $status -ne 0 ]; then
        grep -E 'does not hold|runtime error|ERROR:|SUMMARY|shade\.h:[0-9]|written to' "$log" | head -n 12
    fi
    count $status
}
replay() {                                   # target
    t=$1
    "$CC" $FLAGS $checks $(source_of $t) $B/replay.o -lm -o $B/replay-$t ||
        { count 1; return; }
    sh tests/fuzz/corpus.sh unpack $t $B/corpus/$t
    log=$($B/replay-$t $B/corpus/$t/* 2>&1)
    status=$?
    printf '%-8s %s\n' $t "$(printf '%s\n' "$log" | tail -n 1)"
    [ $status -ne 0 ] && printf '%s\n' "$log" | head -n 20
    count $status
}

printf '#include <stddef.h>\nint LLVMFuzzerTestOneInput(const unsigned char *p, size_t n);
int LLVMFuzzerTestOneInput(const unsigned char *p, size_t n) { return p && n == 0; }\n' >$B/probe.c
if "$CLANG" -fsanitize=fuzzer,address $B/probe.c -o $B/probe >/dev/null 2>&1; then
    library shade $CHECKS || { echo "0 passed, 1 failed"; exit 1; }
    share=$((seconds / $(echo $targets | wc -w)))
    before=$(sum)
    for t in $targets; do fuzz "$t" $((share > 0 ? share : 1)); done
    echo "$(($(sum) - before)) inputs, $(sum) since build/ was made"
else
    echo "no $CLANG with a fuzzer library (libclang-rt-14-dev): the corpus is replayed"
    checks=$CHECKS                           # or none, where the compiler has no sanitizers
    echo 'int main(void) { return 0; }' | "$CC" $CHECKS -x c - -o $B/probe 2>/dev/null || checks=
    "$CC" $FLAGS $checks -DFUZZ_REPLAY -c tests/fuzz/shade.c -o $B/replay.o ||
        { echo "0 passed, 1 failed"; exit 1; }
    for t in $targets; do replay "$t"; done
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
