#!/bin/sh
# bits.sh BASE [count] [target ...] - do pictures have the bits of the version BASE, a commit or a tag?
# Draws count random scenes (20000) of each target of tests/fuzz with both headers: all formats, strips, bands,
# states, textures, lines, and what is refused.  Prints how many differ, and the seed of the first.
#     CC, BITS_FLAGS   compiler and flags of both builds (-O2)
#     BITS_FIRST       first seed (1)
cd "$(dirname "$0")/../.." || exit 1
[ $# -ge 1 ] || { sed -n '2,6s/^# *//p' "$0" >&2; exit 2; }
base=$1 count=${2:-20000}
shift; [ $# -gt 0 ] && shift
B=build/bits passed=0 failed=0
mkdir -p $B/base
git show "$base:shade.h" >$B/base/shade.h || exit 2
for version in base now; do
    folder=.; [ $version = base ] && folder=$B/base
    ${CC:-cc} -std=c99 ${BITS_FLAGS:--O2} -DFUZZ_BITS -I$folder -c tests/fuzz/shade.c -o $B/$version.o || exit 1
done
for t in ${*:-draw mesh lines texture}; do
    for version in base now; do
        folder=.; [ $version = base ] && folder=$B/base
        ${CC:-cc} -std=c99 ${BITS_FLAGS:--O2} -I$folder tests/fuzz/"$t".c $B/$version.o -lm -o $B/$version-"$t" &&
            $B/$version-"$t" "$count" "${BITS_FIRST:-1}" >$B/$version-"$t".txt || exit 1
    done
    differ=$(paste -d ' ' $B/base-"$t".txt $B/now-"$t".txt | awk '$2 != $4 { n++; if (n == 1) first = $1 }
        END { print n + 0, n ? ", the first is of seed " first : "" }')
    echo "$t: $count scenes, $(cut -d ' ' -f 2 $B/now-"$t".txt | sort -u | wc -l) kinds of memory; differ: $differ"
    if [ "${differ%% *}" = 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
