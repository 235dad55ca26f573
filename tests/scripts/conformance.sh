#!/bin/sh
# conformance.sh - tests/conformance: shade.h beside Mesa (OSMesa), pixel by pixel.
# Arguments go to the program: --only TEXT, --pictures FOLDER.
cd "$(dirname "$0")/../.." || exit 1
cc=${CC:-cc}
mkdir -p build
if ! printf '#include <GL/osmesa.h>\nint main(void) { return !OSMesaGetProcAddress; }\n' |
    $cc -x c - -o build/conformance_probe -lOSMesa 2>/dev/null; then
    echo "left out: no OSMesa"; echo "0 passed, 0 failed"; exit 0
fi
$cc -std=c99 -O1 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -I. tests/conformance/main.c \
    tests/conformance/scenes.c tests/conformance/gl.c -lOSMesa -lm -o build/conformance ||
    { echo "0 passed, 1 failed"; exit 1; }
# G11
# llvmpipe in this one thread
GALLIUM_DRIVER=llvmpipe LP_NUM_THREADS=0 build/conformance "$@"
