#!/bin/sh
# build.sh [directory] - the pages of four courses beside the playground, with their pictures.
# A line of uw.txt, massey.txt, ... begins with what it is; indented lines continue it:
#     course: number | title         text: a paragraph        slide: heading
#     picture: a file of ../pictures | what it shows          play: the playground's address | words
#     c: a line of C -> its value    ask: a question          answer: its answer
# In text k_a, I_{La} and x^n are lowered and raised, and `code` is code.
cd "$(dirname "$0")" || exit 1
out=${1:-../../build/playground}
mkdir -p "$out/pictures" && out=$(cd "$out" && pwd) || exit 1

escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
# marks up what is not code: k_a, x^n, and single letters as variables, but a, A, C and I
formulas() {
    awk '
        /^(c|play|picture):/ { print "=" $0; print "."; next }
        { n = split($0, part, "`"); for (i = 1; i <= n; i++) print (i % 2 ? ">" : "`") part[i]; print "." }
    ' | sed -E '/^>/{
        s/(^|[^A-Za-z0-9_])([A-Za-z])_\{([^}]*)\}/\1<i>\2<\/i><sub>\3<\/sub>/g
        s/_\{([^}]*)\}/<sub>\1<\/sub>/g
        s/\^\{([^}]*)\}/<sup>\1<\/sup>/g
        s/\^([A-Za-z0-9]+)/<sup>\1<\/sup>/g
        s/(^|[^A-Za-z0-9_])([EIcfknvrL])_([A-Za-z0-9]+)/\1<i>\2<\/i><sub>\3<\/sub>/g
        s/(^|[ (>])I( =|\(| max|:| \+)/\1<i>I<\/i>\2/g
        s/([^A-Za-z0-9'\''<>\/&.])([b-hj-zBD-HJ-Z])([^A-Za-z'\''>\/]|$)/\1<i>\2<\/i>\3/g
        s/([^A-Za-z0-9'\''<>\/&.])([b-hj-zBD-HJ-Z])([^A-Za-z'\''>\/]|$)/\1<i>\2<\/i>\3/g
    }' | awk '
        /^\./ { print line; line = ""; next }
        { kind = substr($0, 1, 1); $0 = substr($0, 2) }
        { line = line (kind == "`" ? "<code>" $0 "</code>" : $0) }'
}
# what is indented belongs to the line before it
joined() { awk '/^ / { sub(/^ +/, " "); printf "%s", $0; next } NR > 1 { print "" } { printf "%s", $0 } END { print "" }'; }

page() {                        # name of a course
    joined <"$1.txt" | escape | formulas | awk '
    function rest() { sub(/^[a-z]*: */, ""); return $0 }
    function cut(mark,   at) {  # splits $0 at a mark into left and right
        at = index($0, mark)
        left = at ? substr($0, 1, at - 1) : $0
        right = at ? substr($0, at + length(mark)) : ""
        sub(/ +$/, "", left); sub(/^ +/, "", right)
    }
    function indexed(text,   name) {    # k_d in a label
        while (match(text, /[kIn]_[A-Za-z]+/)) {
            name = substr(text, RSTART, RLENGTH)
            text = substr(text, 1, RSTART - 1) "<i>" substr(name, 1, 1) "</i><sub>" substr(name, 3) \
                   "</sub>" substr(text, RSTART + RLENGTH)
        }
        return text
    }
    function finish() { if (open) print "</div></article>"; open = 0 }
    /^course:/ { rest(); cut("|"); print "<h1>" left "</h1>\n<p class=\"about\">" right "</p>"; next }
    /^slide:/ {
        finish(); rest()
        print "<article id=\"" ++count "\"><h2><a href=\"#" count "\">" $0 "</a></h2>"
        waiting = open = 1; next
    }
    /^picture:/ {
        rest(); cut("|"); file = "pictures/" left ".png"
        command = "od -An -tu1 -j16 -N8 ../" file; command | getline size; close(command)
        split(size, byte)           # width and height of a PNG
        print "<a class=\"picture\" href=\"" file "\"><img src=\"" file "\" alt=\"" right \
              "\" width=\"" 256 * byte[3] + byte[4] "\" height=\"" 256 * byte[7] + byte[8] \
              "\" loading=\"lazy\"></a>"
        next
    }
    waiting { print "<div class=\"words\">"; waiting = 0 }
    /^text:/ { print "<p>" rest() "</p>" }
    /^play:/ {
        rest(); cut("|")
        print "<p class=\"play\"><a href=\"index.html#turn=0&amp;" left "\">" indexed(right) "</a></p>"
    }
    /^c:/ {
        rest(); cut(" -&gt; ")
        print "<pre><code>" left "</code>" (right == "" ? "" : " <b>= " right "</b>") "</pre>"
    }
    /^ask:/ { print "<details><summary>" rest() "</summary>" }
    /^answer:/ { print "<p>" rest() "</p></details>" }
    END { finish() }'
}
course_page() {
    title=$(sed -n 's/^course: *\([^|]*\) |.*/\1/p' "$1.txt")
    echo '<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src '"'none'"';
    style-src '"'unsafe-inline'"'; img-src '"'self'"' data: file:">
<link rel="icon" href="data:,">'
    echo "<title>$title, slide by slide - shade.h</title>"
    echo '<style>'; cat course.css; echo '</style></head><body><nav>'
    for other in $COURSES; do
        [ "$other" = "$1" ] && here=' aria-current="page"' || here=
        echo "<a href=\"course-$other.html\"$here>$(sed -n 's/^course: *\([^,|]*\).*/\1/p' "$other.txt" | sed 's/ $//')</a>"
    done
    echo '<a href="index.html">Playground</a></nav><main>'
    page "$1" >"$out/page" || return
    sed -n '/^<h1>/,/^<p class="about">/p' "$out/page"
    echo '<details class="contents"><summary>Slides</summary><ol>'
    sed -n 's|^<article[^>]*><h2>\(.*\)</h2>|<li>\1</li>|p' "$out/page"
    echo '</ol></details>'
    sed '/^<h1>/d; /^<p class="about">/d' "$out/page"
    rm -f "$out/page"
    echo '<article id="point"><h2>The point of the C lines</h2><div class="words"><p>Values beside C
lines are those of this point, and are computed anew whenever the project is tested.</p><pre><code>'
    escape <point.h
    echo '</code></pre></div></article></main></body></html>'
}
COURSES="uw massey shirley berkeley"
for course in $COURSES; do
    course_page $course >"$out/course-$course.html" || exit 1
    for picture in $(sed -n 's/^picture: *\([^ |]*\).*/\1/p' $course.txt); do
        cp "../pictures/$picture.png" "$out/pictures/" || exit 1
    done
done
echo "courses: $out/course-uw.html and three more"
