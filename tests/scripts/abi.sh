#!/bin/sh
# abi.sh - the interface only grows.  A library of today's header is compared with one of 1.1's
# functions (tests/interface/1.1.h), and programs of 1.0 and 1.1 compile as they were and draw the same
# bits: README's program of 1.0, and in a clone with its history all lessons of both versions.  A new
# version is recorded as the preprocessor gives it, without inline functions, laid out by clang-format.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
I=tests/interface

# ---- functions, types, enumerators
# A struct that has got fields at its end, with a zero that means what was before, or an enum with
# enumerators at its end stands below as abidiff reports it: nothing else of it may have changed, and
# the first new field must begin where the struct ended.  --harmless tells what machine code does not
# see: a field of another name.
cat >"$T/grown" <<'END'
'struct shade_fragments' changed:
  type size changed from 90624 to 91136 (in bits)
  1 data member insertion:
    'shade_vec3 eye', at offset 90624 (in bits)
'struct shade_mesh' changed:
  type size changed from 768 to 832 (in bits)
  1 data member insertion:
    'const uint16_t* indices16', at offset 768 (in bits)
END
library() {                     # header, library
    gcc -std=c99 -w -g -O0 -fPIC -shared -DSHADE_IMPLEMENTATION -x c "$1" -o "$2" -lm -Wl,-soname,libshade.so
}
# The same of declarations alone: each function gets a body.
recorded() {
    awk '/^[a-z]/ { mine = !/^(typedef|enum)/ } mine { sub(/\);$/, ") { for (;;); }") } { print }' "$1" >"$T/recorded.c" &&
        library "$T/recorded.c" "$2"
}
report() {                      # library: what changed but for functions that were added
    abidiff --leaf-changes-only --harmless --no-architecture --no-corpus-path --no-added-syms \
        --no-show-locs "$T/1.1.so" "$1" | grep -v summary: | grep .
}
compared() { report "$1" >"$T/report"; diff "$T/grown" "$T/report"; }
at_the_end() {
    awk '/type size changed from/ { end = $5; first = 1 }
         /, at offset/ && first { first = 0; if ($(NF - 2) != end) { print; bad = 1 } }
         END { exit bad }' "$T/grown"
}
# A copy of the header with one change: the comparison must tell it.
tells() {                       # what, sed's command
    sed "$2" shade.h >"$T/changed.h"
    cmp -s shade.h "$T/changed.h" && { fail "$1: nothing was changed" /dev/null; return; }
    check "$1 compiles" library "$T/changed.h" "$T/changed.so"
    check "$1 is told" no compared "$T/changed.so"
}
if there abidiff && there gcc; then
    check "the library" library shade.h "$T/libshade.so"
    check "the library of 1.1" recorded $I/1.1.h "$T/1.1.so"
    check "1.1's interface is all there, and as it was" compared "$T/libshade.so"
    check "fields are added at the end" at_the_end
    tells "a function of another name" 's/shade_write_ppm/shade_save_ppm/g'
    tells "a field that is wider" 's/^\( *\)float  *shininess;/\1double shininess;/'
    tells "a field of another name" 's/\bshininess\b/gloss/g'
    tells "a wider field of a struct that grew" 's/^    int vertex_count;/    long long vertex_count;/'
    tells "another name in one that grew" 's/\bvertex_count\b/vertices/g'
    tells "another pointer in one that grew" 's/^    const uint32_t \*indices;/    const uint16_t *indices;/'
    tells "two enumerators swapped" 's/SHADE_CULL_NONE = 0, SHADE_CULL_BACK, SHADE_CULL_FRONT/SHADE_CULL_NONE = 0, SHADE_CULL_FRONT, SHADE_CULL_BACK/'
else left_out "the interface of 1.1: no abidiff (abigail-tools) or no gcc"; fi
check "README tells what is deprecated" same "$(grep -c 'Nothing is deprecated today' README.md)" \
    "$(grep -q 'Deprecated since 1\.' shade.h && echo 0 || echo 1)"
# what a library does not show
check "inline functions and flags of 1.1" cc -std=c99 -Wall -Wextra -Werror -I. -fsyntax-only $I/inline.c
if there c++; then check "in C++" c++ -x c++ -w -I. -fsyntax-only $I/inline.c
else left_out "inline functions in C++: no C++ compiler"; fi

# ---- old programs
compiled() {                    # the implementation, once for all programs
    cc -std=c99 -w -O2 -DSHADE_IMPLEMENTATION -I. -x c -c shade.h -o "$T/shade.o" &&
        cc -std=c99 -w -O2 -I. tests/golden/golden.c -o "$T/golden"
}
check "the implementation" compiled
openmp=
echo 'int main(void) { return 0; }' | cc -fopenmp -x c - -o "$T/openmp" 2>/dev/null && openmp=-fopenmp
# source, folder of its headers, version, picture: it compiles as it is and draws that
draws() {
    name=${1##*/} name=${name%.c} place=$2 picture=$4
    cc -std=c99 -w -O2 -ffp-contract=off $openmp -DSHADE__IMPLEMENTED -I"$T/top" -I"$place" "$1" \
        "$T/shade.o" -lm -pthread -o "$T/program" || return 1
    (cd "$T/top" && "$T/program" "$picture") && "$T/golden" --as "$3" "$T/top/$picture"
}
# The header alone, with the teapot where it was then.
mkdir -p "$T/top/examples"
cp shade.h "$T/top" && cp examples/shared/teapot.h "$T/top/examples"
check "README's program of 1.0" draws $I/1.0/teapot.c "$T/top" 1.0 teapot.ppm

# ---- the lessons of both versions from history: before 1.1, and before 1.2
of_history() {                  # first line of the commit after it, version, number of lessons
    next=$(git log -1 --format=%H --grep "^$1" 2>/dev/null)
    mkdir -p "$T/$3" && [ "$next" ] && git archive "$next^" examples 2>/dev/null | tar -x -C "$T/$3" 2>/dev/null ||
        { left_out "$3 lessons before \"$1\": they are in the history of a clone alone"; return; }
    check "lessons" same "$(ls "$T/$3"/examples/[0-9]*.c | wc -l)" "$3"
    for source in "$T/$3"/examples/[0-9]*.c; do
        picture=${source##*/} picture=${picture%.c}.ppm
        case $picture in 16_ray_cast.ppm | 37_rays.ppm)
            continue ;;         # rays have been rounded once, from double, since 1.3
        esac
        check "$picture before \"$1\"" draws "$source" "$T/$3/examples" "$2" "$picture"
    done
}
of_history "Interface 1.1: an error for each kind of argument" 1.0 38
of_history "examples/ in lessons and programs, tests/ in unit and scripts" 1.1 48
finish
