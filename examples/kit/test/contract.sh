#!/bin/sh
# contract.sh - every statement, property, element and extension of model files that the lists of
# examples/kit/read name, and one that no list names: each is drawn, told by a warning that names it,
# or refused by its name, in the same words by the programs, the package for Python and that for
# Node.js, as far as these can be built here.
cd "$(dirname "$0")/../../.." || exit 1
. tests/scripts/tools.sh
quick_compiler cc "$(command -v "${CC:-cc}")"
quick_compiler clang "$(command -v "${CLANG:-clang}")"
CC=$T/bin/cc CLANG=$T/bin/clang
export CC CLANG
FLAGS="-std=c99 -I. -ffp-contract=off"
find_python "numpy, setuptools, wheel"
[ "$python" ] || { left_out "the contract: no Python with NumPy, setuptools and wheel"; finish; }
find_libraries
# the names of all formats, one a line: format, kind, name, what becomes of it
cat >"$T/names.c" <<'END'
#include "examples/kit/read/files.h"

int main(void)
{
    static const char *const what[] = { "drawn", "silent", "told", "refused" };
    for (size_t i = 0; i < sizeof model_known / sizeof *model_known; i++)
        for (const known_name *n = model_known[i].names; n->name; n++)
            printf("%s\t%s\t%s\t%s\n", model_known[i].format, model_known[i].kind, n->name,
                   what[n->what]);
    return 0;
}
END
check "the lists" $CC $FLAGS -DSHADE_IMPLEMENTATION "$T/names.c" -lm -o "$T/names"
check "thumbnail" $CC $FLAGS -DSHADE_IMPLEMENTATION -pthread examples/programs/thumbnail/thumbnail.c \
    $ZLIB -lm -o "$T/thumbnail"
mkdir "$T/files" "$T/tree"
cp -R shade.h LICENSE examples "$T/tree"
check "the package for Python" sh -c "cd '$T/tree/examples/packages/python' &&
    $python setup.py -q build_ext --build-lib '$T/python' && cp -R shade_h/. '$T/python/shade_h'"
node=
if there node && sh "$T/tree/examples/packages/node/build.sh" >"$T/log" 2>&1 &&
    [ -f "$T/tree/examples/packages/node/module.js" ]; then
    node=$T/use
    mkdir -p "$node/node_modules"
    ln -s "$T/tree/examples/packages/node" "$node/node_modules/shade-h"
else left_out "Node.js: no node, or no clang for wasm"; fi
contract() {
    "$T/names" | PYTHONPATH="$T/python" PYTHONDONTWRITEBYTECODE=1 \
        $python examples/kit/test/contract.py "$T/files" "$T/thumbnail" $node
}
check "drawn, told or refused" contract
tail -n 1 "$T/log"
finish
