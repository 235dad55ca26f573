#!/bin/sh
# playground.sh - builds the playground and tries it in a browser.  What that needs - clang and lld
# for wasm32, node, chromium, npm's playwright-core - is named and left out where it is missing.
cd "$(dirname "$0")/../../../.." || exit 1
CC=${CC:-cc}
B=build/playground
DRIVER=build/playwright            # npm's packages
VERSION=1.65.1

leave_out() { echo "playground: no $1: left out"; echo "0 passed, 0 failed"; exit 0; }

mkdir -p $B || exit 1
rm -f $B/index.html
command -v "${CLANG:-clang}" >/dev/null 2>&1 && command -v wasm-ld >/dev/null 2>&1 ||
    leave_out "clang and lld for wasm32"
sh examples/teaching/playground/build.sh || { echo "0 passed, 1 failed"; exit 1; }
! command -v pandoc >/dev/null 2>&1 || sh examples/teaching/course/build.sh ||
    { echo "0 passed, 1 failed"; exit 1; }
command -v node >/dev/null 2>&1 || leave_out node
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    leave_out chromium
if [ ! -d $DRIVER/node_modules/playwright-core ]; then
    npm install --silent --no-audit --no-fund --prefix $DRIVER playwright-core@$VERSION \
        >build/playwright.log 2>&1 || leave_out "playwright-core (npm could not install it)"
fi

# the page's C and its readers, compiled here
FLAGS="-std=c11 -O2 -Wall -Wextra -Wno-unused-function -ffp-contract=off -I."
${MAKE:-make} -s build/shade.o && $CC $FLAGS examples/teaching/playground/native.c -lm -o $B/native ||
    { echo "0 passed, 1 failed"; exit 1; }
cp examples/teaching/playground/test/playground.mjs examples/teaching/course/test/slides.mjs $DRIVER/
failed=0
if ls $B/slides-*.html >/dev/null 2>&1; then
    node $DRIVER/slides.mjs "$PWD/$B" "$browser" || failed=1
else echo "slides: no pandoc, or no reveal.js of npm: left out"; fi
node $DRIVER/playground.mjs "$PWD/$B/index.html" $B/native "$CC" "$browser" && [ $failed = 0 ]
