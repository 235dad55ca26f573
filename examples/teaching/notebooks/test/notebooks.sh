#!/bin/sh
# notebooks.sh - the notebook of each course is run as Jupyter runs it; its cells compare NumPy with shade.h.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
B=examples/teaching/notebooks P=examples/packages/python
python=
for python in python3 /usr/bin/python3 ""; do
    [ -z "$python" ] || $python -c 'import numpy, nbclient, ipykernel' 2>/dev/null && break
done
[ "$python" ] || { left_out "all of it: no NumPy, nbclient, ipykernel (python3-nbclient python3-ipykernel)"; finish; }
mkdir "$T/books"
cp -R $P/shade_h "$T"
check "the library" ${CC:-cc} -O1 -w -std=gnu99 -D_DEFAULT_SOURCE -ffp-contract=off -I. -I$P -shared -fPIC \
    -o "$T/shade_h/libshade.so" $P/library.c -lm -pthread
cp $B/*.ipynb $B/ball.py "$T/books"
cat >"$T/run.py" <<'END'
"""Runs a notebook; prints its cells of code, their pictures, and the comparisons that they make."""
import os
import sys

import nbclient
import nbformat

os.chdir(os.path.dirname(sys.argv[1]))
book = nbformat.read(sys.argv[1], 4)
nbformat.validate(book)
client = nbclient.NotebookClient(book, timeout=600, kernel_name="python3", resources={"metadata": {"path": "."}})
client.execute()
cells = [cell for cell in book.cells if cell.cell_type == "code"]
pictures = sum("image/png" in out.get("data", {}) for cell in cells for out in cell.outputs)
said = sum(out.get("text", "").count("apart") for cell in cells for out in cell.outputs)
print(len(cells), pictures, said)
END
ran() { PYTHONPATH="$T:$T/books" PYTHONDONTWRITEBYTECODE=1 PYTHONWARNINGS=ignore $python "$T/run.py" "$T/books/$1.ipynb" 2>"$T/error"; }
for course in uw massey shirley berkeley; do
    ran $course >"$T/said"
    status=$?
    check "$course runs" test $status -eq 0
    [ $status -eq 0 ] || { tail -n 12 "$T/error"; continue; }
    read -r cells pictures said <"$T/said"
    check "$course: $cells cells, nearly all with a picture: $pictures" test $((pictures + 4)) -ge "$cells"
    check "$course: $said comparisons" test "$said" -ge 8
done
for number in 1 2 3 4 5 6 7 8 9 10 11; do
    check "shirley has (10.$number)" grep -qF "(10.$number)" $B/shirley.ipynb
done
check "notebooks are kept without what they gave" no grep -l '"outputs": \[$' $B/*.ipynb
# and they see what is wrong
sed 's/I_L \* B \* (k_d \* dot(N, L) + k_s \* plus(dot(N, H)) \*\* n_s)/I_L * (k_d * dot(N, L) + k_s * plus(dot(N, H)) ** n_s)/' \
    $B/uw.ipynb >"$T/books/wrong.ipynb"
check "one line is changed" no cmp -s $B/uw.ipynb "$T/books/wrong.ipynb"
ran wrong >"$T/said"
check "a formula without B stops its cell" test $? -ne 0
check "and says by how much" grep -q 'AssertionError.*: 0\.' "$T/error"
finish
