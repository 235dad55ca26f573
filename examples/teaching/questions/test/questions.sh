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
finish
