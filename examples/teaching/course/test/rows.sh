#!/bin/sh
# rows.sh - the courses say what the lecture notes say: examples/teaching/course/rows.txt has each
# equation with its number, each name of a listing, each figure, and where it stands.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
COURSE=examples/teaching/course
COURSES="uw massey shirley berkeley"

cat >"$T/rows.awk" <<'END_OF_AWK'
# TeX as in rows.txt: no commands of spacing and type, no braces; fractions as (a)/(b)
function unbraced(s, before, after,    a, b) {
    while (match(s, before "[{][^{}]*[}]")) {
        a = substr(s, 1, RSTART - 1)
        b = substr(s, RSTART + RLENGTH)
        s = substr(s, RSTART, RLENGTH)
        sub("^" before "[{]", after, s)
        sub(/[}]$/, "", s)
        s = a s b
    }
    return s
}
function plain(s,    a, b) {
    gsub(/\\(begin|end)[{][a-z]+[}]|\\[Bb]ig[{]?|\\[,;!:{}]|\\q?quad|[&]|\\\\/, " ", s)
    s = unbraced(s, "\\\\(mathbf|text|mathrm)", "")
    s = unbraced(s, "\\^", "^")
    s = unbraced(s, "_", "_")
    while (match(s, /\\frac[{][^{}]*[}][{][^{}]*[}]/)) {
        a = substr(s, 1, RSTART - 1)
        b = substr(s, RSTART + RLENGTH)
        s = substr(s, RSTART + 5, RLENGTH - 5)
        sub(/[}][{]/, ")/(", s)
        sub(/^[{]/, "(", s)
        sub(/[}]$/, ")", s)
        s = a s b
    }
    gsub(/\\cdot */, ".", s)
    gsub(/\\le /, "<= ", s)
    gsub(/\\ge /, ">= ", s)
    gsub(/\\propto/, "~", s)
    gsub(/[\\{}]/, "", s)
    return s
}
function tight(s) { gsub(/[ \n]/, "", s); return s }
function words(key, s) {        # in small letters, without marks; made once
    if (key in said) return said[key]
    gsub(/\]\([^)]*\)/, "]", s)
    gsub(/[\[\]$`*]/, "", s)
    s = tolower(plain(s))
    gsub(/[ \n]+/, " ", s)
    return said[key] = s
}
function say(text) { print FILENAME ":" FNR ": " text; failed = 1 }
function numbers(s,    all) {
    while (match(s, /\([0-9]+\.[0-9]+\)/)) {
        all = all substr(s, RSTART + 1, RLENGTH - 2) " "
        s = substr(s, RSTART + RLENGTH)
    }
    return all
}
function equation(s) {          # of a slide: each part of it with a number of its own
    segment[slide, ++segments[slide]] = tight(plain(s))
    number[slide, segments[slide]] = numbers(s)
    line[slide, segments[slide]] = FNR
}
function declared(s,    type, name, n, i) {
    sub(/ *(=|;).*/, "", s)
    match(s, /^[a-z]+ [a-z0-9]+ /)
    type = substr(s, 1, RLENGTH)
    n = split(substr(s, RLENGTH + 1), name, / *, */)
    for (i = 1; i <= n; i++) declares[slide, type name[i]] = FNR
}
function entered(    rest, inner, part, n, i) {
    if (/^\$\$/) {
        rest = $0
        gsub(/\$\$/, "", rest)
        n = split(rest, part, /, *\\q?quad/)
        for (i = 1; i <= n; i++) equation(part[i])
    } else if (!code) {
        rest = $0
        while (match(rest, /\$[^$]+\$/)) {
            inner = substr(rest, RSTART + 1, RLENGTH - 2)
            rest = substr(rest, RSTART + RLENGTH)
            equation(inner)
        }
    }
    if (/^<details>/) asking = 1
    if (/^<\/details>/) asking = 0
    if (!asking && (/^!\[/ || /playground\/index.html#/)) pictured[slide] = 1
    if (code == "glsl" && /^(in|out|uniform) /) declared($0)
}
FNR == 1 { file++ }
file <= courses {               # slides
    if (FNR == 1) {
        course = FILENAME
        gsub(/.*\/|\.md$/, "", course)
        slide = course SUBSEP "page"
    }
    if (/^## /) {
        slide = substr($0, 4)
        sub(/ · .*/, "", slide)
        slide = course SUBSEP slide
        if (slide in raw) say("two slides of one name")
    }
    if (/^```/) code = code ? "" : substr($0, 4)
    raw[slide] = raw[slide] $0 "\n"
    all[course] = all[course] $0 "\n"
    entered()
    next
}
/^#/ || !NF { next }
{
    if (split($0, f, / [|] /) != 5) { say("not five columns"); next }
    rows++
    if (f[3] != "-") known[f[1], f[2] == "figure", f[3]] = 1
    places = split(f[5], place, /; /)
    for (p = 1; p <= places; p++) held(f[1], f[2], f[3], f[4], place[p])
}
function wrong(what) { say("\"" here "\" " what) }
function held(course, kind, nr, what, at,    key, text, i, n, part, found) {
    here = at
    key = course SUBSEP at
    if (at == "page") text = all[course]
    else if (at ~ /\.(c|h|md)$/) text = whole("examples/" at)
    else text = raw[key]
    if (text == "") { say("no " at); return }
    if (kind == "equation") {
        for (i = 1; i <= segments[key]; i++)
            if (index(segment[key, i], tight(what)) && number[key, i] == (nr == "-" ? "" : nr " "))
                found = right[key, i] = 1
        if (!found) wrong("has no " what " numbered " nr)
    } else if (kind == "declares") {
        if (!((key, what) in declares)) wrong("does not declare " what)
        named[key, what] = 1
    } else if (kind == "line") {
        if (!index(tight(text), tight(what))) wrong("has no line " what)
    } else if (kind == "name") {
        if (!index(text, what)) wrong("has no " what)
        if (nr != "-" && !index(text, "(" nr ")")) wrong("has no (" nr ")")
    } else if (kind == "says" || kind == "figure") {
        n = split(tolower(what), part, / *, */)
        for (i = 1; i <= n; i++)
            if (!index(words(key, text), part[i])) wrong("does not say " part[i])
        if (kind == "says") return
        if ((key in raw) && !(key in pictured)) wrong("has no picture")
        if (nr != "-" && !match(text, "figures? ([0-9.]+ and )?" nr)) wrong("is not figure " nr)
    } else say("what is " kind "?")
}
function whole(path,    text, l) {
    while ((getline l <path) > 0) text = text l "\n"
    close(path)
    return text
}
function unknown(path, what) { print path ": what is " what "?"; failed = 1 }
# Numbers that are printed are numbers of the table, and stand beside the equation that has them.
function cited(course, path, text,    s, n, i, nr) {
    n = split(numbers(text), nr, " ")
    for (i = 1; i <= n; i++)
        if (nr[i] ~ /^1[0-9]\./ && !((course, 0, nr[i]) in known)) unknown(path, "(" nr[i] ")")
    while (match(text, /[Ff]igures? [0-9]+\.[0-9]+( and [0-9]+\.[0-9]+)?/)) {
        s = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        sub(/^[A-Za-z]+ /, "", s)
        n = split(s, nr, / and /)
        for (i = 1; i <= n; i++)
            if (!((course, 1, nr[i]) in known)) unknown(path, "figure " nr[i])
    }
}
END {
    for (course in all) cited(course, course ".md", all[course])
    n = split(others, path, " ")
    for (i = 1; i <= n; i++) cited("shirley", path[i], whole(path[i]))
    for (key in number) if (number[key] != "" && !(key in right)) {
        split(key, f, SUBSEP)
        print f[1] ".md:" line[key] ": (" number[key] ") is the number of another equation"
        failed = 1
    }
    for (key in declares) if (!(key in named)) {
        split(key, f, SUBSEP)
        print f[1] ".md:" declares[key] ": no row declares " f[3]
        failed = 1
    }
    if (rows < 200) { print rows + 0 " rows"; failed = 1 }
    exit failed
}
END_OF_AWK

# The table beside courses in a folder, which may be changed ones
held() {
    set -- "$1/uw.md" "$1/massey.md" "$1/shirley.md" "$1/berkeley.md"
    awk -v courses=4 \
        -v others="$(echo examples/README.md examples/lessons/*.md examples/lessons/*.c examples/shared/*.h)" \
        -f "$T/rows.awk" "$@" $COURSE/rows.txt
}
check "each row of the notes stands where rows.txt says" held $COURSE

# and the table sees what drifts: a course, what is changed in it, what is said of that
mkdir "$T/drift"
drifts() {
    for course in $COURSES; do cp "$COURSE/$course.md" "$T/drift"; done
    sed "$2" "$COURSE/$1.md" >"$T/drift/$1.md"
    cmp -s "$COURSE/$1.md" "$T/drift/$1.md" && { echo "sed \"$2\" changes nothing"; return 1; }
    held "$T/drift" >"$T/said" && { echo "nothing is said of sed \"$2\""; return 1; }
    grep -qF -- "$3" "$T/said" || { cat "$T/said"; return 1; }
}
check "another number beside an equation" drifts shirley 's/(10\.3)$/(10.4)/; s/(10\.3)\$\$/(10.4)$$/' "numbered 10.3"
check "a number beside an equation without one" drifts shirley 's/^\(\$\$c .propto .*\)\$\$$/\1 \\qquad (10.1)$$/' "numbered -"
check "a number that the notes have not" drifts shirley 's/^\(\$\$k_w.*\)\$\$$/\1 \\qquad (10.12)$$/' "what is (10.12)?"
check "and in text" drifts uw 's/^Each pixel/By (10.3) each pixel/; s/^It is not physically/By (10.3) it is not/' "what is (10.3)?"
check "a figure that they have not" drifts shirley 's/figure 10\.9/figure 10.10/' "what is figure 10.10?"
check "another equation" drifts uw 's/k_a I_{La} + k_d/k_a I_a + k_d/' 'has no I = k_e + k_a I_La + k_d'
check "a name exchanged in a listing" drifts uw 's/^in vec3 position, vertex_color;/in vec3 position, color;/' "does not declare in vec3 vertex_color"
check "a name that no row has" drifts massey 's/vert_Normal;/vert_Normal, vert_Colour;/' "no row declares in vec4 vert_Colour"
check "a term that becomes something else" drifts massey 's/^vec4 Ta = Ka/vec4 Ta = Ta/' "has no line Ta = Ka * Ia;"
check "captions exchanged" drifts berkeley 's/^## Light leaving in a given direction/## Light leaving here/' "no Light leaving in a given direction"
check "a picture taken away" drifts berkeley '/cosine\.svg/d' "has no picture"

# Where lightness is an amount of light no page may turn it round.
check "no picture is inverted" no grep -rn "invert" $COURSE --include=*.css --include=*.svg --include=*.html
# The curve of the second diffuse plot, against the cosine
check "cosine.svg is one" awk '
    /<polyline/ {
        gsub(/.*points="|".*/, "")
        n = split($0, point, " ")
        for (i = 1; i <= n; i++) {
            split(point[i], xy, ",")
            degrees = (xy[1] - 450) / 3.2
            y = degrees > -90 && degrees < 90 ? 300 - 240 * cos(degrees * 3.14159265 / 180) : 300
            if (xy[2] - y > .06 || y - xy[2] > .06) { print degrees ": " xy[2] ", not " y; failed = 1 }
        }
    }
    END { exit failed || n < 30 }' $COURSE/cosine.svg
finish
