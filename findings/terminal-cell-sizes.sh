#!/bin/sh
# xterm 379, rxvt-unicode 9.30: the size of all cells that the system has (TIOCGWINSZ) includes xterm's border, and
#   not rxvt's; what CSI 14 t answers includes rxvt's border and scroll bar.  Debian's xterm does not answer it at all.
# Most would guess that both are one number, columns times the width of a cell, and that xterm answers what it documents.
T=$(mktemp -d) && trap 'kill $x 2>/dev/null; rm -rf "$T"' EXIT
cd "$T" || exit 1
: >status
mkdir -p debs/partial
apt-get install -qq -y --no-install-recommends --download-only -o Dir::State::status="$T/status" \
    -o Dir::Cache::archives="$T/debs" -o Debug::NoLocking=1 xvfb xterm=379-1 rxvt-unicode=9.30-2+b4 >apt.log 2>&1 || exit 77
rm -f debs/libc6_*.deb
for deb in debs/*.deb; do dpkg-deb -x "$deb" root || exit 77; done
chmod -R ug-s root/usr/bin    # or LD_LIBRARY_PATH is not read
LD_LIBRARY_PATH=$(find "$T/root" -name '*.so*' -printf '%h\n' | sort -u | tr '\n' ':')
XKB=$T/root/usr/share/X11/xkb
export LD_LIBRARY_PATH
"$T/root/usr/bin/Xvfb" :97 -screen 0 900x700x24 -nolisten tcp -xkbdir "$XKB" >xvfb.log 2>&1 & x=$!
sleep 5
cat >ask.py <<'END'
import fcntl, os, select, struct, sys, termios, time, tty
fd = os.open('/dev/tty', os.O_RDWR)
tty.setraw(fd)
os.write(fd, b'\x1b[14t\x1b[c')
said, end = b'', time.time() + 5
while time.time() < end and not said.endswith(b'c'):
    if select.select([fd], [], [], 0.2)[0]:
        said += os.read(fd, 4096)
rows, columns, width, height = struct.unpack('HHHH', fcntl.ioctl(fd, termios.TIOCGWINSZ, bytes(8)))
area = said[4:said.index(b't')].decode() if b't' in said else 'none'
with open(sys.argv[1], 'w') as f:
    print(f'{columns} x {rows} cells, the system {height};{width}, CSI 14 t {area}', file=f)
END
export DISPLAY=:97
timeout 20 "$T/root/usr/bin/xterm" -fn 6x13 -geometry 80x24 -b 10 -e python3 ask.py xterm.txt
timeout 20 "$T/root/usr/bin/rxvt-unicode" -fn 6x13 -geometry 80x24 -b 10 -e python3 ask.py rxvt.txt
[ -s xterm.txt ] && [ -s rxvt.txt ] || exit 77
echo "xterm 379: $(cat xterm.txt)"
echo "rxvt-unicode 9.30: $(cat rxvt.txt); cells of 6 x 13 are 312;480"
grep -q 'the system 332;500, CSI 14 t none' xterm.txt && grep -q 'the system 312;480, CSI 14 t 332;' rxvt.txt
