#!/bin/sh
# questions.sh - the bank of questions and the exam sheets of examples/teaching/questions, by bank.py and
# exam.py; here are the sheets.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
Q=examples/teaching/questions
there python3 || { left_out "all of it: no python3"; finish; }
python3 $Q/test/bank.py "$T" >"$T/said" 2>&1
check "the bank" test $? -eq 0
tail -n 20 "$T/said"
python3 $Q/test/exam.py >"$T/said" 2>&1
check "exam sheets" test $? -eq 0
tail -n 20 "$T/said"
check "an exam is written" python3 $Q/exam.py "$T/exam" 12 shirley
for file in exam solution; do
    check "$file.tex is there" test -s "$T/exam/$file.tex"
    if there pdflatex; then
        (cd "$T/exam" && mkdir -p latex && pdflatex -halt-on-error -output-directory latex $file.tex) >"$T/said" 2>&1
        check "LaTeX makes $file.pdf" test -s "$T/exam/latex/$file.pdf"
    fi
done
there pdflatex || left_out "exams as LaTeX sets them: no pdflatex"
if there pandoc; then
    check "the bank is written" python3 $Q/bank.py "$T/out" 7
    for file in questions.xml questions.zip sheet.md solutions.md sheet.html solutions.html; do
        check "$file is there" test -s "$T/out/$file"
    done
    check "the sheet has no solutions" test "$(grep -c '^> ' "$T/out/sheet.md")" -eq 0
    check "formulas became MathML" no grep -q 'class="math' "$T/out/sheet.html"
    if command -v chromium >/dev/null; then
        for file in sheet solutions; do
            check "$file.pdf is a PDF" test "$(head -c 4 "$T/out/$file.pdf")" = %PDF
        done
        for file in exam solution; do
            check "$file.pdf is a PDF" test "$(head -c 4 "$T/exam/$file.pdf")" = %PDF
        done
    else left_out "PDF: no chromium"; fi
else left_out "sheets: no pandoc"; fi
# the package as other systems take it: a converter and a player of QTI, both of npm
VERSION=$(sed -n 's/.*VERSION=\([0-9.]*\).*/\1/p' examples/teaching/playground/test/playground.sh | head -n 1)
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ "$browser" ] && [ -s "$T/out/questions.zip" ] && there npm &&
    npm install --silent --no-audit --no-fund --prefix "$T/npm" "playwright-core@$VERSION" \
        @citolab/qti-convert@0.3.52 @citolab/qti-components@7.27.4 >"$T/log" 2>&1; then
    python3 -m zipfile -e "$T/out/questions.zip" "$T/items"
    cp $Q/test/player.mjs "$T/npm"
    NODE_FOLDER="$T/npm" node "$T/npm/player.mjs" "$T/out/questions.zip" "$T/items" "$browser" >"$T/said" 2>&1
    check "a player of QTI shows and scores the items" test $? -eq 0
    tail -n 10 "$T/said"
else left_out "the bank in a player of QTI: no chromium, or npm could not install one"; fi
finish
