#!/bin/sh
# products.sh [list] [room ...] - tests the products by room: the scripts in folders test/ of programs,
# packages and courses; of all rooms, or of those that are named.  What a script needs and is not here is
# named and left out.  list prints "room script" for each and runs none.
cd "$(dirname "$0")/.." || exit 1
[ "$1" = list ] && list=1 && shift
rooms=" $* "
scripts() {
    for script in $(grep -l '^#!' examples/*/test/*.sh examples/*/*/test/*.sh); do
        room=${script%/test/*} room=${room##*/}
        [ $# -gt 0 ] && case $rooms in *" $room "*) ;; *) continue ;; esac
        echo "$room $script"
    done
}
scripts "$@" >"${all:=$(mktemp)}"
trap 'rm -rf "$all" "$all".*' EXIT
trap 'exit 1' INT TERM
if [ "${list:-}" ]; then cat "$all"; exit; fi
[ -s "$all" ] || { echo "no room \"$*\"; there are: $(scripts | cut -d ' ' -f 1 | sort -u | tr '\n' ' ')"; exit 1; }

passed=0 failed=0
for room in $(cut -d ' ' -f 1 "$all" | uniq); do
    p=0 f=0 rest=
    for script in $(sed -n "s/^$room //p" "$all"); do
        echo "$room: $script ..."
        sh "$script" >"$all.log" 2>&1 </dev/null
        status=$?
        line=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$all.log" | tail -n 1)
        p=$((p + ${line%% *} + 0)) bad=${line##*, } bad=${bad%% *}
        [ "$status" -eq 0 ] || [ "${bad:-0}" -gt 0 ] || bad=1
        f=$((f + ${bad:-0}))
        [ "${bad:-0}" -eq 0 ] || cat "$all.log"
        grep 'left out' "$all.log"
    done
    printf '%-12s %4d passed, %d failed\n' "$room" "$p" "$f"
    passed=$((passed + p)) failed=$((failed + f))
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
