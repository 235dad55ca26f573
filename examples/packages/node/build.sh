#!/bin/sh
# build.sh [folder] - compiles module.c for WebAssembly with SIMD and writes it as module.js, which
# index.js imports: no file is read and nothing is fetched when the package runs.  Where there is
# node, index.cjs for require follows, with its types and the licences.
cd "$(dirname "$0")" || exit 1
out=${1:-.}
CLANG=${CLANG:-clang}
WARN="-Werror -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef
    -Wno-unused-function"
# The stack lies first: what overflows it is caught.
FLAGS="--target=wasm32-wasi -std=c99 -O2 $WARN -msimd128 -mbulk-memory -mnontrapping-fptoint
    -ffp-contract=off -fno-math-errno -ftls-model=local-exec -mexec-model=reactor -I../../..
    -Wl,--stack-first,-z,stack-size=262144,--strip-all"

if ! echo '#include <stdlib.h>' | $CLANG --target=wasm32-wasi -x c -fsyntax-only - 2>/dev/null; then
    echo "node: no clang with wasi-libc: left out"
    exit 0
fi
$CLANG $FLAGS module.c -o "$out/module.wasm" || exit 1
{
    echo "// made of module.c by build.sh"
    printf 'export default "%s";\n' "$(base64 "$out/module.wasm" | tr -d '\n')"
} >"$out/module.js" && rm "$out/module.wasm" && echo "node: $out/module.js"
[ "$out" = . ] && command -v node >/dev/null || exit 0
# of the C library that the module is linked to; Debian has it there
wasi=/usr/share/doc/wasi-libc/copyright
[ ! -f $wasi ] || cp $wasi NOTICES.txt
cp index.d.ts index.d.cts && cp ../../../LICENSE . && node commonjs.js index.cjs
