#!/bin/sh
# build.sh [directory] - four courses in Markdown become pages, slides and a first screen, beside the
# playground. Pages need pandoc; slides need reveal.js too, of npm (REVEAL says where it is); with PDF=1
# headless Chromium prints slides with their answers, light and dark, and with PACK=1 all is packed into
# courses.zip. PLAYGROUND names an index.html that was built elsewhere. What is missing is named; where
# what was wanted is not made for that, the status is 1.
cd "$(dirname "$0")" || exit 1
out=${1:-../../../build/playground}
mkdir -p "$out/pictures" && out=$(cd "$out" && pwd) || exit 1
COURSES="uw massey shirley berkeley"

command -v pandoc >/dev/null 2>&1 || {
    echo "courses: nothing is made without pandoc (apt-get install pandoc); read examples/teaching/course/*.md" >&2
    exit 1
}
reveal=${REVEAL:-../../../build/node_modules/reveal.js}
[ -f "$reveal/dist/reveal.js" ] || reveal=
if [ "$reveal" ]; then
    mkdir -p "$out/reveal" &&
    cp "$reveal/dist/reveal.js" "$reveal/dist/reveal.css" "$reveal/dist/plugin/notes.js" "$reveal/LICENSE" \
       "$out/reveal/" || exit 1
    chmod u+w "$out"/reveal/*
else echo "courses: no slides without reveal.js (npm install --no-save --prefix build reveal.js)" >&2; fi
cp ./*.svg "$out/pictures/" || exit 1
# a page that was built elsewhere, as that of a release, serves where there is no clang
[ -f "$out/index.html" ] || [ ! -f "${PLAYGROUND:-}" ] || cp "$PLAYGROUND" "$out/index.html"
live=
[ -f "$out/index.html" ] && live="-M live"

# name of a course, style, more arguments: a page on standard output, or slides with -M deck
made() {
    name=$1 style=$2
    shift 2
    pandoc -f markdown-smart -t html5 --mathml --no-highlight --wrap=none -s --template template.html --lua-filter slides.lua \
        -V "style=$(cat "$style")" -V "script=$(cat deck.js)" -V "point=$(sed 's/&/\&amp;/g; s/</\&lt;/g' point.h)" "$@" "$name.md"
}
for course in $COURSES; do
    made $course course.css -M course=$course $live >"$out/course-$course.html" || exit 1
    rm -f "$out/slides-$course.html"
    [ -z "$reveal" ] || made $course deck.css -M deck -M course=$course $live >"$out/slides-$course.html" || exit 1
    for picture in $(sed -n 's,^!\[.*(\.\./\.\./pictures/\([^ )]*\).*$,\1,p' $course.md); do
        cp "../../pictures/$picture" "$out/pictures/" || exit 1
    done
done

# ---- the first screen: what to open, for whom
title() { sed -n 's/^title: "\(.*\)"$/\1/p' "$1.md"; }
{
    echo '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Four courses - shade.h</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,"><style>'
    cat course.css
    echo '</style></head><body><main><h1>Four courses of local illumination</h1>
<p>Slides are for a hall, pages for reading at a desk or on a telephone.
The <a href="index.html">playground</a> has a slider for every symbol of the equation.</p><ul>'
    for course in $COURSES; do
        echo "<li>$(title $course): "
        [ -z "$reveal" ] || echo "<a href=\"slides-$course.html\">slides</a>, "
        echo "<a href=\"course-$course.html\">page</a></li>"
    done
    echo '</ul></main></body></html>'
} >"$out/courses.html"

# ---- slides with their answers, on paper
if [ "$PDF" ]; then
    browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) &&
    command -v node >/dev/null 2>&1 && [ "$reveal" ] || {
        echo "courses: no PDF without slides, chromium and node (apt-get install chromium nodejs)" >&2
        exit 1
    }
    for scheme in light dark; do
        set --
        [ $scheme = light ] && end=.pdf || end=-dark.pdf
        for course in $COURSES; do
            set -- "$@" "$out/slides-$course.html" "$out/slides-$course$end"
        done
        node print.mjs "$browser" $scheme "$@" || exit 1
    done
fi
if [ "$PACK" ]; then
    command -v zip >/dev/null 2>&1 || { echo "courses: no archive without zip (apt-get install zip)" >&2; exit 1; }
    (cd "$out" && rm -f courses.zip && set -- pictures *.html &&
        for part in reveal slides-*.pdf; do [ ! -e "$part" ] || set -- "$@" "$part"; done &&
        find "$@" -type f | sort | zip -qX9 courses.zip -@) || exit 1
    echo "courses: $out/courses.zip, all of it, for a hall without a network"
fi
echo "courses: $out/courses.html"
