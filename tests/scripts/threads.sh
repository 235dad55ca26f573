#!/bin/sh
# threads.sh - ThreadSanitizer finds nothing: lesson 19's bands, tests/scripts/sharing.c, in which
# threads share what they only read, and examples/kit/test/race.c, in which a scene changes.  In both builds of the hot loops: for the processor as it was
# compiled for, and chosen when the program runs.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
CLANG=${CLANG:-clang}
there "$CLANG" || { left_out "threads: no $CLANG"; finish; exit; }

sanitized() {                   # program, source, flags
    program=$1 source=$2; shift 2
    "$CLANG" -std=c99 -w -O1 -g -fsanitize=thread "$@" -ffp-contract=off -I. "$source" -lm -pthread -o "$program"
}
# Without the sanitizer: the picture that the bands must give.
check "lesson 19" cc -std=c99 -w -O2 -ffp-contract=off -I. examples/lessons/19_threads.c -lm -pthread -o "$T/lesson"
check "its picture" "$T/lesson" "$T/lesson.ppm"
# G13, G19
for asks in -DTHREADS -DSHADE__ASK_PROCESSOR; do
    check "lesson 19 compiles, $asks" sanitized "$T/bands" examples/lessons/19_threads.c $asks
    check "bands, $asks" "$T/bands" "$T/bands.ppm"
    check "their picture, $asks" cmp "$T/bands.ppm" "$T/lesson.ppm"
    check "sharing.c compiles, $asks" sanitized "$T/sharing" tests/scripts/sharing.c $asks
    check "what is only read is shared, $asks" "$T/sharing"
done
# a scene that one thread changes while others draw it
check "race.c compiles" sanitized "$T/race" examples/kit/test/race.c
check "a scene is changed while it is drawn" "$T/race"
finish
