"""One ball, drawn by another program, as a table of pixels for test/tables.c.

The ball has radius 1 and stands at the origin.  The camera is at 0, 0, 5 and looks along -z with +y
up.  'parallel' shows -1.25 .. 1.25, 'perspective' has a field of view of 30 degrees.  Pictures are
square and have no anti-aliasing.

A script beside this file names a program's materials and lamps and gives a function
draw(case, size), which returns size * size pixels (r, g, b) from the top left.  Run alone it draws
again and fails where the program no longer gives the bytes of its table; --write writes the table.
"""
import math, os, subprocess, sys, tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TABLES = os.path.join(HERE, '..', 'tables')
SIZE, COUNT = 200, 20
EYE, HALF, FOVY = (0, 0, 5), 1.25, 30

def positions(radius=73):
    """Pixels on a spiral within .95 of the ball's radius in both cameras"""
    out = []
    for k in range(COUNT):
        r, a = radius * math.sqrt((k + .5) / COUNT), 2.399963 * k
        out.append((int(SIZE / 2 + r * math.cos(a)), int(SIZE / 2 - r * math.sin(a))))
    return out

class Case:
    """camera, and the numbers of the material and of each lamp, as dictionaries"""
    def __init__(self, camera, material, lamps):
        self.camera, self.material, self.lamps = camera, material, lamps
        self.parallel = camera == 'parallel'

def number(v):
    if isinstance(v, (tuple, list)):
        return ','.join(number(x) for x in v)
    return f'{v:.7g}'

def words(name, numbers):
    return name + '(' + ' '.join(f'{k}={number(v)}' for k, v in numbers.items()) + ')'

# toward the lamp: beside the viewer, behind the ball, grazing
KEY, BEHIND, GRAZING = (1, 1, 1, 0), (-1, .5, -.7, 0), (1, .3, .04, 0)
DIRECTIONS = [KEY, BEHIND, GRAZING]
ORANGE, WHITE, BLUE = (1, .5, .2), (1, 1, 1), (.2, .4, .9)

def directions(**more):
    return [[dict(at=at, **more)] for at in DIRECTIONS]

def every(materials, lamps, cameras=('parallel', 'perspective')):
    return [Case(c, m, l) for m in materials for l in lamps for c in cameras]

def mesh(rings=180, sectors=360):
    """Vertices of the ball (their normals too) and triangles, counter-clockwise"""
    v, f = [], []
    for i in range(rings + 1):
        t = math.pi * i / rings
        for j in range(sectors):
            p = 2 * math.pi * j / sectors
            v.append((math.sin(t) * math.cos(p), math.cos(t), -math.sin(t) * math.sin(p)))
    for i in range(rings):
        for j in range(sectors):
            a, b = i * sectors + j, i * sectors + (j + 1) % sectors
            c, d = a + sectors, b + sectors
            if i: f.append((a, c, b))
            if i < rings - 1: f.append((b, c, d))
    return v, f

def ppm(path):
    """A binary PPM of 8 bits as (width, height, [(r, g, b)])"""
    data = open(path, 'rb').read()
    at, head = 0, []
    while len(head) < 4:
        while data[at:at + 1].isspace(): at += 1
        if data[at:at + 1] == b'#':
            at = data.index(b'\n', at)
            continue
        end = at
        while not data[end:end + 1].isspace(): end += 1
        head.append(data[at:end])
        at = end
    body = data[at + 1:]
    assert head[0] == b'P6' and head[3] == b'255', head
    w, h = int(head[1]), int(head[2])
    return w, h, [tuple(body[3 * i:3 * i + 3]) for i in range(w * h)]

def picture(path, size):
    """Any picture file, by way of netpbm, as pixels"""
    if not path.endswith('.ppm'):
        kind = path.rsplit('.', 1)[1]
        tool = {'png': 'pngtopnm', 'tga': 'tgatoppm', 'tif': 'tifftopnm', 'jpg': 'djpeg',
                'gif': 'giftopnm', 'bmp': 'bmptopnm'}[kind]
        ppm_path = path + '.ppm'
        with open(ppm_path, 'wb') as out:
            raw = subprocess.run([tool, path], stdout=subprocess.PIPE, check=True).stdout
            if not raw.startswith(b'P6'):
                raw = subprocess.run(['pnmtopnm' if 0 else 'ppmtoppm'], input=raw, stdout=subprocess.PIPE).stdout or \
                    subprocess.run(['pgmtoppm', 'white'], input=raw, stdout=subprocess.PIPE, check=True).stdout
            out.write(raw)
        path = ppm_path
    w, h, pixels = ppm(path)
    assert (w, h) == (size, size), (path, w, h)
    return pixels

def run_tool(command, folder, **more):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          timeout=300, **more)
    if done.returncode:
        raise SystemExit(f'{command}: {done.stdout.decode(errors="replace")[-2000:]}')
    return done.stdout.decode(errors='replace')

def lines(program, lamp, cases, draw, at):
    for case in cases:
        pixels = draw(case, SIZE)
        lamps = ' '.join(words(lamp, l) for l in case.lamps)
        yield f'case {case.camera} {words(program, case.material)} {lamps}'.rstrip()
        yield ' '.join('%02x%02x%02x' % pixels[y * SIZE + x] for x, y in at)

def main(program, about, cases, draw, lamp='lamp', head='', table=None, ball=None):
    """about: version and package.  head: further lines of the table, such as 'within 2.7'.
    ball: the case of the ball in README, grey, drawn with 96 pixels"""
    table = table or program
    path = os.path.join(TABLES, table + '.txt')
    at = positions()
    text = f'# {about}\n# drawn by measure/{os.path.basename(sys.argv[0])}\n{head}'
    text += 'pixels ' + ' '.join(f'{x},{y}' for x, y in at) + '\n'
    text += '\n'.join(lines(program, lamp, cases, draw, at)) + '\n'
    files = [(path, text.encode())]
    if ball:
        grey = bytes(p[1] for p in draw(ball, 96))
        said = ' '.join([words(program, ball.material)] + [words(lamp, l) for l in ball.lamps])
        head = f'P5\n# {ball.camera} {said}\n96 96\n255\n'
        files.append((path[:-4] + '.pgm', head.encode() + grey))
    changed = 0
    for name, data in files:
        if '--write' in sys.argv:
            open(name, 'wb').write(data)
        elif open(name, 'rb').read() != data:
            changed = 1
    print(f'{table}: {len(cases) * COUNT} pixels' + (', not those of the table' if changed else ''))
    if changed:
        sys.exit(1)
