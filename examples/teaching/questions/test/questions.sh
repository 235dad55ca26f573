#!/bin/sh
# questions.sh - the bank of questions of examples/teaching/questions, by bank.py; here are the sheets.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
Q=examples/teaching/questions
there python3 || { left_out "all of it: no python3"; finish; }
python3 $Q/test/bank.py "$T" >"$T/said" 2>&1
check "the bank" test $? -eq 0
tail -n 20 "$T/said"
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
    else left_out "PDF: no chromium"; fi
else left_out "sheets: no pandoc"; fi
finish
