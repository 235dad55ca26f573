#!/bin/sh
# view.sh - build/view: its command line, in a terminal (terminal.sh), in terminals that
# a program plays (pixels.py) and in a window.  What is not installed is named and left
# out.
cd "$(dirname "$0")/../../../.." || exit 1
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
$CC -std=c99 -O1 -pthread -I. -DSHADE__IMPLEMENTED examples/programs/view/test/check.c build/shade.o -lm \
    -o "$T/check" || { echo "0 passed, 1 failed"; exit 1; }
check "encoding and decoding" "$T/check"

# ---- the command line, and what is no terminal --------------------------------------------------
refused() { refused_by view "$@"; }
check "standard input is no terminal" refused "standard input is no terminal" "$VIEW"
check "nothing is printed then" test ! -s "$T/out"
check "unknown option" refused "unknown option --frobnicate" "$VIEW" --frobnicate
check "option without a value" refused "rate needs a value" "$VIEW" --rate
for bad in "--frames 0" "--rate 241" "--colors 16: true or 256" "--threads 0: a whole number: 1 .. 256" "--threads 257" "--frames 1.5: a whole number: ends" \
    "--view 1,2,99: from where it is seen" "--up w: x, y, z, -x, -y or -z" "--show x: halves, quadrants, sextants, kitty, iterm2 or sixel" \
    "--again 1,2" "--again 1,2,1,0" "--again 1,2,1,0,2" "--again 1,91,1,0,0" "--again 1,2,1,0,0,q" "--again x" \
    "--color redd" "--material x" "--model x" "--shading x" \
    "--max-triangles -1" "--max-memory 31"; do
    check "$bad" refused "$bad" "$VIEW" ${bad%%:*}
done
for bad in "--ascii --colors=256" "--ascii --window" "--show=kitty --window" "--color=red --material=gold"; do
    check "$bad" refused "${bad%%[ =]*} does not go with --" "$VIEW" $bad
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

if command -v tmux >/dev/null; then . examples/programs/view/test/terminal.sh
else echo "no tmux: the terminal is left out"
fi
if command -v python3 >/dev/null; then
    check "pixels and cells, as the terminal answers" python3 examples/programs/view/test/pixels.py "$VIEW" "$T/check"
else left_out "no python3: answers of terminals"
fi

# ---- the window, with SDL's dummy driver, and under Xvfb with xdotool at keys and mouse ---------
if ! grep -q SDL_Init "$VIEW"; then
    check "--window without SDL2" refused "built without SDL2" "$VIEW" --window
    echo "no SDL2: the window is left out"
    finish
fi
dummy="env SDL_VIDEODRIVER=dummy SDL_RENDER_DRIVER=software $VIEW --window"
ended() { ! kill -0 "$window" 2>/dev/null; }
# The window has ended by itself, with status 0.
closed() { soon ended && wait "$window"; }
check "no display" refused "no window" env SDL_VIDEODRIVER=x11 "$VIEW" --window
check "no display, no driver named" refused "no window" env -u DISPLAY -u WAYLAND_DISPLAY \
    -u SDL_VIDEODRIVER XDG_RUNTIME_DIR="$T" timeout 60 "$VIEW" --window --frames 2
check "ten frames without a screen" $dummy --frames 10
check "of a file, at rest" $dummy --frames 2 --still "$T/one.obj"
for file in missing.obj "$T" "$T/empty.obj" "$T/cut.obj" "$T/cut.stl"; do
    check "in a window: ${file##*/}" refused "$file" $dummy "$file"
done
mkfifo "$T/slow"
$dummy - <"$T/slow" & window=$!
# a comment longer than a pipe holds: once it is written, view is reading
{ head -c 300000 /dev/zero | tr '\0' '#'; : >"$T/opened"; exec sleep 600; } >"$T/slow" & writer=$!
soon test -e "$T/opened"
kill -TERM "$window"
check "closed while it waits for its file" closed
kill "$writer" 2>/dev/null

for tool in Xvfb xdotool xwd; do
    command -v $tool >/dev/null || { echo "no $tool: the window on a screen is left out"; finish; }
done
Xvfb -displayfd 3 -noreset -screen 0 1000x800x24 3>"$T/display" >/dev/null 2>&1 &
X=$!
soon test -s "$T/display"
DISPLAY=:$(cat "$T/display")
export DISPLAY SDL_RENDER_DRIVER=software SDL_VIDEODRIVER=x11
number() { xdotool search --onlyvisible --name "$1" | tail -n 1; }
# The window's width, height, changes of colour and pixels of one color, once it holds a picture
look() {
    xwd -silent -id "$(number .)" >"$T/picture" && found=$("$T/check" window "$1" <"$T/picture") &&
        [ "$(echo "$found" | cut -d ' ' -f 3)" -gt 100 ]
}
picture() { look 000000; }
open() { (cd "$T" && exec "$VIEW" --window "$@" >"$T/told") & window=$!; soon picture; }
more() { look "$2" && [ "${found##* }" -gt "$1" ]; }
size() { picture && same "${found% * *}" "$1"; }
# Keeps the picture once it has been the same for a second: at rest it is drawn again, finer.
keep() {
    alike=0
    for i in $(seq 100); do
        picture; cmp -s "$T/picture" "$T/kept" && alike=$((alike + 1)) || alike=0
        [ $alike -lt 5 ] || return 0
        cp "$T/picture" "$T/kept"
        sleep 0.2
    done
}
changed() { picture && ! cmp -s "$T/picture" "$T/kept"; }

open --still "$T/two.obj"
check "a picture in the window" picture
xdotool mousemove 999 799
check "the mouse elsewhere marks no triangle" soon no more 0 ffb454
xdotool mousemove 420 420
check "the mouse on the model tells the triangle" soon more 20 ffb454
check "and marks its edge" soon more 100 ff9a1f
keep
xdotool mousemove 520 380
check "another triangle, another mark" soon changed
xdotool mousemove 999 799
check "and no longer" soon no more 0 ffb454
for key in m s l e b w g Left Up plus h; do
    keep
    xdotool key $key
    check "key $key in the window" soon changed
done
xdotool key h r
keep
xdotool mousemove 400 400 mousedown 1 mousemove 500 420 mouseup 1 mousemove 999 799
check "dragging turns" soon changed
keep
xdotool mousemove 400 400 mousedown 3 mousemove 500 420 mouseup 3 mousemove 999 799
check "dragging with the right button moves" soon changed
keep
xdotool key shift+Left
check "so does shift with an arrow" soon changed
xdotool windowsize "$(number .)" 500 300
check "resized: a picture of that size" soon size "500 300"
xdotool key p
check "p prints the command" soon grep -q "view --still --again .* --window " "$T/told"
check "and saves a picture of that size" same \
    "$(build/compare "$T"/two-1.p* "$T"/two-1.p* --json | grep -o '"width": *[0-9]*\|"height": *[0-9]*' | tr -dc '0-9\n' | tr '\n' ' ')" "500 300 "
xdotool key q
check "q closes the window" closed
open
cp "$T/picture" "$T/kept"
check "it turns by itself" soon changed
kill -TERM "$window"
check "closing ends the program" closed

# a terminal that knows sixels, on the screen; its picture has pixels where characters have blocks
if command -v xterm >/dev/null && "$VIEW" --show sixel </dev/null 2>&1 | grep -q "no terminal"; then
    env -u TERM xterm -ti vt340 -geometry 80x24+0+0 -e "$VIEW" --still 2>/dev/null & window=$!
    sixels() {
        xwd -silent -root >"$T/picture" && found=$("$T/check" window ffffff <"$T/picture") &&
            [ "$(echo "$found" | cut -d ' ' -f 3)" -gt 60000 ]
    }
    check "sixels in xterm" soon sixels
    kill "$window"
else left_out "no xterm, or no libsixel: sixels on a screen"
fi
finish
