#!/bin/sh
# view.sh - build/view: its command line, in a terminal (tests/view/terminal.sh), in terminals that
# a program plays (tests/view/pixels.py) and in a window (tests/view/window.sh).  What is not
# installed is named and left out.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
VIEW=$PWD/build/view CC=${CC:-cc}
export LC_ALL=C.UTF-8
unset TMUX COLORTERM STY DISPLAY WAYLAND_DISPLAY
X= server=0
cleanup() {
    tmux -S "$T/tmux.$server" kill-server
    [ -z "$X" ] || kill "$X"
    rm -rf "$T"
} 2>/dev/null
trap cleanup EXIT
ulimit -c 0

${MAKE:-make} -s build/view build/batch build/compare || { echo "0 passed, 1 failed"; exit 1; }
[ -x "$VIEW" ] || { echo "view: left out, it needs POSIX"; finish; }
$CC -std=c99 -O1 -pthread -I. -DSHADE__IMPLEMENTED tests/view/check.c build/shade.o -lm \
    -o "$T/check" || { echo "0 passed, 1 failed"; exit 1; }
check "encoding and decoding" "$T/check"

# ---- the command line, and what is no terminal --------------------------------------------------
# Status 1 and one line on stderr that holds a text
refused() {
    text=$1; shift
    "$@" >"$T/out" 2>"$T/err" </dev/null
    same "$?" 1 && same "$(wc -l <"$T/err")" 1 && grep "^view: .*$text" "$T/err"
}
check "standard input is no terminal" refused "standard input is no terminal" "$VIEW"
check "nothing is printed then" test ! -s "$T/out"
check "unknown option" refused "unknown option --frobnicate" "$VIEW" --frobnicate
check "option without a value" refused "rate needs a value" "$VIEW" --rate
for bad in "--frames 0" "--rate 241" "--colors 16: true or 256" "--threads 0: 1 .. 256" "--threads 257" \
    "--up w: x, y, z, -x, -y or -z" "--show x: halves, quadrants, sextants, kitty, iterm2 or sixel" \
    "--again 1,2" "--again 1,2,1,0" "--again 1,2,1,0,2" "--again 1,91,1,0,0" "--again 1,2,1,0,0,q" "--again x" \
    "--color redd" "--material x" "--model x" "--shading x" \
    "--max-triangles -1" "--max-memory 31"; do
    check "$bad" refused "$bad" "$VIEW" ${bad%%:*}
done
check "two models" refused "one file too many: b.obj" "$VIEW" a.obj b.obj
check "help" sh -c "'$VIEW' --help | grep -q '^usage: view'"

# ---- files, good and bad ------------------------------------------------------------------------
: >"$T/empty.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/one.obj"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 4\nf 2 3 4\n' >"$T/two.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1' >"$T/cut.obj"
printf 'v nan 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/nan.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4000000000\n' >"$T/index.obj"
printf 'v 1e38 1e38 -1e38\nv -1e38 1e38 1e38\nv 1e38 -1e38 0\nf 1 2 3\n' >"$T/large.obj"
printf 'v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n' >"$T/point.obj"
head -c 90 "$VIEW" >"$T/cut.stl"
head -c 100000 "$VIEW" >"$T/noise.obj"

if command -v tmux >/dev/null; then . tests/view/terminal.sh
else echo "no tmux: the terminal is left out"
fi
if command -v python3 >/dev/null; then
    check "pixels and cells, as the terminal answers" python3 tests/view/pixels.py "$VIEW" "$T/check"
else left_out "no python3: answers of terminals"
fi
. tests/view/window.sh
finish
