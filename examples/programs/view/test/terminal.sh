# terminal.sh - part of view.sh: view in a real terminal emulator without a screen (tmux): keys in,
# screen out, sizes, kinds of terminals, what is sent, every way out, bad files.

# ---- tmux ---------------------------------------------------------------------------------------
# each start has a server of its own: a dying one would refuse the next
tm() { tmux -S "$T/tmux.$server" -f /dev/null "$@"; }
cat >"$T/inner" <<'EOF'
# Runs a program in a pane and leaves its number, its status and the terminal's modes behind.
cd "$1" || exit
shift
stty -g >before
trap : INT QUIT
sh -c 'echo $$ >pid.new; mv pid.new pid; exec "$@" 2>err' sh "$@"
echo $? >status.new
stty -g >after
mv status.new status
sleep 1000
EOF
# columns, rows, command: starts it in a pane
start_command() {
    columns=$1 rows=$2; shift 2
    tm kill-server 2>/dev/null
    server=$((server + 1))
    rm -f "$T/pid" "$T/status" "$T/after" "$T/err"
    tm new-session -d -x "$columns" -y "$rows" sh "$T/inner" "$T" "$@"
    soon test -s "$T/pid"
}
# columns, rows, settings (for env), arguments of view
start() {
    size="$1 $2" settings=$3; shift 3
    # shellcheck disable=SC2086
    start_command $size env $settings "$VIEW" "$@"
}
modes() {
    tm display-message -p '#{alternate_on} #{cursor_flag} #{mouse_button_flag} #{mouse_sgr_flag}'
}
in_modes() { same "$(modes)" "$1"; }
capture() { tm capture-pane -e -N -p >"$T/pane"; }
shows() { tm capture-pane -p | grep -q -e "$1"; }
lacks() { ! shows "$1"; }
has_blocks() { capture; LC_ALL=C grep -q "$(printf '\342\226')" "$T/pane"; }
has_color() { capture; grep -q "[34]8;$1;" "$T/pane"; }
# colors, columns, rows, keys, model: the pane is the picture that these keys lead to
drawn() { capture; "$T/check" pane "$@" <"$T/pane"; }
keys() { for k in "$@"; do tm send-keys "$k"; done; }
# The program has ended with this status and the terminal is as it was.
restored() {
    soon test -s "$T/status" && same "$(cat "$T/status")" "$1" &&
        soon in_modes "0 1 0 0" && same "$(cat "$T/after")" "$(cat "$T/before")"
}
said() { same "$(wc -l <"$T/err")" 1 && grep -q "^view: .*$1" "$T/err"; }
full="TERM=xterm-256color COLORTERM=truecolor"

# ---- pictures: sizes and kinds of terminals -----------------------------------------------------
for size in "80 24" "10 3" "200 60" "1 1" "3 1"; do
    # shellcheck disable=SC2086
    start $size "$full" --still
    # shellcheck disable=SC2086
    check "the teapot in $size" soon drawn true $size ""
done
for n in 1 3 256; do            # drawn by all cores to compare with
    start 80 24 "$full" --still --threads $n
    check "by $n threads" soon drawn true 80 24 ""
done
start 80 24 "$full" --still
check "the name and the size" soon shows "teapot, [0-9]* triangles"
check "the other screen, no cursor, a mouse" soon in_modes "1 0 1 1"
titled() { tm display-message -p '#{pane_title}' | grep AAAA; }
check "questions are no title" no titled
start 80 24 TERM=xterm-256color --still
check "256 colors" soon drawn 256 80 24 ""
check "no other colors then" no has_color 2
start 80 24 "$full STY=1.tty" --still
check "256 colors in GNU screen" soon drawn 256 80 24 ""
start 80 24 TERM=xterm-kitty --still
check "all colors by the terminal's name" soon drawn true 80 24 ""
start 80 24 "$full" --still --colors 256
check "--colors 256" soon drawn 256 80 24 ""
for term in vt100 linux xterm; do
    start 80 24 TERM=$term --still
    check "plain characters on $term" soon drawn plain 80 24 ""
done
start 80 24 "$full" --still --ascii
check "--ascii" soon drawn plain 80 24 ""
check "no colors with --ascii" no has_color '[25]'
check "no blocks with --ascii" no has_blocks
start 80 24 "$full LC_ALL=de_DE.ISO-8859-1" --still
check "colors in a locale without blocks" soon has_color 2
check "no blocks in it" no has_blocks
start 80 24 "$full LC_ALL= LANG=de_DE.utf8" --still
check "blocks in one with" soon drawn true 80 24 ""
for term in dumb ""; do
    start 80 24 TERM=$term
    check "TERM=$term" restored 1
    check "TERM=$term is said" said "cannot place its cursor"
done
start_command 80 24 sh -c "'$VIEW' >out"
check "standard output is no terminal" restored 1
check "that is said" said "standard output is no terminal"

# ---- keys and mouse -----------------------------------------------------------------------------
start 80 24 "$full" --still
soon drawn true 80 24 ""
walked=
for step in "m chrome" "M bronze" "s per vertex" "s per face" "l sun" "l near" "l spot" \
    "l two colors" "t ambient" "t diffuse" "t specular" "T diffuse" "e Phong" "E Blinn-Phong" \
    "f ungated" "b daylight" "w over" "w alone" "g none"; do
    key=${step%% *} walked=$walked${step%% *}
    keys "$key"
    check "key $key: ${step#* }" soon shows " ${step#* }"
    check "the picture after $walked" soon drawn true 80 24 "$walked"
done
keys r
check "r: as at first" soon drawn true 80 24 ""
check "what a key did is shown for some seconds" soon lacks "none"
for step in "Left <" "Right >" "Up ^" "Down v" "+ +" "- -" "S-Left 4" "S-Right 6" "S-Up 8" "S-Down 2"; do
    keys "${step% *}"
    check "key ${step% *}" soon drawn true 80 24 "${step#* }"
    keys r
    soon drawn true 80 24 ""
done
send() { tm send-keys -l "$(printf "$1")"; }
send '\033OD\033[D'
check "arrows of both kinds" soon drawn true 80 24 "<<"
keys r
send '\033[<64;40;12M'
check "the wheel zooms in" soon drawn true 80 24 "+"
send '\033[<65;40;12M\033[<65;40;12M'
check "and out" soon drawn true 80 24 "+--"
keys r
soon drawn true 80 24 ""
send '\033[<0;40;12M\033[<32;46;12M'
check "dragging turns" soon no drawn true 80 24 ""
send '\033[<32;40;12M\033[<0;40;12m'
check "and back" soon drawn true 80 24 "v^"
send '\033[<2;40;12M\033[<34;46;12M\033[<34;46;14M'
check "dragging with the right button moves" soon no drawn true 80 24 ""
send '\033[<36;40;14M\033[<36;40;12M\033[<0;40;12m'
check "and back with shift" soon drawn true 80 24 ""
keys '?'
check "? shows the keys" soon shows "this help"
keys h
check "h hides them" soon lacks "this help"
at_rest() { capture; cp "$T/pane" "$T/still"; sleep 1; capture; cmp "$T/still" "$T/pane"; }
check "at rest nothing moves" soon at_rest
keys Space
check "space turns, at a rate" soon shows "[1-9][0-9]* fps"
turning() { capture; cp "$T/pane" "$T/one"; sleep 0.3; capture; ! cmp -s "$T/one" "$T/pane"; }
check "it turns" soon turning
keys q
check "q: status 0" restored 0

# ---- pictures that are kept ---------------------------------------------------------------------
cp "$T/two.obj" "$T/it's two.obj"
start 80 24 "$full" "$T/it's two.obj" --still --up z --color orange
soon has_color 2
keys Left Left S-Up + m M l g p
check "p saves the picture" soon shows "saved it's two-1[.]p"
keys L p
check "and another" soon shows "saved it's two-2[.]p"
keys q
check "q then" restored 0
# the options that the program has printed, as a shell reads them, drawn by batch
tm capture-pane -p -J | grep -e "view --still --again" | sed 's/ *$//' >"$T/commands"
check "each is printed" same "$(wc -l <"$T/commands")" 2
redrawn() {                     # number, pixels of 255 by which few may differ
    eval "set -- $1 $2 $(sed -n "$1s/.* --still/--still/p" "$T/commands")" && number=$1 limit=$2 && shift 3
    kept=$(ls "$T/it's two-$number".p*) && rm -rf "$T/strips" &&
        build/batch "$@" --strips 1 --size 1200x720 --samples 4 --out "$T/strips" --quiet &&
        build/compare "$T/strips/00000.ppm" "$kept" --limit "$limit" --count 0.5%
}
for number in 1 2; do check "picture $number is drawn again" redrawn $number 12; done
check "they are two pictures" no build/compare "$T"/it*-1.p* "$T"/it*-2.p* --limit 12 --count 0.5%
eval "set -- $(sed -n 1p "$T/commands")"; shift
start 80 24 "$full" "$@"
soon has_color 2
keys p
check "the command shows it again" soon shows "saved it's two-3[.]p"
keys q
restored 0
check "the same bytes" sh -c "cmp '$T'/it*-1.p* '$T'/it*-3.p*"

start_command 80 24 sh -c "mkdir gone && cd gone && rmdir ../gone && exec env $full '$VIEW' --still"
soon has_color 2
keys p
check "a folder that takes no files is told of" soon shows "not saved: No such file"
keys q
check "and no command is printed" sh -c "! tmux -S '$T/tmux.$server' capture-pane -p | grep again"

# ---- what is sent -------------------------------------------------------------------------------
cost() { sed -n "s/.*the $1 of \([0-9]*\).*/\1/p" "$T/err"; }
for kind in "plain --ascii" "256 --colors=256" "true"; do
    # shellcheck disable=SC2046,SC2086
    start 80 24 "$full" --frames 40 --rate 60 $(echo ${kind#* } | tr = ' ' | grep -e --)
    check "--frames" restored 0
    check "${kind% *}: less than half of the first frame" \
        test "$(cost others)" -lt "$(($(cost first) / 2))"
    echo "bytes: ${kind% *} first $(cost first), then $(cost others)"
done
start 80 24 "$full" --frames 10 --rate 60 --still
restored 0
check "nothing is sent where nothing changes" same "$(cost others)" 0

# ---- size ---------------------------------------------------------------------------------------
start 80 24 "$full" --still
soon drawn true 80 24 ""
for size in "40 12" "100 30" "10 3" "80 24"; do
    tm resize-window -x "${size% *}" -y "${size#* }"
    # shellcheck disable=SC2086
    check "resized to $size" soon drawn true $size ""
done
keys Space
for size in 10 200 3 120 80; do tm resize-window -x $size -y $((size / 4 + 1)); done
check "resized while it turns" soon shows '^.\{73\}? help.\{0,1\}$'
# where frames take longer than their share of time, and the terminal reports nothing, there is no
# rest for signals to arrive in
count() { grep -ao "$1" "$T/typescript" | wc -l; }
more_than() { [ "$(count "$2")" -gt "$1" ]; }
if command -v script >/dev/null; then
    awk 'BEGIN { n = 300; for (i = 0; i < n * n; i++) print "v", i % n, int(i / n), sin(i * 0.01)
        for (i = 1; i < n * n - n; i++) if (i % n) print "f", i, i + 1, i + n + 1, i + n
        }' >"$T/grid.obj"
    rm -f "$T/pid"
    script -qfec "sh -c 'echo \$\$ >$T/pid; exec env $full $VIEW --rate 240 $T/grid.obj'" \
        "$T/typescript" </dev/null >/dev/null 2>&1 & slow=$!
    check "slow frames, unreported" soon more_than 4 2026h
    kill -CONT "$(cat "$T/pid")"
    check "signals arrive between them" soon more_than 1 1049h
    kill -TERM "$(cat "$T/pid")"
    wait $slow
fi

# ---- ways out -----------------------------------------------------------------------------------
for signal in HUP:1 INT:2 QUIT:3 ILL:4 TRAP:5 ABRT:6 BUS:7 FPE:8 USR1:10 SEGV:11 USR2:12 \
    PIPE:13 ALRM:14 TERM:15; do
    start 80 24 "$full"
    soon has_color 2
    kill -"${signal%:*}" "$(cat "$T/pid")"
    check "SIG${signal%:*} restores" restored $((128 + ${signal#*:}))
done
start 80 24 "$full"
soon has_color 2
keys C-c
check "^C restores" restored 130
start 80 24 "$full"
soon has_color 2
kill -STOP "$(cat "$T/pid")"
tm send-keys -R
kill -CONT "$(cat "$T/pid")"
check "stopped, the screen lost, continued: a picture again" soon shows fps
check "and the other screen" soon in_modes "1 0 1 1"
tm kill-server
check "the terminal closed: it ends" soon no kill -0 "$(cat "$T/pid")"

# by ^Z, from a shell with jobs
tm kill-server 2>/dev/null
server=$((server + 1))
tm new-session -d -x 80 -y 24 -c "$T" sh -i
tm send-keys "export $full PS1='> '; clear; stty -g >zero" Enter
tm send-keys "$VIEW --still" Enter
soon drawn true 80 24 ""
keys C-z
check "^Z: stopped" soon shows Stopped
check "^Z restores" soon in_modes "0 1 0 0"
tm send-keys "stty -g >one; clear; fg" Enter
check "fg: the picture again" soon drawn true 80 24 ""
check "fg: the other screen" soon in_modes "1 0 1 1"
keys q
check "and out" soon shows '^>$'
tm send-keys "stty -g >two" Enter
soon test -s "$T/two"
check "modes after ^Z" same "$(cat "$T/one")" "$(cat "$T/zero")"
check "modes after fg and q" same "$(cat "$T/two")" "$(cat "$T/zero")"

# any bytes as keys but q, Q and those of signals; then r
start 80 24 "$full" --still
soon drawn true 80 24 ""
LC_ALL=C awk 'BEGIN { srand(7); for (i = 0; i < 6000; i++) { c = 1 + int(rand() * 255)
    if (rand() < 0.1) printf "\033["
    else if (c != 113 && c != 81 && c != 3 && c != 26 && c != 28) printf "%c", c }
    printf "~~~~~~mr" }' >"$T/bytes"
tm load-buffer "$T/bytes"
tm paste-buffer -r
# reports arrive between any two bytes, so that the help may have stayed
without_help() { drawn true 80 24 "" || { shows "this help" && keys h; false; }; }
check "any bytes as keys" soon without_help

# ---- bad files ----------------------------------------------------------------------------------
bad() {                         # what, file, what it says
    start 80 24 "$full" "$2"
    check "$1" restored 1
    check "$1: said" said "$3"
}
bad "a missing file" missing.obj "No such file"
bad "a directory" "$T" "directory"
bad "an empty file" "$T/empty.obj" "empty"
bad "half an OBJ" "$T/cut.obj" "cut.obj:3"
bad "numbers that are none" "$T/nan.obj" "nan.obj:2"
bad "an index out of range" "$T/index.obj" "index.obj:4"
bad "half an STL" "$T/cut.stl" "cut.stl"
bad "no OBJ at all" "$T/noise.obj" "noise.obj"
bad "a triangle that is a point" "$T/point.obj" "no triangle of it has an area"
truncate -s 8G "$T/huge.stl" 2>/dev/null &&
    start_command 80 24 sh -c "ulimit -v 500000; exec env $full '$VIEW' huge.stl" &&
    check "a file larger than memory" restored 1 && check "that is said" said "out of memory"
rm -f "$T/huge.stl"
for model in one large; do
    start 80 24 "$full" --still "$T/$model.obj"
    check "$model.obj is drawn" soon drawn true 80 24 "" "$T/$model.obj"
done
