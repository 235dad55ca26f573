# window.sh - part of view.sh: the window of view with SDL's dummy driver, and under Xvfb with
# xdotool at keys and mouse.

if ! grep -q SDL_Init "$VIEW"; then
    check "--window without SDL2" refused "built without SDL2" "$VIEW" --window
    echo "no SDL2: the window is left out"
    return
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
    command -v $tool >/dev/null || { echo "no $tool: the window on a screen is left out"; return; }
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
