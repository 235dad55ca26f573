#!/bin/sh
# node.sh - the package for JavaScript: packed, installed into an empty folder, README's programs,
# the bytes of the package for Python, PNG files read by Pillow, hostile arguments, and a browser.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
quick_compiler cc "$(command -v "${CC:-cc}")"
there node && there npm || { left_out "everything: no node with npm"; finish; }

mkdir -p "$T/tree" "$T/use"
cp shade.h LICENSE "$T/tree"
mkdir -p "$T/tree/examples/packages"
cp -R examples/elsewhere examples/shared examples/kit "$T/tree/examples"
cp -R examples/packages/python examples/packages/node "$T/tree/examples/packages"
N=$T/tree/examples/packages/node
rm -f "$N/module.js"
# npm pack compiles the module
(cd "$T" && npm pack --silent --offline ./tree/examples/packages/node) >"$T/built" 2>&1 ||
    { fail "npm pack" "$T/built"; finish; }
[ -f "$N/module.js" ] || { left_out "everything: no clang for wasm32 with wasi-libc"; finish; }

cp -R bench "$T/tree"
check "the scene of bench/robots.mjs is drawn" sh -c "
    node '$T/tree/bench/robots.mjs' 0.05 | grep -q '256 x 256: [1-9]'"

# as a user has it: a package of its own, installed without the tree
check "npm pack" test -f "$T"/shade-h-*.tgz
check "npm install" sh -c "cd '$T/use' && npm install --silent --offline --no-audit ../shade-h-*.tgz"
P=$T/use/node_modules/shade-h
check "no file but what runs" same "$(LC_ALL=C ls "$P" | tr '\n' ' ')" \
    "LICENSE NOTICES.txt README.md arguments.js camera.js index.cjs index.d.cts index.d.ts index.js model.js module.js mujoco.js package.json picture.js renderer.js "
awk -v out="$T/use/program" '/^```js$/ { n++; inside = 1; next } /^```/ { inside = 0 }
    inside { print > (out n ".mjs") }' "$N/README.md"
{ sed '/^import/!d' "$T/use/program1.mjs"; cat "$T/use/program2.mjs"; } >"$T/use/both.mjs"
check "README's first program" sh -c "cd '$T/use' && node program1.mjs"
check "README's second program" sh -c "cd '$T/use' && node both.mjs"
cat "$T/use/program3.mjs" - >"$T/use/drawn3.mjs" <<'END'
let seen = 0, red = 0;    // a ball of radius 0.4, 3.82 away, 115.2 pixels a unit at distance 1
for (let i = 0; i < 96 * 128; i++)
    if (ids[2 * i] === ball.number) { seen++; red += color[3 * i] > 2 * color[3 * i + 1]; }
console.log(Math.abs(seen / (Math.PI * 12.1 ** 2) - 1) < 0.05 && red === seen ? "a red ball" : [seen, red]);
END
check "README's third program" same "$(cd "$T/use" && node drawn3.mjs 2>&1)" "a red ball"
cat >"$T/use/part.glb" <<'END'
{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
    "bufferViews":[{"buffer":0,"byteLength":36}],
    "buffers":[{"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END
printf 'mtllib cup.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$T/use/cup.obj"
printf 'newmtl red\nKd 1 0 0\n' >"$T/use/cup.mtl"
check "README's sixth program" sh -c "cd '$T/use' && node program6.mjs && test -s cup.png"
check "README's fifth program" sh -c "cd '$T/use' && node program5.mjs && test -s part.png"
# what commonjs.js does not know is refused: a name that it lost would be undefined
mkdir "$T/joined" && cp "$N/commonjs.js" "$T/joined" && echo '{"type":"module"}' >"$T/joined/package.json"
joined() {                      # statement of part.js, statement of index.js
    echo "$1" >"$T/joined/part.js"; echo "$2" >"$T/joined/index.js"
    node "$T/joined/commonjs.js" "$T/joined/index.cjs" 2>&1 | sed -n 's/^Error: //p'
}
check "a module's names are joined" same "$(joined 'export const A = 0;' 'import { A } from "./part.js";
export const B = 2 + A;')$(node -p "require('$T/joined/index.cjs').B")" 2
check "two names in one export are refused" same "$(joined 'export const A = 0, B = 3;' \
    'import * as part from "./part.js";')" "part.js: a new form of import or export"
check "a name that a module has not is refused" same "$(joined 'export const A = 0;' \
    'import { A, B } from "./part.js";')" "index.js: part.js exports no B"
cat >"$T/use/required.js" <<'END'
const shade = require("shade-h"), { data } = shade.render({ positions: [0, 0, 0, 1, 0, 0, 0, 0, 1] });
import("shade-h").then((other) => {    // a Mesh of one is a Mesh of the other
    const same = Object.keys(shade).every((name) => shade[name] === other[name]);
    console.log(same && data.some((x) => x !== 255) ? "the same module" : "two modules");
});
END
check "require" same "$(cd "$T/use" && node required.js 2>&1)" "the same module"
if there pngtopnm; then
    for picture in "$T/use/gear.png" "$N/../python/picture.png"; do pngtopnm "$picture" >"$picture.ppm"; done
    check "its picture is that of the Python package" cmp "$T/use/gear.png.ppm" "$N/../python/picture.png.ppm"
else left_out "the picture by netpbm"; fi

# what is of npm, of fixed versions, in a folder that no test looks into
if npm install --silent --no-audit --no-fund --prefix "$T/npm" esbuild@0.25.12 typescript@5.9.3 \
    >"$T/log" 2>&1; then
    check "types, both ways of import" node "$N/test/types.mjs" "$T/use" "$T/npm/node_modules"
    if npm install --silent --no-audit --no-fund --prefix "$T/npm7" typescript@7.0.2 >"$T/log" 2>&1; then
        check "types by TypeScript 7" node "$N/test/types.mjs" "$T/use" "$T/npm7/node_modules"
    else left_out "types by TypeScript 7: npm cannot fetch it"; fi
    check "a bundle for a classic script" sh -c "cd '$T/use' &&
        sed 's/writeFile(\(.*\), await \(.*\));/\2.then((x) => console.log(x.length));/
             /node:fs/d; s/^await //' program1.mjs >classic.mjs &&
        '$T/npm/node_modules/.bin/esbuild' --bundle --format=iife --platform=browser classic.mjs \
            --outfile=classic.js --log-level=warning && [ \"\$(node classic.js)\" -gt 10000 ]"
else left_out "types and bundles: npm cannot fetch esbuild and typescript"; fi

cp -R "$N/test" "$T/use/test"
if npm install --silent --no-audit --no-fund --prefix "$T/mujoco" @mujoco/mujoco@3.14.0 >"$T/log" 2>&1; then
    cp -R "$T/mujoco/node_modules/@mujoco" "$T/use/node_modules/"
    check "README's fourth program" same "$(cd "$T/use" && node program4.mjs 2>&1)" \
        "38 2.0527708530426025 0"
    rm -r "$T/use/node_modules/@mujoco"
    check "what MuJoCo steps" env MUJOCO="$T/mujoco/node_modules/@mujoco/mujoco/mujoco.js" \
        RECORDING="$T/tree/examples/packages/python/test/robots.json" \
        sh -c "cd '$T/use' && node --test test/robots.test.js"
else left_out "MuJoCo's engine: npm cannot fetch @mujoco/mujoco"; fi
check "the cases that C and Python run too" env CASES="$PWD/examples/kit/test/cases.json" \
    sh -c "cd '$T/use' && node --test test/cases.test.js"
check "hostile arguments" sh -c "cd '$T/use' && node --test test/hostile.test.js"
check "5,000 mistakes in arguments" env MISTAKES="$PWD/examples/kit/test/mistakes.json" \
    sh -c "cd '$T/use' && node --test test/mistakes.test.js"
check "objects that come and go" sh -c "cd '$T/use' && node --test test/living.test.js"
check "PNG of 16 bits" sh -c "cd '$T/use' && node --test test/png.test.js"
check "looks of other programs" sh -c "cd '$T/use' && node --test test/elsewhere.test.js"

find_python "numpy, setuptools, wheel, PIL"
if [ "$python" ]; then
    check "the package for Python" sh -c "cd '$T/tree/examples/packages/python' &&
        CC='$T/bin/cc' $python setup.py -q build_ext --build-lib '$T/python' && cp shade_h/*.py '$T/python/shade_h'"
    mkdir "$T/oracle"
    check "the scenes in Python" env PYTHONPATH="$T/python" PYTHONDONTWRITEBYTECODE=1 \
        $python "$N/test/oracle.py" "$T/oracle"
    check "the same bytes" env ORACLE="$T/oracle" sh -c "cd '$T/use' && node --test test/same.test.js"
    check "the same PNG files" $python -c "
import sys, pathlib
from PIL import Image
pictures = sorted(pathlib.Path('$T/oracle').glob('*.png'))
for path in pictures:
    assert Image.open(path).convert('RGBA').tobytes() == path.with_suffix('.rgba').read_bytes(), path
sys.exit(len(pictures) < 20)"
else left_out "comparison with Python: no numpy, setuptools or Pillow"; fi

browser=; for name in chromium chromium-browser google-chrome; do there $name && browser=$name; done
if [ "$browser" ]; then
    cp "$P"/*.js "$P"/*.cjs "$T/use/"
    cp "$N/package.json" "$T/use/package.json"
    check "the same bytes in a browser" \
        timeout 180 env ${python:+ORACLE="$T/oracle"} \
        node "$T/use/test/browser.js" $browser --no-sandbox "--user-data-dir=$T/browser"
else left_out "a browser"; fi
finish
