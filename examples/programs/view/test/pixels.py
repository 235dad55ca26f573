"""pixels.py - view in terminals that this program plays: what it asks, what it does with the answers,
and whether the pictures it sends, decoded here, are those that shade.h draws.

    python3 examples/programs/view/test/pixels.py VIEW CHECK
"""

import base64
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unicodedata
import zlib

VIEW, CHECK = sys.argv[1:3]
ROWS, COLUMNS, CELL = 24, 80, (10, 20)
PATIENCE = 60
passed = failed = 0

ASKED = {
    'kitty': rb'\x1b_Gi=31', 'name': rb'\x1b\[>0q', 'features': rb'\x1b\]1337;Capabilities\x1b\\',
    'cell': rb'\x1b\[16t', 'largest': rb'\x1b\[\?2;1;0S', 'attributes': rb'\x1b\[c',
    'area': rb'\x1b\[14t', 'secondary': rb'\x1b\[>c',
}
TERMINALS = {
    'kitty': {'kitty': b'\x1b_Gi=31;OK\x1b\\', 'name': b'\x1bP>|kitty(0.26.5)\x1b\\',
              'attributes': b'\x1b[?62;c'},
    'iterm2': {'name': b'\x1bP>|iTerm2 3.5.9\x1b\\', 'attributes': b'\x1b[?62;4c',
               'features': b'\x1b]1337;Capabilities=T3LrMSc7UUw9Ts3BFGsSyHNoSxF\x07'},
    'sixel': {'name': b'\x1bP>|XTerm(379)\x1b\\', 'attributes': b'\x1b[?63;1;2;4;6;9;15;22c'},
    'sixel-small': {'name': b'\x1bP>|XTerm(379)\x1b\\', 'attributes': b'\x1b[?63;1;2;4;22c',
                    'largest': b'\x1b[?2;0;640;400S'},
    'sextants': {'name': b'\x1bP>|foot(1.13.1)\x1b\\', 'attributes': b'\x1b[?62;22c'},
    'quadrants': {'name': b'\x1bP>|XTerm(379)\x1b\\', 'attributes': b'\x1b[?62;22c'},
    'tmux': {'name': b'\x1bP>|tmux 3.5a\x1b\\', 'attributes': b'\x1b[?1;2;4c'},
    'plain': {'attributes': b'\x1b[?1;2c'},
    'silent': {},
}
# Terminals of Debian 12, what each answered when it was asked (under Xvfb, foot under weston), TERM,
# COLORTERM, the system's pixels for 80 x 24 cells and those of a cell, and what is shown.  mlterm
# answers another question than that for the largest sixels, rxvt and xterm count a border, xterm
# unless it is made so tells no size, VTE tells no name.
REAL = {
    'xterm 379': ('xterm', '', (484, 316), (6, 13), 'quadrants', {
        'name': b'\x1bP>|XTerm(379)\x1b\\', 'largest': b'\x1b[?2;3S', 'secondary': b'\x1b[>41;379;0c',
        'attributes': b'\x1b[?64;1;2;6;9;15;16;17;18;21;22;28c'}),
    'xterm 379 -ti vt340 -b 20': ('xterm', '', (520, 352), (6, 13), 'sixel', {
        'name': b'\x1bP>|XTerm(379)\x1b\\', 'largest': b'\x1b[?2;0;480;312S',
        'secondary': b'\x1b[>19;379;0c', 'attributes': b'\x1b[?63;1;2;4;6;9;15;16;22;28c'}),
    'mlterm 3.9.0': ('mlterm', '', (800, 456), (10, 19), 'sixel', {
        'cell': b'\x1b[6;19;10t', 'area': b'\x1b[4;456;800t', 'largest': b'\x1b[?1;3;0S',
        'secondary': b'\x1b[>24;279;0c',
        'attributes': b'\x1b[?63;1;2;3;4;6;7;15;18;22;29c'}),
    'st 0.9': ('st-256color', '', (560, 312), (7, 13), '256', {'attributes': b'\x1b[?6c'}),
    'rxvt-unicode 9.30': ('rxvt-unicode-256color', 'rxvt-xpm', (480, 312), (6, 13), '256', {
        'area': b'\x1b[4;316;496t', 'secondary': b'\x1b[>85;95;0c', 'attributes': b'\x1b[?1;2c'}),
    'kitty 0.26.5': ('xterm-kitty', 'truecolor', (720, 432), (9, 18), 'kitty', {
        'kitty': b'\x1b_Gi=31;OK\x1b\\', 'name': b'\x1bP>|kitty(0.26.5)\x1b\\',
        'cell': b'\x1b[6;18;9t', 'area': b'\x1b[4;432;720t', 'secondary': b'\x1b[>1;4000;26c',
        'attributes': b'\x1b[?62;c'}),
    'alacritty 0.11': ('alacritty', 'truecolor', (720, 432), (9, 18), 'true', {
        'area': b'\x1b[4;432;720t', 'secondary': b'\x1b[>0;1700;1c', 'attributes': b'\x1b[?6c'}),
    'Konsole 22.12.3': ('xterm-256color', 'truecolor', (642, 408), (8, 17), 'kitty', {
        'kitty': b'\x1b_Gi=31;OK\x1b\\', 'name': b'\x1bP>|Konsole 22.12.3\x1b\\',
        'cell': b'\x1b[6;17;8t', 'area': b'\x1b[4;408;640t', 'largest': b'\x1b[?2;0;16384;16384S',
        'secondary': b'\x1b[>1;115;0c', 'attributes': b'\x1b[?62;1;4c'}),
    'xfce4-terminal 1.0.4, VTE 0.70.6': ('xterm-256color', 'truecolor', (0, 0), (10, 19), 'sextants', {
        'area': b'\x1b[4;456;800t', 'largest': b'\x1b[?2;1S', 'secondary': b'\x1b[>65;7006;1c',
        'attributes': b'\x1b[?65;1;9c'}),
    'gnome-terminal 3.46.8, VTE 0.70.6': ('xterm-256color', 'truecolor', (0, 0), (9, 18), 'sextants', {
        'area': b'\x1b[4;432;720t', 'largest': b'\x1b[?2;1S', 'secondary': b'\x1b[>65;7006;1c',
        'attributes': b'\x1b[?65;1;9c'}),
    'tmux 3.3a': ('tmux-256color', '', (480, 312), (6, 13), '256', {
        'name': b'\x1bP>|tmux 3.3a\x1b\\', 'secondary': b'\x1b[>84;0;0c',
        'attributes': b'\x1b[?1;2c'}),
    'GNU screen 4.9.0': ('screen', '', (484, 316), (6, 13), 'plain', {
        'secondary': b'\x1b[>83;40900;0c', 'attributes': b'\x1b[?1;2c'}),
    'foot 1.13.1': ('foot', 'truecolor', (560, 336), (7, 14), 'sixel', {
        'name': b'\x1bP>|foot(1.13.1)\x1b\\', 'cell': b'\x1b[6;14;7t', 'area': b'\x1b[4;336;560t',
        'largest': b'\x1b[?2;0;560;336S', 'secondary': b'\x1b[>1;011301;0c',
        'attributes': b'\x1b[?62;4;22c'}),
}


def check(what, holds):
    global passed, failed
    passed, failed = passed + bool(holds), failed + (not holds)
    if not holds:
        print('FAIL     ', what)


class Terminal:
    """One run of view in a terminal of some kind; its answers come after some seconds, in pieces of
    some bytes."""

    def __init__(self, kind, *options, late=0.0, piece=1000, gap=0.0, colors='truecolor',
                 cells=CELL):
        term, pixels, self.answers = 'xterm-256color', (COLUMNS * cells[0], ROWS * cells[1]), None
        if kind in REAL:
            term, colors, pixels, _, _, self.answers = REAL[kind]
        self.answers = self.answers or TERMINALS[kind]
        self.late, self.piece, self.gap = late, piece, gap
        self.out, self.looked, self.owed = bytearray(), 0, []
        self.master, self.slave = pty.openpty()
        size = struct.pack('HHHH', ROWS, COLUMNS, *pixels)
        fcntl.ioctl(self.slave, termios.TIOCSWINSZ, size)
        env = dict(os.environ, TERM=term, LC_ALL='C.UTF-8', COLORTERM=colors)
        self.view = subprocess.Popen([VIEW, *options], stdin=self.slave, stdout=self.slave,
                                     stderr=subprocess.DEVNULL, env=env, start_new_session=True)

    def pump(self, seconds):
        """Takes output and sends the answers that are due."""
        now = time.monotonic()
        while self.owed and self.owed[0][0] <= now:
            os.write(self.master, self.owed.pop(0)[1])
        if not select.select([self.master], [], [], seconds)[0]:
            return
        self.out += os.read(self.master, 1 << 16)
        found = []
        for name, question in ASKED.items():
            for m in re.finditer(question, self.out[self.looked:]):
                found.append((m.start(), m.end(), self.answers.get(name, b'')))
        if found:
            self.looked += max(end for _, end, _ in found)
        else:    # a question may have begun
            self.looked = max(self.looked, len(self.out) - 40)
        due = time.monotonic() + self.late
        for _, _, answer in sorted(found):
            for at in range(0, len(answer), self.piece):
                self.owed.append((due, answer[at:at + self.piece]))
                due += self.gap

    def until(self, holds):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if holds(self.out):
                return True
            self.pump(0.05)
        return False

    def rest(self, pattern=rb'\x1b\[c|\x1b\[\?2026l'):
        """Waits for a second frame, that of a model at rest, and until nothing has come for 0.5 s."""
        self.until(lambda out: len(re.findall(pattern, out)) > 1)
        last, since = -1, time.monotonic()
        while time.monotonic() < since + 0.5:
            if len(self.out) != last:
                last, since = len(self.out), time.monotonic()
            self.pump(0.05)

    def close(self, left=False):
        """Ends view by q.  True: status 0, and nothing of an answer is left for the shell, unless
        that is allowed."""
        os.write(self.master, b'q')
        end = time.monotonic() + PATIENCE
        while (self.view.poll() is None or self.owed) and time.monotonic() < end:
            self.pump(0.05)
        if self.view.poll() is None:
            self.view.kill()
            return False
        while select.select([self.master], [], [], 0.2)[0]:
            self.pump(0)
        modes = termios.tcgetattr(self.slave)
        modes[3] &= ~termios.ICANON
        termios.tcsetattr(self.slave, termios.TCSANOW, modes)
        count = bytearray(4)
        fcntl.ioctl(self.slave, termios.FIONREAD, count)
        os.close(self.master)
        os.close(self.slave)
        return self.view.returncode == 0 and (left or struct.unpack('i', count)[0] == 0)


# ---- decoders ------------------------------------------------------------------------------------

KITTY = re.compile(rb'\x1b_Ga=T,([^;]*);[^\x1b]*\x1b\\(?:\x1b_Gm=\d;[^\x1b]*\x1b\\)*')
ITERM2 = re.compile(rb'\x1b\]1337;File=([^:]*):([A-Za-z0-9+/=]+)\x07')
SIXEL = re.compile(rb'\x1bP[0-9;]*q([^\x1b]*)\x1b\\')


def kitty(sequence):
    """Width, height and RGB of a picture of one or more sequences, each of 4096 bytes at most"""
    keys = dict(k.split(b'=') for k in KITTY.match(sequence)[1].split(b',') if b'=' in k)
    parts = re.findall(rb'm=(\d);([^\x1b]*)\x1b', sequence)
    assert all(len(p) <= 4096 for _, p in parts)
    assert [m for m, _ in parts] == [b'1'] * (len(parts) - 1) + [b'0']
    assert (int(keys[b'c']), int(keys[b'r'])) == (COLUMNS, ROWS)
    data = b''.join(base64.b64decode(p, validate=True) for _, p in parts)
    size = int(keys[b's']), int(keys[b'v'])
    if keys[b'f'] == b'24':
        return *size, data
    assert keys[b'f'] == b'100' and png(data)[:2] == size
    return png(data)


def png(data):
    """Width, height and RGB of a PNG of 8 bits without interlace, by its specification"""
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    at, packed = 8, b''
    while at < len(data):
        size, kind = struct.unpack('>I4s', data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack('>I', data[at + 8 + size:at + 12 + size])[0]
        if kind == b'IHDR':
            width, height, depth, color, _, _, interlace = struct.unpack('>IIBBBBB', body)
        if kind == b'IDAT':
            packed += body
        at += 12 + size
    assert (depth, color, interlace) == (8, 2, 0)
    raw, row, rgb = zlib.decompress(packed), bytes(3 * width), bytearray()
    for y in range(height):
        start = y * (3 * width + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for x in range(3 * width if kind else 0):
            a, b, c = line[x - 3] if x > 2 else 0, row[x], row[x - 3] if x > 2 else 0
            near = min((a, b, c), key=lambda v: abs(a + b - c - v))
            line[x] = line[x] + (0, a, b, (a + b) // 2, near)[kind] & 255
        rgb += line
        row = line
    return width, height, bytes(rgb)


def sixel(data, percent=lambda p: p * 255 // 100):
    """Width, height and RGB of sixels, by the VT330 manual: # chooses or defines a colour, ! repeats,
    $ returns to the row's begin, - goes to the next six rows.  Percents are cut off, as mlterm does."""
    colors, pixels, x, y, width, color = {}, {}, 0, 0, 0, 0
    for m in re.finditer(rb'"[\d;]*|#([\d;]+)|!(\d+)([?-~])|([?-~])|(\$)|(-)', data):
        if m[1]:
            n = [int(v) for v in m[1].split(b';')]
            color = n[0]
            if len(n) == 5:
                assert n[1] == 2
                colors[color] = tuple(map(percent, n[2:]))
        elif m[3] or m[4]:
            bits, count = (m[3] or m[4])[0] - 63, int(m[2] or 1)
            for k in range(6):
                if bits >> k & 1:
                    pixels.setdefault(y + k, {}).update(
                        dict.fromkeys(range(x, x + count), color))
            x += count
            width = max(width, x)
        elif m[5]:
            x = 0
        elif m[6]:
            x, y = 0, y + 6
    height = max(pixels) + 1
    rgb = bytearray()
    for row in range(height):
        for column in range(width):
            rgb += bytes(colors[pixels[row][column]])
    return width, height, bytes(rgb)


def with_cell(cell):
    """The environment that tells CHECK how many pixels a cell has"""
    return dict(os.environ, CELL='%dx%d' % cell)


def wanted(way, cell=CELL):
    ppm = subprocess.run([CHECK, 'picture', way, str(COLUMNS), str(ROWS)], stdout=subprocess.PIPE,
                         check=True, env=with_cell(cell)).stdout
    _, size, _, rgb = ppm.split(b'\n', 3)
    return (*map(int, size.split()), rgb)


def blocks(picture):
    """Means of 8 x 8 pixels, which no dither changes much"""
    width, height, rgb = picture
    means = []
    for y in range(0, height - 7, 8):
        for x in range(0, width - 7, 8):
            sums = [0, 0, 0]
            for row in range(y, y + 8):
                at = 3 * (row * width + x)
                for k in range(3):
                    sums[k] += sum(rgb[at + k:at + 24:3])
            means.append([v / 64 for v in sums])
    return means


# ---- pixels --------------------------------------------------------------------------------------

def pictures(kind, pattern, decode):
    t = Terminal(kind, '--still')
    check(f'{kind}: a picture', t.until(pattern.search))
    t.rest(pattern.pattern)
    found = list(pattern.finditer(t.out))
    check(f'{kind}: drawn again at rest, and no more', len(found) == 2)
    picture = decode(found[-1])
    before = len(t.out)
    os.write(t.master, b'm')
    check(f'{kind}: a key draws another', t.until(lambda out: pattern.search(out, before)))
    check(f'{kind}: it ends, and the terminal has no answer left', t.close())
    return t.out, picture


out, picture = pictures('kitty', KITTY, lambda m: kitty(m[0]))
check('kitty: the picture, to the bit', picture == wanted('kitty'))
numbers = [re.search(rb'i=(\d+)', m[1])[1] for m in KITTY.finditer(out)]
check('kitty: numbers take turns', all(a != b for a, b in zip(numbers, numbers[1:])))
check('kitty: each is deleted after the next', re.findall(rb'a=d,q=2,d=I,i=(\d+)', out) == numbers[:-1])
check('kitty: none is left behind', b'\x1b_Ga=d,q=2,d=A\x1b\\' in out)

version = subprocess.run([VIEW, '--show', 'iterm2'], stdin=subprocess.DEVNULL, capture_output=True)
if b'needs a view built' in version.stderr:
    print('no stb: iTerm2 is left out')
else:
    out, picture = pictures('iterm2', ITERM2, lambda m: png(base64.b64decode(m[2], validate=True)))
    check('iterm2: the picture, to the bit', picture == wanted('iterm2'))
    check('iterm2: over all cells but the last row', b'width=80;height=23;' in out)

version = subprocess.run([VIEW, '--show', 'sixel'], stdin=subprocess.DEVNULL, capture_output=True)
if b'needs a view built' in version.stderr:
    print('no libsixel: sixels are left out')
else:
    out, picture = pictures('sixel', SIXEL, lambda m: sixel(m[1]))
    want = wanted('sixel')
    check('sixel: the size of the picture', picture[:2] == want[:2] == (800, 460))
    off = [max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(blocks(picture), blocks(want))]
    check('sixel: means of 64 pixels are near', sum(off) / len(off) < 4 and max(off) < 40)

# ---- cells ---------------------------------------------------------------------------------------

def cells(kind, form, *options, cell=CELL, **how):
    """Whether the cells that view sends, as a small terminal shows them, are those of a form"""
    t = Terminal(kind, '--still', *options, **how)
    t.rest(rb'\x1b\[\?2026l')
    out = bytes(t.out)
    t.close()
    out = out[out.rindex(b'\x1b[2J') - 3:]
    out = out[:out.index(b'\x1b[?1006l')] if b'\x1b[?1006l' in out else out
    out = re.sub(rb'\x1b\[\?2026[hl]|\x1b\[c', b'', out)
    return subprocess.run([CHECK, 'pane', form, str(COLUMNS), str(ROWS), ''], input=out,
                          stdout=subprocess.DEVNULL, env=with_cell(cell)).returncode == 0, out


for kind in ('sextants', 'quadrants'):
    right, out = cells(kind, kind)
    check(f'{kind}: the cells', right)
    names = {unicodedata.name(c) for c in out.decode() if ord(c) > 127}
    word = {'sextants': 'SEXTANT', 'quadrants': 'QUADRANT'}[kind]
    check(f'{kind}: some of the characters', any(word in n for n in names))
    check(f'{kind}: nothing but blocks',
          all(word in n or n.endswith(('HALF BLOCK', 'FULL BLOCK')) for n in names))
check('tmux answers for itself: halves', cells('tmux', 'true')[0])
check('no name: halves', cells('plain', 'true')[0])
check('no answer: halves', cells('silent', 'true')[0])
check('--show halves asks nothing', cells('kitty', 'true', '--show', 'halves')[0])
check('--show sextants asks nothing', cells('kitty', 'sextants', '--show', 'sextants')[0])
check('256 colors, dithered', cells('plain', '256', '--colors', '256')[0])

# ---- terminals as they are -----------------------------------------------------------------------

def near(picture, want):
    """Sixels have some colours alone: means of 64 pixels, by the rule of mlterm for percents"""
    off = [max(abs(a - b) for a, b in zip(p, q)) for p, q in zip(blocks(picture), blocks(want))]
    return picture[:2] == want[:2] and sum(off) / len(off) < 4 and max(off) < 40


def frames(kind):
    """Seconds of 30 frames, and whether the modes, the colours and the cursor are as before"""
    since = time.monotonic()
    t = Terminal(kind, '--frames', '30')
    while t.view.poll() is None and time.monotonic() < since + PATIENCE:
        try:
            t.pump(0.02)
        except OSError:
            break
    seconds = time.monotonic() - since
    while select.select([t.master], [], [], 0.2)[0]:
        t.pump(0)
    modes = dict(re.findall(rb'\x1b\[\?(\d+)([hl])', t.out))
    out = bytes(t.out)
    tidy = modes == {b'1049': b'l', b'25': b'h', b'1002': b'l', b'1006': b'l', b'2026': b'l'}
    tidy = tidy and out.rindex(b'\x1b[m') > out.rfind(b'\x1b[48') and out.rindex(b'H') > out.rindex(b'\x1b[m')
    return seconds, tidy and t.view.returncode == 0


at_xterm = None
for kind, (_, _, _, cell, way, _) in REAL.items():
    if way == 'kitty':
        out, picture = pictures(kind, KITTY, lambda m: kitty(m[0]))
        check(f'{kind}: the picture, to the bit', picture == wanted(way, cell))
    elif way == 'sixel' and b'needs a view built' not in version.stderr:
        out, picture = pictures(kind, SIXEL, lambda m: sixel(m[1]))
        check(f'{kind}: the picture, of this size', near(picture, wanted(way, cell)))
    elif way != 'sixel':
        check(f'{kind}: {way}, of this shape', cells(kind, way, cell=cell)[0])
    seconds, tidy = frames(kind)
    at_xterm = at_xterm or seconds
    check(f'{kind}: 30 frames as soon as in xterm', seconds < 2 * at_xterm + 1.5)
    check(f'{kind}: modes, colours and cursor as before', tidy)
for kind, room in (('sixel', (100, 200)), ('sixel-small', CELL)):
    t = Terminal(kind, '--show', 'sixel', '--still', cells=room)
    end = time.monotonic() + PATIENCE
    while t.view.poll() is None and time.monotonic() < end:
        t.pump(0.05)
    check(f'--show sixel is refused where {kind} has no room', t.view.poll() == 1)
    check(f'--show sixel in {kind}: nothing else is shown', '\u2580' not in t.out.decode('utf8', 'replace'))
    t.close()

# ---- answers -------------------------------------------------------------------------------------

t = Terminal('silent', '--show', 'kitty', '--still')
check('--show kitty without an answer', t.until(KITTY.search))
check('it ends', t.close())
t = Terminal('kitty', '--still', late=0.6)
check('late answers: characters first', t.until(lambda out: b'\xe2\x96' in out))
check('late answers: then pixels', t.until(KITTY.search))
check('late answers: it ends, none is left', t.close())
t = Terminal('kitty', '--still', piece=1)
check('answers byte by byte', t.until(KITTY.search))
check('it ends, none is left', t.close())
t = Terminal('kitty', '--still', late=0.1, piece=8, gap=0.03)
t.until(lambda out: b'\x1b[c' in out)
check('answers that come while it ends are not left to the shell', t.close())
t = Terminal('kitty', late=3.5)
t.until(lambda out: b'\xe2\x96' in out)
check('answers after 3.5 s of motion are no keys: pixels', t.until(KITTY.search))
check('it ends', t.close(left=True))
t = Terminal('kitty', '--still', cells=(100, 200))
check('pictures of 38 million pixels: characters', t.until(lambda out: b'\xe2\x96' in out or b'\xf0\x9f' in out))
check('it ends', t.close())
t = Terminal('sixel-small', '--still')
check('sixels of 640 x 400 at most: characters', t.until(lambda out: b'\xe2\x96' in out))
check('it ends', t.close())
t = Terminal('kitty', colors='')
check('a terminal with a name knows all colors: pixels', t.until(KITTY.search))
check('it turns: another picture', t.until(lambda out: len(KITTY.findall(out)) > 3))
check('it ends while it turns', t.close())

# ---- interrupted ---------------------------------------------------------------------------------

with tempfile.NamedTemporaryFile(suffix='.stl') as noise:    # 3 million triangles, all over the place
    noise.write(b'noise'.ljust(80) + struct.pack('<I', 3000000) + os.urandom(150000000))
    noise.flush()
    signal.signal(signal.SIGINT, signal.default_int_handler)    # a script in the background ignores it
    t = Terminal('plain', noise.name)
    memory = f'/proc/{t.view.pid}/statm'
    while t.view.poll() is None and int(open(memory).read().split()[1]) * 4096 < 160e6:
        time.sleep(0.02)
    t.view.send_signal(signal.SIGINT)
    check('SIGINT while it reads a large file', t.view.wait(PATIENCE) == -signal.SIGINT)
    check('the terminal is as it was', not t.out)

print(f'{passed} passed, {failed} failed')
sys.exit(failed != 0)
