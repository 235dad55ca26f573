#!/bin/sh
# readme.sh [README] - what the README and the READMEs of rooms show compiles and does what it says.
# Its one block with main is the program: C99, gnu17 behind other headers, C++20; it is run.  The
# other blocks of C make one file, in their order, behind readme_prelude.h, and readme_run.c runs
# them.  SDL2, stb and a C++ compiler are used where they are.  Names, keys and files that the README
# and examples/README.md speak of exist; the C of the latter is recipes.h, which tests/unit/recipes.c
# holds; every public function stands in the README, an example or the bench; every example in
# examples/README.md.
cd "$(dirname "$0")/../.." || exit 1
CC=${CC:-cc}
if [ -z "${CXX:-}" ]; then
    for c in c++ g++ clang++; do command -v $c >/dev/null 2>&1 && CXX=$c && break; done
fi
README=${1:-README.md}
# what continues it, in the order in which its snippets compile, and other pages with names
CONTINUED="examples/lessons/README.md bench/README.md examples/embed/windows.md"
PAGES="$README $CONTINUED examples/README.md examples/embed/opengl.md tests/README.md tests/GUARANTEES.md
    examples/microcontroller/README.md examples/lessons/TEACHING.md examples/teaching/course/README.md"
WARN="-Wall -Wextra -Werror -Wno-missing-field-initializers"
[ -f "$README" ] || { echo "readme: no $README"; echo "0 passed, 1 failed"; exit 1; }
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
passed=0 failed=0

check() {                       # what, command ...
    name=$1; shift
    if "$@" >"$T/log" 2>&1; then passed=$((passed + 1))
    else failed=$((failed + 1)); echo "readme: $name"; sed 's/^/    /;20q' "$T/log"; fi
}
left_out() { echo "readme: no $1: left out"; }
accepts() {                     # compiler, flags, c or c++, text
    printf '%s\n' "$4" | $1 $2 -x "$3" -c - -o "$T/accepted.o" >/dev/null 2>&1
}

# the blocks: program.c once, then snippets, each behind its place in the README
: >"$T/readme_snippets.h"
awk -v dir="$T" '
    function put(   file) {
        file = "readme_snippets.h"
        if (text ~ /SDL_/) file = "readme_sdl.h"
        if (text ~ /stbi_/) file = "readme_stb.h"
        if (text ~ /int main\(/) file = "program.c"
        printf "#line %d \"%s\"\n%s", line, FILENAME, text > (dir "/" file)
        blocks[file]++
    }
    /^```/ {
        if (inside && kind == "c") put()
        inside = !inside; kind = substr($0, 4); text = ""; line = FNR + 1
        next
    }
    inside { text = text $0 "\n" }
    END { if (blocks["program.c"] != 1) print blocks["program.c"] + 0 > (dir "/programs") }
' "$README" $CONTINUED
check "one program" test ! -f "$T/programs"

# the program; the implementation stands in an object that all share
${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
BUILT=-DSHADE__IMPLEMENTED
in_t() { (cd "$T" && "$@"); }
check "the program, C99" $CC -std=c99 $WARN -I. -fsyntax-only "$T/program.c"
check "the program links" $CC -std=c99 $WARN -I. $BUILT "$T/program.c" build/shade.o -lm \
      -o "$T/program"
check "the program runs" in_t ./program
headers='#include <string.h>
#include <math.h>
#include <complex.h>'
{ echo "$headers"; cat "$T/program.c"; } >"$T/behind.c"
if accepts "$CC" -std=gnu17 c "$headers"; then
    check "the program, gnu17 behind other headers" $CC -std=gnu17 $WARN -I. -fsyntax-only "$T/behind.c"
else left_out "gnu17 with complex.h in $CC"; fi
if [ -n "${CXX:-}" ] && accepts "$CXX" -std=c++20 c++ 'struct { int a; } x = { .a = 1 };'; then
    check "the program, C++20" $CXX -std=c++20 $WARN -I. -x c++ -fsyntax-only "$T/program.c"
else left_out "C++20"; fi

# the snippets
sdl=$(sdl2-config --cflags 2>/dev/null)
if [ -n "$sdl" ] && accepts "$CC" "$sdl" c '#include <SDL.h>'; then
    sdl="-DREADME_SDL $sdl $(sdl2-config --libs)"
else sdl=''; fi
stb=''
for dir in $(pkg-config --cflags-only-I stb 2>/dev/null | sed 's/-I//g') /usr/include/stb; do
    accepts "$CC" "-I$dir" c '#include "stb_image_write.h"' && stb="-DREADME_STB -isystem $dir" && break
done
for part in sdl stb; do    # a README without such a snippet fails
    check "a snippet for $part" test -s "$T/readme_$part.h"
done
check "the snippets compile" $CC -std=c99 $WARN -Wno-unused -O1 -I. -I"$T" $BUILT \
      tests/scripts/readme_run.c build/shade.o $stb $sdl -lm -o "$T/readme_run"
if [ -x "$T/readme_run" ]; then
    (cd "$T" && SDL_VIDEODRIVER=dummy ./readme_run teapot.ppm) >"$T/run" 2>&1
    grep -vE '^[0-9]+ passed, ' "$T/run"
    p=$(sed -n 's/^\([0-9]*\) passed, .*/\1/p' "$T/run")
    f=$(sed -n 's/.* passed, \([0-9]*\) failed$/\1/p' "$T/run")
    passed=$((passed + ${p:-0})) failed=$((failed + ${f:-1}))
fi

# names
none() { [ -z "$1" ] || { printf '%s\n' "$1"; return 1; }; }
words() { tr -c 'A-Za-z0-9_' '\n' <"$1" | sort -u; }
words shade.h >"$T/known"
cat $PAGES >"$T/text"
check "each item of a list begins a line" none "$(grep -nE '[.;)] +[*]( +([*][*]|\[)|$)' $PAGES)"
# G12
ran=$(tr '\n' ' ' <"$README" | sed -n 's/.*Where it has been run[^;]*`make matrix` \([^;]*\);.*/\1/p')
check "the machines it has been run on are those of matrix.sh" test \
    "$(echo "$ran" | grep -oE '[a-z]+[0-9]+[a-z0-9]*|armhf' | sort | tr '\n' ' ')" = \
    "$(sed -n 's/^ *one "\([a-z][a-z0-9]*\).*/\1/p' tests/scripts/matrix.sh |
        grep -vxE 'gcc|clang|tcc' | sort -u | tr '\n' ' ')"
for script in matrix windows compilers; do
    check "where it has been run: $script.sh" grep -q "^step .*$script.sh" .ci/run
done
check "Wine runs the runner's tests" grep -q '"$wine" "$T/runner.exe"' tests/scripts/windows.sh
for target in windows-msvc apple-darwin; do
    check "clang compiles for $target" grep -q -- "-$target" tests/scripts/compilers.sh
done
check "every name is one of shade.h" none "$(
    words "$T/text" | grep -E '^(shade|SHADE)_' | grep -vx shade_h |
    comm -23 - "$T/known")"
check "every place is one of shade.h" none "$(
    grep -oE '>>[a-z]+' "$T/text" | sort -u | while read -r place; do
        grep -qE "^(/\*-+ |   )$place" shade.h || echo "$place"
    done)"
check "every source is one of shade.h" none "$(
    grep -oE '\[[A-Z][a-z]+[0-9]+\]' "$T/text" | sort -u | while read -r key; do
        grep -qF -- "$key" shade.h || echo "$key"
    done)"
check "every file is there" none "$(
    grep -oE '(^|[^A-Za-z/])(examples|tests|bench|\.ci)/[A-Za-z0-9_./]*' "$T/text" |
    sed 's/^[^a-z.]//; s/[.]$//' | sort -u | while read -r file; do [ -e "$file" ] || echo "$file"; done)"
check "every example spoken of is there" none "$(
    grep -oE '`[0-9][0-9]_[a-z_]+`' "$T/text" | tr -d '`' | sort -u | while read -r name; do
        [ -f "examples/lessons/$name.c" ] || echo "$name"
    done)"
sed -n '/^```c/,/^```/p' examples/README.md | sed '1d;$d' >"$T/recipes"
sed '1,/^#include/d;/^#endif/d' examples/shared/recipes.h | sed 1d >"$T/recipes_tested"
check "the recipes shown are those tested" diff "$T/recipes" "$T/recipes_tested"
check "every example is listed" none "$(
    for file in examples/lessons/[0-9]*.c; do
        name=$(basename "$file" .c)
        grep -qE "src=\"pictures/$name\.png\".*</a> \| \`$name\`" examples/README.md || echo "$name"
    done)"
check "the teacher's guide has the lessons of each course in the order of its slides" none "$(
    for course in UW:uw Massey:massey Shirley:shirley Berkeley:berkeley; do
        grep -oE 'pictures/[0-9]{2}_' "examples/teaching/course/${course#*:}.md" | grep -oE '[0-9]{2}' | awk '!seen[$0]++' |
            tr '\n' ' ' >"$T/of_slides"
        sed -n "s/^| ${course%:*}, [^|]*| //p" examples/lessons/TEACHING.md | tr -d '|' | tr -s ' ' >"$T/of_guide"
        [ "$(cat "$T/of_slides")" = "$(cat "$T/of_guide")" ] || { echo "$course"; cat "$T/of_slides"; }
    done)"
check "every lesson says the line that builds it" none "$(
    for file in examples/lessons/[0-9]*.c; do
        grep -qE "^   cc -O2 (-fopenmp |-pthread )?-I\. $file -lm( -pthread)? -o ([a-z_]+) && \./\3" "$file" ||
            echo "$file"
    done)"
if command -v tcc >/dev/null; then
    cc -O1 -I. -DSHADE__IMPLEMENTED examples/lessons/46_ambient.c build/shade.o -lm -o "$T/by_cc" &&
        "$T/by_cc" "$T/by_cc.ppm"
    tcc -w -I. examples/lessons/46_ambient.c -lm -o "$T/by_tcc" && "$T/by_tcc" "$T/by_tcc.ppm"
    check "a lesson built by tcc draws the same picture" cmp "$T/by_cc.ppm" "$T/by_tcc.ppm"
else left_out tcc; fi
# A lesson with stb's writer: by its line, as PNG, the colours of the PPM
if echo | cc -fsyntax-only -include stb/stb_image_write.h -x c - 2>/dev/null &&
    command -v pngtopnm >/dev/null; then
    cc -O2 -DCANVAS_STB -I. examples/lessons/46_ambient.c -lm -o "$T/ambient"
    (cd "$T" && ./ambient && ./ambient ambient.ppm && pngtopnm ambient.png) >"$T/from_png" 2>/dev/null
    check "a lesson built with stb writes a PNG of the same colours" cmp "$T/from_png" "$T/ambient.ppm"
    check "a PNG that cannot be written is an error" sh -c "! '$T/ambient' '$T/none/x.png' 2>/dev/null"
else echo "left out: lessons as PNG, no stb (libstb-dev) or pngtopnm (netpbm)"; fi
awk '/^#ifdef SHADE_IMPLEMENTATION/ { exit }
     /^(SHADEDEF|SHADE__INLINE) / && match($0, /shade_[a-z0-9_]+\(/) {
         print substr($0, RSTART, RLENGTH - 1)
     }' shade.h | grep -v shade__ | sort -u >"$T/functions"
cat $PAGES examples/*/*.[ch] examples/*/*/*.[ch] examples/*/*/*/*.[ch] bench/*.[ch] bench/*/*.[ch] >"$T/shown"
words "$T/shown" >"$T/shown_words"
check "more than 90 public functions" test "$(wc -l <"$T/functions")" -gt 90
check "every public function is shown" none "$(comm -23 "$T/functions" "$T/shown_words")"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
