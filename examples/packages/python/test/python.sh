#!/bin/sh
# python.sh - the package for Python: an sdist from the tree and a wheel from that sdist, in
# an empty environment of its own; its tests by pytest; mypy --strict; the notebook.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
quick_compiler cc "$(command -v "${CC:-cc}")"
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE

find_python "numpy, pytest, setuptools, venv, wheel, build"
[ "$python" ] || { left_out "everything: no Python with numpy, pytest, setuptools and build"; finish; }

mkdir -p "$T/tree/examples/packages"
cp shade.h "$T/tree"
cp -R examples/elsewhere examples/shared examples/kit "$T/tree/examples"
cp -R examples/packages/python "$T/tree/examples/packages"
P=$T/tree/examples/packages/python
rm -rf "$P/build" "$P/dist" "$P/headers" "$P"/shade_h/libshade.* "$P"/*.egg-info

# without isolation and index: nothing is fetched
(cd "$P" && $python -m build --no-isolation --outdir "$T/dist" .) >"$T/built" 2>&1 ||
    { fail "an sdist, and a wheel from it" "$T/built"; tail -n 15 "$T/built"; finish; }
check "one wheel for all Pythons" sh -c "ls '$T'/dist/shade_h-*-py3-none-*.whl"
check "the sdist holds shade.h" sh -c "tar tzf '$T'/dist/shade*.tar.gz | grep -q headers/shade.h"
check "an environment" $python -m venv --system-site-packages "$T/env"
python=$T/env/bin/python
check "the wheel can be installed" $python -m pip install -q --no-index --no-deps "$T"/dist/*.whl
cd "$T" || exit 1
check "it is the wheel that is imported" \
    $python -c "import shade_h; assert shade_h.__file__.startswith('$T/env'), shade_h.__file__"

# what the wheel says of itself, and the commands that it installs
told() { $python -c "
import importlib.metadata as m
print('\n'.join(f'{k}: {v}' for k, v in m.metadata('shade-h').items()))" >"$T/told"; }
check "the wheel's description" told
for line in "Author-email: \"The authors of shade.h\" <" "Keywords: 3d,rendering" \
    "Classifier: License :: OSI Approved :: MIT License" "Classifier: Intended Audience :: Developers" \
    "Project-URL: Repository, https://" "Project-URL: Changelog, https://" "Requires-Python: >=3.9"; do
    check "it has ${line%%:*}" grep -q "^$line" "$T/told"
done
check "shade-h draws" sh -c "printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n' >'$T/one.obj' &&
    '$T/env/bin/shade-h' '$T/one.obj' '$T/one.png' --size 32x32 && test -s '$T/one.png'"
check "shade-h without a model: how it is used" sh -c "'$T/env/bin/shade-h' 2>&1 | grep -q '^usage: shade-h '"
for server in "$T/env/bin/shade-h-mcp" "$python -m shade_h.mcp_server"; do
    check "${server##*/} answers" same "$(echo '{"id": 7, "method": "ping"}' | $server)" \
        '{"jsonrpc": "2.0", "id": 7, "result": {}}'
done

# the tests, beside the tree but not beside its sources
mkdir -p "$T/run/examples/packages/python" "$T/run/examples/kit/test" "$T/run/tests"
cp "$OLDPWD"/examples/kit/test/*.json "$T/run/examples/kit/test"
ln -s "$OLDPWD/tests/scripts" "$T/run/tests/scripts"
ln -s "$T/tree/shade.h" "$T/run/shade.h"
cp -R "$P/test" "$P/README.md" "$P/picture.png" "$P/course.ipynb" "$T/run/examples/packages/python"
check "pytest" env CC="$T/bin/cc" $python -m pytest -q -p no:cacheprovider "$T/run/examples/packages/python/test"

# objects that come and go, by a library that stops where memory or behaviour is undefined
address=$(gcc -print-file-name=libasan.so 2>/dev/null) undefined=$(gcc -print-file-name=libubsan.so 2>/dev/null)
if [ -f "$address" ] && [ -f "$undefined" ]; then
    mkdir "$T/checked"
    cp -R "$P/shade_h" "$T/checked"
    quick_compiler gcc "$(command -v gcc)"
    check "the library with sanitizers" "$T/bin/gcc" -w -std=gnu99 -D_DEFAULT_SOURCE -ffp-contract=off \
        -fsanitize=address,undefined -fno-sanitize-recover=undefined -I"$T/tree" -I"$P" -shared -fPIC \
        -o "$T/checked/shade_h/libshade.so" "$P/library.c" -lm -pthread
    check "no undefined behaviour in a Renderer" env ASAN_OPTIONS=detect_leaks=0 \
        LD_PRELOAD="$address $undefined" PYTHONPATH="$T/checked" $python -m pytest -q -p no:cacheprovider \
        "$T/run/examples/packages/python/test/test_living.py" -k "not thousand"
else left_out "the library with sanitizers: no libasan"; fi
check "the scenes of bench/python.py are drawn" sh -c "
    $python '$OLDPWD/bench/python.py' --one shade_h robot 1 1 '$T/robot.npy' | grep -q '\"batch\"'"
check "the scenes of bench/robots.py are drawn" sh -c "
    echo | $python '$OLDPWD/bench/robots.py' --one 'shade.h, chequered and with shadows' 64 0 0.1"
if $python -c 'import mypy' 2>/dev/null; then
    check "mypy --strict" sh -c "cd '$P' && $python -m mypy --strict --cache-dir '$T/mypy'"
else left_out "mypy"; fi
if $python -c 'import nbclient, ipykernel' 2>/dev/null; then
    PYTHONPATH=$($python -c 'import pathlib, shade_h; print(pathlib.Path(shade_h.__file__).parents[1])')
    export PYTHONPATH    # the kernel is the system's Python
    check "the notebook is executed" $python -c "import nbformat, nbclient
nbclient.NotebookClient(nbformat.read('$P/course.ipynb', 4), timeout=300, kernel_name='python3').execute()"
else left_out "the notebook as Jupyter executes it (no nbclient, ipykernel)"; fi
finish
