#!/bin/sh
# course.sh - the pages of the courses: each line of C compiles, its value is what the page says,
# pictures and links are there. rows.sh holds their words to the lecture notes, playground.sh opens
# the links in a browser.
cd "$(dirname "$0")/../../../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}
COURSES="uw massey shirley berkeley"

${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }

# ---- lines of C ---------------------------------------------------------------------------------
{
    cat <<'END'
#include "shade.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static int failed;
/* Half of the last digit that the text gives */
static double half_digit(const char *text)
{
    const char *dot = strchr(text, 46), *e = strchr(text, 101);
    size_t digits = dot ? strspn(dot + 1, "0123456789") : 0;
    return 0.500001 * pow(10, (e ? atof(e + 1) : 0) - (double)digits);
}
static void number(const char *where, double got, const char *text)
{
    if (fabs(got - atof(text)) <= half_digit(text)) return;
    printf("%s: %.9g, not %s\n", where, got, text);
    failed = 1;
}
static void vector(const char *where, shade_vec3 v, const char *x, const char *y, const char *z)
{
    number(where, (double)v.x, x);
    number(where, (double)v.y, y);
    number(where, (double)v.z, z);
}
int main(void)
{
END
    cat examples/teaching/course/point.h
    echo '
static uint32_t pixels[4], texel = 0xFFFFFFFF;
shade_target target = { .width = 2, .height = 2, .color = pixels };
shade_draw_state state = { .material = &brass };
shade_mesh mesh = { 0 };
shade_pipeline pipeline = { 0 };
shade_texture texture = { &texel, 1, 1 };
float t;
(void)R; (void)H; (void)V; (void)lamp; (void)t;'
    for course in $COURSES; do
        awk -v where=$course.md '/^```/ { inside = $0 == "```c"; next } inside && NF {
            at = index($0, " // = "); value = substr($0, at + 6); code = at ? substr($0, 1, at - 1) : $0
            printf "#line %d \"%s\"\n", FNR, where
            place = "\"" where ":" FNR "\""
            if (!at) print "(void)(" code ");"
            else if (value ~ /^\(/) {
                gsub(/[()]/, "", value); gsub(/, */, "\", \"", value)
                print "vector(" place ", " code ", \"" value "\");"
            } else print "number(" place ", (double)(" code "), \"" value "\");"
        }' examples/teaching/course/$course.md
    done
    echo 'return failed; }'
} >"$T/lines.c"
check "lines of C compile" $CC -std=c99 -O0 -w -Werror=implicit -I. -DSHADE__IMPLEMENTED \
      "$T/lines.c" build/shade.o -lm -o "$T/lines"
check "their values are those of the pages" "$T/lines"
check "there are lines of C" test "$(grep -c '^#line' "$T/lines.c")" -ge 60

# ---- what is not made says so --------------------------------------------------------------------
mkdir "$T/few"                  # a path with a few programs, none of which makes a page
for program in sh dirname mkdir rm sed cat cp; do ln -s "$(command -v $program)" "$T/few"; done
nothing() {                     # packages that are named, where status 1 and nothing else is returned
    PATH="$T/few" sh "$1/build.sh" "$T/none" >"$T/said" 2>&1
    [ $? = 1 ] && grep -q "apt-get install $2" "$T/said" && ! ls "$T"/none/*.html 2>/dev/null
}
check "without pandoc: status 1, and its name" nothing examples/teaching/course pandoc
check "without clang: status 1, and its name" nothing examples/teaching/playground "clang lld"

# ---- pages --------------------------------------------------------------------------------------
if ! command -v pandoc >/dev/null 2>&1; then
    left_out "pages: no pandoc"
    finish
fi
check "pages are built" sh examples/teaching/course/build.sh "$T/pages"
# what a reader sees: neither code nor TeX kept beside MathML
for course in $COURSES; do
    sed 's/<annotation[^>]*>[^<]*<\/annotation>//g; s/<pre>.*<\/pre>//; s/<[^>]*>//g' "$T/pages/course-$course.html"
done >"$T/course-words"
links() { grep -ohE '(src|href)="[^"#]+' "$T"/pages/*.html | sed 's/.*"//' | sort -u; }
missing() {
    links | while read -r link; do
        case $link in data:*|index.html) ;; *) [ -s "$T/pages/$link" ] || echo "$link" ;; esac
    done
}
if [ -d build/node_modules/reveal.js ]; then
    for course in $COURSES; do
        check "slides of $course: one at least for each heading" test \
            "$(grep -c '^<section\|^<section class' "$T/pages/slides-$course.html")" -gt \
            "$(grep -c '^## ' "examples/teaching/course/$course.md")"
    done
else left_out "slides: no reveal.js (npm install --no-save --prefix build reveal.js)"
fi
check "pictures and pages are there" same "$(missing)" ""
if command -v zip >/dev/null 2>&1 && command -v unzip >/dev/null 2>&1; then
    echo page >"$T/built.html"
    check "one archive holds all of it" env PACK=1 PLAYGROUND="$T/built.html" sh examples/teaching/course/build.sh "$T/packed"
    check "with each page, picture and script" same \
        "$(links | grep -v '^data:' | while read -r name; do
            unzip -l "$T/packed/courses.zip" "$name" >/dev/null 2>&1 || echo "$name"
        done)" ""
else left_out "the archive: no zip or no unzip"; fi
check "no address of another host" no grep -nE '(src|href)="(https?:)?//' "$T"/pages/*.html
check "each question has its answer" same "$(grep -hc '^<details>' examples/teaching/course/*.md)" \
    "$(grep -hc '^</details>' examples/teaching/course/*.md)"
check "a bracket is as tall as its partner" awk '{
    for (depth = 0; match($0, /<mo stretchy="[a-z]+" form="[a-z]+">[()]<\/mo>/); $0 = substr($0, RSTART + RLENGTH)) {
        mark = substr($0, RSTART, RLENGTH)
        tall = mark ~ /"true"/
        if (mark ~ /\(/) opened[++depth] = tall
        else if (depth && opened[depth--] != tall) { print FILENAME ":" FNR; failed = 1 }
        seen++
    }
} END { exit failed || seen < 150 }' "$T"/pages/course-*.html
check "a comparison has no term's colour" no grep -n '<mi>[eads]</mi></msub><mo>&lt;' "$T"/pages/course-uw.html
check "formulas became MathML" no grep -nE '\$|class="math' "$T"/course-words
lessons() {                     # pictures, and lessons named in text
    grep -ohE '\b[0-9]{2}_[a-z_]+' examples/teaching/course/*.md | sort -u | while read -r name; do
        [ -f "examples/lessons/$name.c" ] || echo "$name"
    done
}
check "lessons that are named are there" same "$(lessons)" ""

finish
