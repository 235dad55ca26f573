#!/bin/sh
# build.sh [directory] - the playground as one page, index.html, with both modules in it.
cd "$(dirname "$0")" || exit 1
out=${1:-../../../build/playground}
CLANG=${CLANG:-clang}
WARN="-Werror -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef"
# -fno-math-errno: sqrt is an instruction.  The stack lies first: what overflows it is caught.
FLAGS="--target=wasm32 -std=c99 -ffreestanding -nostdlib -O2 $WARN -ffp-contract=off -fno-math-errno
    -I../../.. -I. -Wl,--no-entry,--stack-first,-z,stack-size=262144,--strip-all"

if ! echo 'int f(void) { return 0; }' |
     $CLANG --target=wasm32 -nostdlib -Wl,--no-entry -x c - -o /dev/null 2>/dev/null; then
    echo "playground: nothing is made without clang and lld (apt-get install clang lld)" >&2
    exit 1
fi
mkdir -p "$out/include" && out=$(cd "$out" && pwd) || exit 1
for header in errno math stdio stdlib string; do
    echo '#include "libc.h"' >"$out/include/$header.h"
done
$CLANG $FLAGS -isystem "$out/include" page.c -o "$out/plain.wasm" &&
$CLANG $FLAGS -isystem "$out/include" -msimd128 -mbulk-memory page.c -o "$out/simd.wasm" || exit 1

# the pieces in their places; what goes into a JavaScript template needs its \ ` $ escaped
awk -v out="$out" '
    function put(file) { while ((getline line <file) > 0) print line; close(file) }
    function base64(file,   command) {
        command = "base64 <\"" file "\" | tr -d \"\\n\""
        command | getline line; close(command)
        return line
    }
    /^\/\* [a-z]*\.(css|js) \*\/$/ { put($2); next }
    /@look\.h@/ {
        split($0, side, "@look\\.h@"); printf "%s", side[1]
        while ((getline line <"look.h") > 0) { gsub(/[\\`$]/, "\\\\&", line); print line }
        print side[2]; next
    }
    /@by_hand@/ {                      # one function of the lesson
        split($0, side, "@by_hand@"); printf "%s", side[1]
        while ((getline line <"../../lessons/47_by_hand.c") > 0) {
            if (line ~ /^static float of/) inside = 1
            if (inside) { gsub(/[\\`$]/, "\\\\&", line); print line }
            if (line == "}") inside = 0
        }
        print side[2]; next
    }
    /@plain\.wasm@/ {
        split($0, side, /@[a-z]*\.wasm@/)
        print side[1] base64(out "/plain.wasm") side[2] base64(out "/simd.wasm") side[3]; next
    }
    { print }
' index.html >"$out/index.html" && rm -rf "$out/include" "$out"/*.wasm &&
echo "playground: $out/index.html"
