#!/bin/sh
# readme.sh [README] - what the README, the READMEs of rooms and the head of shade.h show compiles and
# does what it says.  The README's one block with main is its program.  It is built by the command of
# its first line in a folder with shade.h and nothing else, without a warning as C and as C++.  Its
# snippets compile behind it there, in their order.  tests/scripts/readme_run.c looks at the pixels that
# programs and snippets draw.  SDL2, stb and a C++ compiler are used where they are.  Names, keys and
# files that the README and examples/README.md speak of exist; the C of the latter is recipes.h, which
# tests/unit/recipes.c holds; every public function stands in the README, an example or the bench;
# every example in examples/README.md.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
find_compilers
README=${1:-README.md}
# what continues it, in the order in which its snippets compile, and other pages with names
CONTINUED="examples/lessons/README.md bench/README.md examples/embed/README.md"
PAGES="$README $CONTINUED examples/README.md examples/embed/opengl.md tests/README.md tests/CALLS.md tests/CHANGING.md tests/GUARANTEES.md
    examples/microcontroller/README.md examples/lessons/TEACHING.md"
# a tarball of the core leaves products, findings and what makes a release out
core='^(examples/(kit|programs|packages|teaching|elsewhere|products)|\.ci|\.github|findings)'
[ -d examples/kit ] && core='^$' PAGES="$PAGES examples/teaching/course/README.md"
WARN="-Wall -Wextra -Werror"
[ -f "$README" ] || { echo "readme: no $README"; echo "0 passed, 1 failed"; exit 1; }

shown() { pngtopnm examples/pictures/knot.png | cmp - "$T/alone/knot.ppm"; }
accepts() {                     # compiler, flags, c or c++, text
    printf '%s\n' "$4" | $1 $2 -x "$3" -c - -o "$T/accepted.o" >/dev/null 2>&1
}

# the blocks, each behind its place in its page; and the program of shade.h's head
mkdir "$T/alone" "$T/head"
cp shade.h "$T/alone"
cp shade.h "$T/head"
: >"$T/alone/snippets.h"
awk -v dir="$T" -v readme="$README" '
    function put(   file) {
        file = FILENAME == readme ? "alone/snippets.h" : "more.h"
        if (text ~ /SDL_/) file = "sdl.h"
        if (text ~ /stbi_/) file = "stb.h"
        if (text ~ /int main\(/) file = "alone/knot.c"
        if (file !~ /knot/) printf "#line %d \"%s\"\n", line, FILENAME > (dir "/" file)
        printf "%s", text > (dir "/" file)
        blocks[file]++
    }
    /^```/ {
        if (inside && kind == "c") put()
        inside = !inside; kind = substr($0, 4); text = ""; line = FNR + 1
        next
    }
    inside { text = text $0 "\n" }
    END { if (blocks["alone/knot.c"] != 1) print blocks["alone/knot.c"] + 0 > (dir "/programs") }
' "$README" $CONTINUED
sed -n 's/^| [^|]*| \("[^"]*"\) |.*/\1,/p' "$README" >"$T/sentences.h"
check "one program" test ! -f "$T/programs"
awk '/#define SHADE_IMPLEMENTATION/ { seen = 1 }
     seen && /^       / { print substr($0, 8) }
     /^       }$/ { exit }' shade.h >"$T/head/triangle.c"

# the programs, in a folder with what the README says to copy
in_folder() { (cd "$T/$1" && shift && "$@"); }
quick_compiler cc "$CC" -O1    # without -O it would draw for 10 s
command=$(sed -n '1s/.* \(cc .*&& [^ ]*\) .*/\1/p' "$T/alone/knot.c" | sed "s|^cc |$T/bin/cc |")
check "the program has its command" test -n "$command"
check "the program, by its command" in_folder alone sh -c "$command"
if command -v pngtopnm >/dev/null; then check "the picture shown is the program's" shown
else left_out "pngtopnm (netpbm)"; fi
${MAKE:-make} -s build/shade.o || { echo "0 passed, 1 failed"; exit 1; }
check "the program of shade.h" in_folder head $CC -std=c99 $WARN -DSHADE__IMPLEMENTED triangle.c \
      "$PWD/build/shade.o" -lm
check "the program of shade.h runs" in_folder head ./a.out
headers='#include <string.h>
#include <math.h>
#include <complex.h>'
for file in alone/knot.c head/triangle.c; do
    check "$file, C99" in_folder ${file%/*} $CC -std=c99 $WARN -fsyntax-only ${file#*/}
    { echo "$headers"; cat "$T/$file"; } >"$T/${file%/*}/behind.c"
    if accepts "$CC" -std=gnu17 c "$headers"; then
        check "$file, gnu17 behind other headers" in_folder ${file%/*} $CC -std=gnu17 $WARN -fsyntax-only behind.c
    else left_out "gnu17 with complex.h in $CC"; fi
done
{ cat "$T/alone/knot.c"; echo 'static shade_vec3 eye;'; cat "$T/alone/snippets.h"; } >"$T/alone/all.c"
check "the snippets, C99" in_folder alone $CC -std=c99 $WARN -Wno-unused -fsyntax-only all.c
for dialect in c++11 c++20; do
    if [ -n "${CXX:-}" ] && accepts "$CXX" -std=$dialect c++ 'int x;'; then
        check "the program and its snippets, $dialect" in_folder alone \
              $CXX -std=$dialect $WARN -Wno-unused -x c++ -fsyntax-only all.c
    else left_out $dialect; fi
done

# the snippets
sdl=$(sdl2-config --cflags 2>/dev/null)
if [ -n "$sdl" ] && accepts "$CC" "$sdl" c '#include <SDL.h>'; then
    sdl="-DREADME_SDL $sdl $(sdl2-config --libs)"
else sdl=''; fi
stb=''
for dir in $(pkg-config --cflags-only-I stb 2>/dev/null | sed 's/-I//g') /usr/include/stb; do
    accepts "$CC" "-I$dir" c '#include "stb_image_write.h"' && stb="-DREADME_STB -isystem $dir" && break
done
for part in more sdl stb; do    # a README without such a snippet fails
    check "a snippet for $part" test -s "$T/$part.h"
done
check "the snippets compile" $CC -std=c99 $WARN -Wno-unused -O0 -I"$T/alone" -I"$T" -I. -Itests/unit \
      -DSHADE__IMPLEMENTED tests/scripts/readme_run.c build/shade.o $stb $sdl -lm -o "$T/readme_run"
if [ -x "$T/readme_run" ]; then
    (cd "$T" && SDL_VIDEODRIVER=dummy ./readme_run alone/knot.ppm head/triangle.ppm) >"$T/run" 2>&1
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
ran=$(sed -n 's/^  | \(wasm32\),.*/\1/p; s/^  | i686; emulated \([^|]*\)|.*/i686, \1/p
    s/^  | emulated \([a-z][^|]*\)|.*/\1/p' "$README")
check "the machines it has been run on are those of matrix.sh" same \
    "$(echo "$ran" | tr -s ', ' '\n' | sort -u | tr '\n' ' ')" \
    "$({ sed -n 's/^ *one "\([a-z][a-z0-9]*\).*/\1/p' tests/scripts/matrix.sh | grep -vxE 'gcc|clang|tcc'
        far_machines | sed 's/^[^ ]* //; s/^arm-.*/armel/; s/^mipsisa/mips/; s/^powerpc64/ppc64/; s/-.*//'
    } | sort -u | tr '\n' ' ')"
check "the lessons that emulators draw are two of three, as user_files.sh has them" same "$(
    sed -n 's|^some_on [0-9]/\([0-9]*\) . qemu.*|\1|p' tests/scripts/user_files.sh |
        awk '{ sum += 1 / $1 } END { printf "%.3f", sum }')" 0.667
check "the boards are those of matrix.sh" same "$(sed -n 's/^  | emulated Cortex-\([^|]*\) |.*/\1/p' "$README")" \
    "$(sed -n 's/^ *arm "Cortex-\([^"]*\)".*/\1/p; s/^ *board "\([a-z][^"]*\)".*/\1/p' tests/scripts/matrix.sh |
        paste -sd , - | sed 's/,/, /g')"
for script in matrix windows compilers; do
    [ ! -f .ci/run ] || check "where it has been run: $script.sh" grep -q "^step .*$script.sh" .ci/run
done
check "Wine runs the runner's tests" grep -q '"$wine" "$T/runner.exe"' tests/scripts/windows.sh
for target in windows-msvc apple-darwin; do
    check "clang compiles for $target" grep -q -- "-$target" tests/scripts/compilers.sh
done
check "every name is one of shade.h" none "$(
    words "$T/text" | grep -E '^(shade|SHADE)_' | grep -vxE 'shade_h|SHADE_INCLUDE_DIRS' |
    comm -23 - "$T/known")"
check "every place is one of shade.h" none "$(
    grep -oE '>>[a-z]+' "$T/text" | sort -u | while read -r place; do
        grep -qE "^(/\*-+ |   )$place" shade.h || echo "$place"
    done)"
check "every source is one of shade.h" none "$(
    grep -oE '\[[A-Z][a-z]+[0-9]+\]' "$T/text" | sort -u | while read -r key; do
        grep -qF -- "$key" shade.h || echo "$key"
    done)"
check "README counts the pictures" test "$(($(ls examples/lessons/[0-9]*.c | wc -l) - 12))" = \
    "$(sed -n 's/.*twelve pictures and \([0-9]*\) more.*/\1/p' "$README")"
check "every file is there" none "$(
    grep -oE '(^|[^A-Za-z/])(examples|tests|bench|\.ci)/[A-Za-z0-9_./]*' "$T/text" |
    sed 's/^[^a-z.]//; s/[.]$//' | sort -u | grep -vE "$core" | while read -r file; do [ -e "$file" ] || echo "$file"; done)"
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
[ ! -d examples/teaching ] || check "the teacher's guide has the lessons of each course" test \
    "$(sed -n '/^| course /,/^$/p' examples/lessons/TEACHING.md)" = "$(sh examples/lessons/guide.sh)"
check "its path has each lesson once" test \
    "$(sed -n '/^## Alone/,/^## What students/s/^[0-9]*\. `\([0-9a-z_]*\)`.*/\1/p' examples/lessons/TEACHING.md | sort)" = \
    "$(cd examples/lessons && ls [0-9]*.c | sed 's/\.c$//')"
check "the table of lessons names the courses that they name" none "$(
    for file in examples/lessons/[0-9]*.c; do
        name=$(basename "$file" .c)
        for course in UW Massey Shirley Berkeley; do
            in_table=$(grep -E "^\| <a.*\`$name\` \| [^|]*\b$course\b[^|]*\|" examples/README.md)
            in_lesson=$(sed '/\*\//q' "$file" | grep -w "$course")
            [ -z "$in_table" ] && [ -z "$in_lesson" ] || { [ "$in_table" ] && [ "$in_lesson" ]; } || echo "$name: $course"
        done
    done)"
check "every lesson says the line that builds it" none "$(
    for file in examples/lessons/[0-9]*.c; do
        grep -qE "^   cc -O2 (-fopenmp |-pthread )?-I\. $file -lm( -pthread)? -o ([a-z_]+) && \./\3" "$file" ||
            echo "$file"
    done)"
# Numbers of the table of lessons are those that the lessons print. The two of 33 are Shirley's course's.
table() { sed -n "s/.*<\/a> | \`\($1\)\` | [^|]* | \(.*\) |\$/\1 \2/p" examples/README.md; }
numbers() { sed 's/[0-9]n//g' "$@" | grep -oE '[0-9][0-9,]*(\.[0-9]+)?(e-[0-9]+)?' | sed 's/,//g; s/e-0/e-/'; }
check "the numbers of the table of lessons are those that are printed" none "$(
    table '[0-9][0-9]_[a-z_]*' | grep -E '[0-9][.,][0-9]| × ' | grep -vE '^33_' | cut -d' ' -f1 >"$T/counting"
    [ "$(wc -l <"$T/counting")" -gt 9 ] || echo "too few lessons print numbers"
    ${MAKE:-make} -s $(sed 's|.*|out/&.ppm|' "$T/counting")
    while read -r name; do
        numbers "out/$name.txt" | sort -u >"$T/printed_numbers"
        table "$name" | cut -d' ' -f2- | numbers | sort -u | comm -23 - "$T/printed_numbers" | sed "s/^/$name: /"
    done <"$T/counting")"
if command -v tcc >/dev/null; then
    cc -O1 -I. -include "$one_sample" -DSHADE__IMPLEMENTED examples/lessons/46_ambient.c build/shade.o -lm \
        -o "$T/by_cc" && "$T/by_cc" "$T/by_cc.ppm"
    tcc -w -I. -include "$one_sample" examples/lessons/46_ambient.c -lm -o "$T/by_tcc" && "$T/by_tcc" "$T/by_tcc.ppm"
    check "a lesson built by tcc draws the same picture" cmp "$T/by_cc.ppm" "$T/by_tcc.ppm"
else left_out tcc; fi
# A lesson with stb's writer: by its line, as PNG, the colours of the PPM
if echo | cc -fsyntax-only -include stb/stb_image_write.h -x c - 2>/dev/null &&
    command -v pngtopnm >/dev/null; then
    cc -O1 -DCANVAS_STB -I. -DSHADE__IMPLEMENTED examples/lessons/46_ambient.c build/shade.o -lm -o "$T/ambient"
    (cd "$T" && ./ambient && ./ambient ambient.ppm && pngtopnm ambient.png) >"$T/from_png" 2>/dev/null
    check "a lesson built with stb writes a PNG of the same colours" cmp "$T/from_png" "$T/ambient.ppm"
    check "a PNG that cannot be written is an error" sh -c "! '$T/ambient' '$T/none/x.png' 2>/dev/null"
else echo "left out: lessons as PNG, no stb (libstb-dev) or pngtopnm (netpbm)"; fi
awk '/^#ifdef SHADE_IMPLEMENTATION/ { exit }
     /^(SHADEDEF|SHADE__EXPORT) / && match($0, /shade_[a-z0-9_]+\(/) {
         print substr($0, RSTART, RLENGTH - 1)
     }' shade.h | grep -v shade__ | sort -u >"$T/functions"
cat $PAGES examples/*/*.[ch] examples/*/*/*.[ch] examples/*/*/*/*.[ch] bench/*.[ch] bench/*/*.[ch] >"$T/shown"
words "$T/shown" >"$T/shown_words"
check "more than 90 public functions" test "$(wc -l <"$T/functions")" -gt 90
[ ! -d examples/kit ] || check "every public function is shown" none "$(comm -23 "$T/functions" "$T/shown_words")"
finish
