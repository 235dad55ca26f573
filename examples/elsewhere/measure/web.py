"""Programs of the npm registry, drawn by a headless chromium (Debian: chromium):

    npm install --prefix DIR PACKAGES
    packages: three@0.187.0 babylonjs@9.35.0 x_ite@15.0.1 x3dom@1.8.3 p5@1.11.13 processing-js@1.6.6
    packages: @xeokit/xeokit-sdk@2.6.114 @kitware/vtk.js@37.4.3 playcanvas@2.23.3 seen@0.2.7 esbuild@0.25.12
    packages: @deck.gl/core@9.4.0 @deck.gl/mesh-layers@9.4.0 @luma.gl/engine@9.4.2
    MODULES=DIR/node_modules python3 web.py three_phong babylon ... [--write]

Without names all of them.  web/PAGE.js draws a case on a canvas.

Guesses before anything was drawn, and what became of them:
  deck.gl        (N.H)^n, V to the camera's point, not gated       gated, else right
  Processing.js  (R.V)^n, gated, at vertices                       (N.H)^n; length of a direction, falloff of ambient light not thought of
  PlayCanvas     GGX of roughness (1 - gloss)^2                    wrong: (n + 2)/8 (N.H)^n, n = 2^(11 gloss)
  MTLLoader      (written after its source was read)
"""
import http.server, json, os, signal, subprocess, sys, tempfile, threading
from urllib.parse import urlparse
import ball
from ball import *

MODULES = os.environ.get('MODULES', os.path.join(os.getcwd(), 'node_modules'))
KINDS = {'.js': 'text/javascript', '.mjs': 'text/javascript', '.html': 'text/html',
         '.css': 'text/css', '.json': 'application/json', '.wasm': 'application/wasm'}

BUNDLED = ('vtkjs', 'deck')    # whose modules a browser cannot load as they are; by esbuild@0.25.12 (npm)

def bundle(page):
    done = subprocess.run([os.path.join(MODULES, '.bin', 'esbuild'), os.path.join(HERE, 'web', page + '.js'), '--bundle',
                           '--format=esm', '--log-level=error'], stdout=subprocess.PIPE, env=dict(os.environ, NODE_PATH=MODULES), check=True)
    return done.stdout

def pictures(page, asked):
    """asked: cases as dictionaries with a size each.  Returns their pixels."""
    got, done, faults = {}, threading.Event(), []
    class Handler(http.server.BaseHTTPRequestHandler):
        def log_message(self, *a): pass
        def answer(self, body, kind='application/json'):
            self.send_response(200)
            self.send_header('Content-Type', kind)
            self.send_header('Content-Length', str(len(body)))
            self.end_headers()
            self.wfile.write(body)
        def do_GET(self):
            path = urlparse(self.path).path
            if path == f'/{page}.js' and page in BUNDLED: return self.answer(bundle(page), 'text/javascript')
            if path == '/cases': return self.answer(json.dumps(asked).encode())
            base = os.path.dirname(MODULES) if path.startswith('/node_modules/') else os.path.join(HERE, 'web')
            if path.startswith('/node_modules/'): base, path = MODULES, path[len('/node_modules'):]
            file = os.path.normpath(base + path)
            if not os.path.isfile(file):
                self.send_error(404)
                return
            self.answer(open(file, 'rb').read(), KINDS.get(os.path.splitext(file)[1], 'application/octet-stream'))
        def do_POST(self):
            body = self.rfile.read(int(self.headers['Content-Length'] or 0))
            url = urlparse(self.path)
            if url.path == '/picture': got[int(url.query)] = body
            if url.path == '/fault': faults.append(body.decode(errors='replace')); done.set()
            if url.path == '/done': done.set()
            self.answer(b'{}')
    server = http.server.ThreadingHTTPServer(('127.0.0.1', 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as folder:
        browser = subprocess.Popen(
            ['chromium', '--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
             '--disable-background-networking', '--use-gl=angle', '--use-angle=swiftshader',
             '--enable-unsafe-swiftshader', '--force-color-profile=srgb', '--window-size=400,400',
             f'--user-data-dir={folder}', f'http://127.0.0.1:{server.server_port}/page.html?{page}'],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        done.wait(240)
        os.killpg(browser.pid, signal.SIGTERM)
        browser.wait()
    server.shutdown()
    if faults or len(got) != len(asked):
        raise SystemExit(f'{page}: {len(got)} of {len(asked)} pictures; {faults}')
    return [[tuple(got[i][3 * k:3 * k + 3]) for k in range(len(got[i]) // 3)] for i in range(len(asked))]

def measure(page, program, about, cases, ball=None, head='', lamp='lamp'):
    every_case = [(c, SIZE) for c in cases] + ([(ball, 96)] if ball else [])
    asked = [dict(program=program, parallel=c.parallel, material=c.material, lamps=c.lamps, size=size)
             for c, size in every_case]
    drawn = dict(zip([(id(c), size) for c, size in every_case], pictures(page, asked)))
    main(program, about, cases, lambda c, size: drawn[id(c), size], lamp=lamp, head=head, ball=ball)

POINT = [dict(at=(2, 1.5, 2.5, 1))]
grey = Case('parallel', {}, [dict(at=KEY)])

def three_phong():
    pi = math.pi
    key = [[dict(at=at, intensity=pi)] for at in DIRECTIONS]
    m = [dict(color=ORANGE, specular=(.3, .3, .3), shininess=10), dict(color=(.6, .6, .6), specular=(.05, .05, .05), shininess=30),
         dict(color=BLUE, specular=(.02, .01, 0), shininess=100, emissive=(.05, 0, .1))]
    spots = [[dict(at=(2, 1.5, 2.5, 1), intensity=20, decay=2, distance=8)],
             [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), intensity=30, angle=.3, penumbra=.6, decay=2)]]
    measure('three', 'three_phong', 'three 0.187.0 MeshPhongMaterial (npm)', every(m, key) + every(m[:1], spots),
            Case('parallel', dict(color=(.6, .6, .6), specular=(.2, .2, .2), shininess=30), [dict(at=KEY, intensity=pi)]), lamp='three_lamp', head='ambient .25\n')

def three_toon():
    m = [dict(color=ORANGE), dict(color=(.6, .6, .6)), dict(color=BLUE)]
    measure('three', 'three_toon', 'three 0.187.0 MeshToonMaterial without gradientMap (npm)',
            every(m, [[dict(at=at, intensity=3)] for at in DIRECTIONS]), lamp='three_lamp', head='ambient .25\n')

def three_lambert():
    m = [dict(color=ORANGE), dict(color=(.6, .6, .6)), dict(color=BLUE)]
    measure('three', 'three_lambert', 'three 0.187.0 MeshLambertMaterial (npm)',
            every(m, [[dict(at=at, intensity=3)] for at in DIRECTIONS]), lamp='three_lamp', head='ambient .25\n')

def three_mtl():
    m = [dict(Kd=ORANGE, Ks=(.5, .5, .5), Ns=10, illum=2), dict(Kd=(.6, .6, .6), Ks=(.3, .3, .3), Ns=30, illum=1),
         dict(Kd=BLUE, Ks=(.2, .1, 0), Ke=(.1, 0, .2), Ns=100, illum=0)]
    measure('three', 'three_mtl', 'three 0.187.0 MTLLoader (npm)', every(m, [[dict(at=at, intensity=math.pi)] for at in DIRECTIONS]), lamp='three_lamp', head='ambient .25\n')

def babylon():
    m = [dict(diffuse=(.6, .3, .12), specular=(.3, .3, .3), power=10), dict(diffuse=(.6, .6, .6), specular=(.8, .8, .8), power=30),
         dict(diffuse=(.14, .28, .63), specular=(.5, .4, .3), power=100, emissive=(.04, .08, .18), ambient=(.4, .2, .8))]
    lamps = [[dict(at=(2, 1.5, 2.5, 1))], [dict(at=(2, 1.5, 2.5, 1), range=6)],
             [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), angle=.6, exponent=8)]]
    measure('babylon', 'babylon', 'Babylon.js 9.35.0 StandardMaterial (npm)', every(m, directions()) + every(m[:1], lamps),
            Case('parallel', m[1], [dict(at=KEY)]), lamp='babylon_lamp', head='ambient .25\n')

X3D = [dict(diffuseColor=(.6, .3, .12), specularColor=(.3, .3, .3), shininess=.08),
       dict(diffuseColor=(.6, .6, .6), specularColor=(.8, .8, .8), shininess=30 / 128),
       dict(diffuseColor=(.14, .28, .63), specularColor=(.5, .4, .3), shininess=.8, emissiveColor=(.04, .08, .18))]

def x_ite():
    lamps = [[dict(at=(2, 1.5, 2.5, 1), attenuation=(0, .3, .05))], [dict(at=(2, 1.5, 2.5, 1), attenuation=(.2, .1, 0), radius=3)],
             [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), beamWidth=.15, cutOffAngle=.35)],
             [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), beamWidth=.5, cutOffAngle=.25)]]
    measure('x_ite', 'x_ite', 'X_ITE 15.0.1 (npm)', every(X3D, directions()) + every(X3D[:1], lamps),
            Case('parallel', X3D[1], [dict(at=KEY)]), lamp='x3d_lamp', head='ambient 0\n')

def x3dom():
    measure('x3dom', 'x3dom', 'X3DOM 1.8.3 (npm)', every(X3D, directions()), Case('parallel', X3D[1], [dict(at=KEY)]),
            lamp='x3d_lamp', head='within 2.5\nambient 0\n')

def p5():
    m = [dict(fill=(.6, .3, .12), specular=(.2, .2, .2), shininess=10), dict(fill=(.6, .6, .6), specular=(.4, .4, .4), shininess=30),
         dict(fill=(.2, .4, .8), specular=(.3, .2, .1), shininess=100)]
    measure('p5', 'p5', 'p5.js 1.11.13 (npm)', every(m, directions()) + every(m[:1], [[dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))]]),
            Case('parallel', dict(fill=(.6 / .73,) * 3, specular=(.4, .4, .4), shininess=30), [dict(at=KEY)]), lamp='p5_lamp', head='ambient 0\n')

def xeokit():
    m = [dict(diffuse=(.6, .3, .12), specular=(.3, .3, .3), shininess=10), dict(diffuse=(.6, .6, .6), specular=(.8, .8, .8), shininess=30),
         dict(diffuse=(.14, .28, .63), specular=(.5, .4, .3), shininess=100, emissive=(.04, .08, .18))]
    measure('xeokit', 'xeokit', 'xeokit 2.6.114 PhongMaterial (npm)', every(m, directions()), Case('parallel', m[1], [dict(at=KEY)]), head='ambient 0\n')

def vtkjs():
    m = [dict(color=ORANGE, specular_color=WHITE, ambient=.1, diffuse=.6, specular=.3, power=10),
         dict(color=WHITE, specular_color=WHITE, ambient=0, diffuse=.6, specular=.8, power=30),
         dict(color=BLUE, specular_color=(1, .8, .6), ambient=.2, diffuse=.7, specular=.5, power=100)]
    lamps = [[dict(at=(2, 1.5, 2.5, 1), aim=(-2, -1.5, -2.5))], [dict(at=(2, 1.5, 2.5, 1), aim=(-2, -1.5, -2.5), cone=15, exponent=20)],
             [dict(at=(2, 1.5, 2.5, 1), aim=(-1, 0, 0), cone=120, exponent=20, attenuation=(.5, 0, .1))]]
    measure('vtkjs', 'vtkjs', 'vtk.js 37.4.3 (npm)', every(m, directions()) + every(m[:1], lamps), Case('parallel', m[1], [dict(at=KEY)]), lamp='vtkjs_lamp', head='within 1.6\n')

def deck():
    m = [dict(color=ORANGE, ambient=.1, diffuse=.6, specularColor=(.3, .3, .3), shininess=10),
         dict(color=WHITE, ambient=0, diffuse=.6, specularColor=(.8, .8, .8), shininess=30),
         dict(color=BLUE, ambient=.2, diffuse=.7, specularColor=(.5, .4, .3), shininess=100)]
    measure('deck', 'deck', 'deck.gl 9.4.0 SimpleMeshLayer (npm)', every(m, directions()) + every(m[:1], [POINT, [dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))]]))

def processing():
    m = [dict(fill=ORANGE, ambient=(.4, .4, .4), specular=(.2, .2, .2), shininess=10), dict(fill=(.6, .6, .6), ambient=(0, 0, 0), specular=(.4, .4, .4), shininess=30),
         dict(fill=BLUE, ambient=(.2, .4, .6), specular=(.6, .4, .2), emissive=(.04, .08, .12), shininess=100)]
    lamps = [[dict(at=(10, 10, 10, 0))], [dict(at=(.3, .3, .3, 0))], [dict(at=(1, 1, 3, 1), aim=(-1, -1, -3), angle=.35, concentration=20)]]
    # lightFalloff dims ambient light too: a material without it
    falls = [[dict(at=(2, 1.5, 2.5, 1), attenuation=(.5, .2, .1))]]
    measure('processing', 'processing', 'Processing.js 1.6.6 (npm)', every(m, directions()) + every(m[:1], lamps) + every(m[1:2], falls), lamp='processing_lamp', head=f'ambient {64 / 255:.6f}\n')

def playcanvas():
    m = [dict(diffuse=ORANGE, specular=(.3, .3, .3), gloss=.5), dict(diffuse=(.6, .6, .6), specular=(.8, .8, .8), gloss=.7), dict(diffuse=BLUE, specular=(.5, .4, .3), gloss=.25, emissive=(.2, .1, .3))]
    measure('playcanvas', 'playcanvas', 'PlayCanvas 2.23.3 StandardMaterial (npm)', every(m, directions()), head=f'ambient {.25 ** 2.2:.6f}\n')

PROGRAMS = [three_phong, three_toon, three_lambert, three_mtl, babylon, x_ite, x3dom, p5, xeokit, vtkjs, deck, processing, playcanvas]
if __name__ == '__main__':
    names = [a for a in sys.argv[1:] if not a.startswith('-')]
    failed = 0
    for program in PROGRAMS:
        if names and program.__name__ not in names: continue
        try: program()
        except SystemExit as end:
            if end.code: print(end.code)
            failed |= bool(end.code)
    sys.exit(failed)
