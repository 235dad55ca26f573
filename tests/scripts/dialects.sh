#!/bin/sh
# dialects.sh - shade.h in every dialect and configuration it promises, without a warning; and what
# its objects need and export.  CC and CXX choose the compilers; C++ is left out where there is
# none.  What nothing links or reads is not compiled further than to its warnings, and one object
# serves all programs: OBJECT, where CC has compiled it with all warnings and -O2, or one made here.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
find_compilers
WARN="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef -Werror"

accepts() { $1 $2 -x "$3" -fsyntax-only - </dev/null >/dev/null 2>&1; }   # compiler, flag, language

printf '#include "shade.h"\nint shade_h_alone;\n' >"$T/header.c"
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/impl.c"
cat >"$T/main.c" <<'END'
#include "shade.h"
int other(void);
int main(void)
{
    static float depth[64];
    static unsigned char pixels[256];
    shade_target target = { 8, 8, 0, SHADE_FORMAT_RGBA8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    shade_result cleared;
    target.color = pixels;
    target.depth = depth;
    cleared = shade_clear(&target, shade_v4(1, 1, 1, 1), 1);
    return cleared != SHADE_OK || pixels[255] != 255 || other() != 0;
}
END
cat >"$T/other.c" <<'END'
#include "shade.h"
int other(void);
int other(void) { return shade_result_string(SHADE_OK)[0] == 0; }
END
for f in main other; do
    { printf '#define SHADE_STATIC\n#define SHADE_IMPLEMENTATION\n'; cat "$T/$f.c"; } >"$T/static_$f.c"
done

# the header alone and with its implementation, in every dialect
for std in c99 c11 c17 c2x; do
    accepts "$CC" -std=$std c || { echo "compile: $CC has no -std=$std: left out"; continue; }
    check "header, $std" $CC -std=$std $WARN -I. -fsyntax-only "$T/header.c"
    check "implementation, $std" $CC -std=$std $WARN -I. -fsyntax-only "$T/impl.c"
done
# In C++ an inline function is one function in all files of a program, as modules need it; a
# namespace around the header is refused in one sentence, unless the standard headers stand before it
inline_functions >"$T/inline"
addresses() {                   # name of a function that returns one address after the other
    printf '#include "shade.h"\ntypedef void (*address)();\naddress %s(int i);\n' "$1"
    printf 'address %s(int i)\n{\n    static const address all[] = {\n' "$1"
    sed 's/.*/        (address)\&&,/' "$T/inline"
    printf '        0 };\n    return all[i];\n}\n'
}
one_function_each() {
    test "$(wc -l <"$T/inline")" -gt 50 && addresses first >"$T/first.cpp" &&
        addresses second >"$T/second.cpp" || return 1
    printf '%s\n' 'typedef void (*address)();' 'address first(int), second(int);' 'int main() {' \
        '    int i = 0;' '    while (first(i) && first(i) == second(i)) i++;' \
        "    return i != $(wc -l <"$T/inline") || second(i);" '}' >"$T/both.cpp"
    $CXX -std=c++11 -w -I. "$T/first.cpp" "$T/second.cpp" "$T/both.cpp" -o "$T/both" && "$T/both"
}
namespace() {                   # lines before it
    printf '%s\n' "$@" 'namespace ours {' '#include "shade.h"' '}' \
        'float five();' 'float five() { return ours::shade_length(ours::shade_v3(3, 4, 0)); }' >"$T/ours.cpp"
    $CXX -std=c++11 $WARN -I. -fsyntax-only "$T/ours.cpp"
}
namespace_refused() {           # header that is missing
    set -- $(printf '#include<%s.h>\n' float stddef stdint | grep -v "$1")
    ! namespace "$@" 2>"$T/refusal" && cat "$T/refusal" &&
        [ "$(grep -c 'error: ' "$T/refusal")" -eq 1 ] &&
        grep -q 'error: .*shade__before_the_namespace_include_float_h_stddef_h_stdint_h' "$T/refusal"
}
if [ -n "$CXX" ]; then
    check "inline functions of two files are one" one_function_each
    check "in a namespace" namespace '#include <float.h>' '#include <stddef.h>' '#include <stdint.h>'
    check "in a namespace, with the implementation" namespace '#include <float.h>' '#include <stddef.h>' \
        '#include <stdint.h>' '#include <stdio.h>' '#include <assert.h>' '#define SHADE_IMPLEMENTATION'
    check "in a namespace without headers is refused in one sentence" namespace_refused .
    for h in float stddef stdint; do
        check "in a namespace without $h.h is refused in one sentence" namespace_refused $h
    done
fi
# C before C99 is refused in one sentence; a compiler that states no version, as Microsoft's by
# default, is not refused
one_sentence() {                # option
    ! $CC "$1" -w -I. -fsyntax-only "$T/impl.c" 2>"$T/refusal" || return 1
    [ "$(grep -c 'error: ' "$T/refusal")" -eq 1 ] && grep -q 'error: .*C99 or later' "$T/refusal"
}
printf '#if __STDC_VERSION__ + 0 >= 199901L\n#error\n#endif\n' >"$T/before_c99.c"
for std in c89 gnu89 iso9899:199409; do
    $CC -std=$std -fsyntax-only "$T/before_c99.c" 2>/dev/null || continue
    check "refusal of $std" one_sentence -std=$std
done
check "no version stated" $CC -std=c99 -w -DSHADE_NO_LIBM -U__GNUC__ -U__STDC_VERSION__ -I. \
    -fsyntax-only "$T/header.c"
if [ -n "${CXX:-}" ] && command -v "$CXX" >/dev/null 2>&1; then
    for std in c++11 c++14 c++17 c++20; do
        accepts "$CXX" -std=$std c++ || { echo "compile: $CXX has no $std: left out"; continue; }
        check "header, $std" $CXX -std=$std $WARN -I. -x c++ -fsyntax-only "$T/header.c"
        check "implementation, $std" $CXX -std=$std $WARN -I. -x c++ -fsyntax-only "$T/impl.c"
    done
else
    CXX=
    echo "compile: no C++ compiler: C++ left out"
fi

# words that other headers define as macros: complex.h, altivec.h, iso646.h, ctype.h and termios.h
# of BSD, curses, sys/param.h, X11, Windows, Arduino, Qt, Objective-C; socket calls of lwIP
words="complex imaginary vector pixel _B _C _L _N _P _S _U _X B0 B1 B10 B110 CR0 NL0 TAB0 FF0
    VT0 BS0 ECHO FLUSHO near far huge small hyper interface pascal cdecl NEAR FAR IN OUT OPTIONAL
    CONST VOID BOOL TRUE FALSE ERROR STRICT ABSOLUTE RELATIVE TRANSPARENT OPAQUE ALTERNATE WINDING
    DELETE PI HALF_PI TWO_PI EULER DEG_TO_RAD RAD_TO_DEG HIGH LOW INPUT OUTPUT CHANGE RISING FALLING
    DEFAULT EXTERNAL INTERNAL None True False Bool Status Success Always Above Below unix linux sun
    nil signals slots emit forever LINES COLS MIN_INT environ"
capitals="A B C D E F G H I J K L M N O P Q R S T U V W X Y Z"
calls="min max abs round radians degrees bit word sq constrain map lowByte highByte bitRead bitSet
    major minor makedev index rindex bcopy bzero bcmp MIN MAX howmany roundup setbit clrbit isset
    clear move erase refresh border filter scroll box timeout check verify require foreach RGB TEXT
    LoadImage DrawText GetObject CreateWindow sqrt fabs floor ceil pow exp log sin cos tan fmin fmax
    read write open close select accept send signal"
{
    for h in float stddef stdint math stdio string assert; do echo "#include <$h.h>"; done
    for w in $words $calls $capitals; do echo "#undef $w"; done
    for w in $words $capitals; do echo "#define $w !a macro!"; done
    for w in $calls; do echo "#define $w(...) !a macro!"; done
    cat "$T/impl.c"
} >"$T/poison.c"
check "words that are macros" $CC -std=c99 $WARN -I. -fsyntax-only "$T/poison.c"
[ -z "$CXX" ] ||
    check "words that are macros, C++" $CXX -std=c++11 $WARN -I. -x c++ -fsyntax-only "$T/poison.c"

# capital letters that the command line defines, before the standard headers too; and the small
# ones that >>config leaves to programs
for value in 480 "" "(1 + 2)"; do
    set --
    for w in $capitals; do set -- "$@" "-D$w=$value"; done
    check "capital letters are \"$value\"" $CC -std=c99 $WARN "$@" -I. -fsyntax-only "$T/impl.c"
    [ -z "$CXX" ] || check "capital letters are \"$value\", C++" $CXX -std=c++11 $WARN "$@" -I. \
        -x c++ -fsyntax-only "$T/header.c"
done
{
    for h in float stddef stdint math string; do echo "#include <$h.h>"; done
    for w in e g i j o q; do echo "#define $w !a macro!"; done
    cat "$T/header.c"
} >"$T/small.c"
check "small letters that are macros" $CC -std=c99 $WARN -I. -fsyntax-only "$T/small.c"

# names that other headers declare, with the extensions of POSIX and GNU in sight
: >"$T/crowd.c"
for h in complex math tgmath string strings stdlib time signal setjmp unistd termios pthread \
         sys/param sys/stat sys/socket sys/select sys/time sys/sysmacros; do
    printf '#include <%s.h>\n' "$h" >"$T/option.c"
    if $CC -fsyntax-only "$T/option.c" 2>/dev/null; then echo "#include <$h.h>" >>"$T/crowd.c"; fi
done
cat "$T/impl.c" >>"$T/crowd.c"
if accepts "$CC" -std=gnu17 c; then
    check "behind other headers" $CC -std=gnu17 $WARN -I. -fsyntax-only "$T/crowd.c"
fi
if [ -n "$CXX" ] && accepts "$CXX" -std=gnu++17 c++; then
    check "behind other headers, C++" $CXX -std=gnu++17 $WARN -I. -x c++ -fsyntax-only "$T/crowd.c"
fi

# Without position-independent code, constant tables of pointers lie with the other constants.
fixed=-fno-pic pie=-no-pie
quick="-O0 -DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED"
echo 'int main(void) { return 0; }' >"$T/fixed.c"
$CC -Werror $fixed $pie "$T/fixed.c" -o "$T/fixed" >/dev/null 2>&1 || fixed= pie=

# a * b + c behind the header is contracted as it would be without it; inside never (with clang
# -ffp-contract=fast, which no pragma stops, as well).  The freestanding build shows it.
cat >"$T/behind.c" <<'END'
float behind(float a, float b, float c);
float behind(float a, float b, float c) { return a * b + c; }
END
{ echo '#define SHADE_NO_LIBM'; cat "$T/impl.c" "$T/behind.c"; } >"$T/both.c"
fma=; accepts "$CC" -mfma c && fma=-mfma
freestanding="$CC -std=c99 $fixed -ffreestanding $WARN -O2 -I."
assembly() { $freestanding $fma -ffp-contract=$2 -S "$1" -o "$3"; }
body() {                        # file: the instructions of behind()
    sed -n '/^_*behind:/,/^[[:space:]]*\.size\|^[[:space:]]*\.cfi_endproc/p' "$1" |
        grep '^[[:space:]][[:space:]]*[a-z]'
}
rest() { sed '/^_*behind:/,/^[[:space:]]*\.size\|^[[:space:]]*\.cfi_endproc/d' "$1"; }
behind_as_alone() {
    body "$T/alone.s" >"$T/alone" && body "$T/contracted.s" >"$T/behind" && diff "$T/alone" "$T/behind"
}
# On x86 the instructions tell; elsewhere a build without contraction is the same but for behind().
inside_never() {
    rest "$T/contracted.s" >"$T/contracted"
    if [ "$fma" ]; then grep -q "$fused" "$T/alone.s" && no grep -n "$fused" "$T/contracted"
    else
        assembly "$T/both.c" off "$T/off.s" && rest "$T/off.s" >"$T/off" && cmp "$T/contracted" "$T/off"
    fi
}
fused='vfn\{0,1\}m\(add\|sub\)'
if accepts "$CC" -ffp-contract=fast c; then
    contract=fast; $CC --version 2>/dev/null | grep -q clang && contract=on
    check "contraction: function" assembly "$T/behind.c" $contract "$T/alone.s"
    check "contraction: header" assembly "$T/both.c" $contract "$T/contracted.s"
    check "contraction behind the header" behind_as_alone
    # G12
    check "no contraction inside the header" inside_never
    check "freestanding" $CC -c "$T/contracted.s" -o "$T/bare.o"
else
    echo "compile: $CC has no -ffp-contract: left out"
    check "freestanding" $freestanding -c "$T/both.c" -o "$T/bare.o"
fi

# programs of two files; C and C++ together; what SHADE_STATIC does not need leaves from -O1 on
run() { "$1"; }
if [ "${OBJECT:-}" ]; then cp "$OBJECT" "$T/impl.o"
else check "implementation, -O2" $CC -std=c99 $fixed $WARN -O2 -I. -c "$T/impl.c" -o "$T/impl.o"; fi
check "two files" $CC -std=c99 $WARN -I. "$T/main.c" "$T/other.c" "$T/impl.o" -lm $pie -o "$T/two"
check "two files run" run "$T/two"
check "SHADE_STATIC in two files" $CC -std=c99 $WARN -O1 -I. "$T/static_main.c" \
      "$T/static_other.c" -lm -o "$T/static"
check "SHADE_STATIC runs" run "$T/static"
if [ -n "$CXX" ]; then
    check "C++, implementation" $CXX -std=c++11 $WARN $quick -I. -x c++ -c "$T/impl.c" \
          -o "$T/implxx.o"
    cxx="$CXX -std=c++11 $WARN -I. -x c++"
    check "C++ caller, C++ implementation" $cxx "$T/main.c" "$T/other.c" -x none "$T/implxx.o" -lm \
          -o "$T/xx"
    check "C++ caller runs" run "$T/xx"
    check "C++ caller, C implementation" $cxx "$T/main.c" "$T/other.c" -x none "$T/impl.o" -lm \
          $pie -o "$T/xc"
    check "C++ caller of C runs" run "$T/xc"
    check "C caller, C++ implementation" $CC -std=c99 $WARN -I. "$T/main.c" "$T/other.c" \
          "$T/implxx.o" -lm -lstdc++ -o "$T/cx"
    check "SHADE_STATIC in C++" $cxx -O1 "$T/static_main.c" "$T/static_other.c" -lm -o "$T/sxx"
    check "SHADE_STATIC in C++ runs" run "$T/sxx"
fi

# files that disagree on the size of packets do not link; those that agree draw
cat >"$T/packets.c" <<'END'
#include "shade.h"
static void vertices(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                     shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(i) {
        out->clip[0][i] = in->index[i] == 1 ? 3.0f : -1.0f;
        out->clip[1][i] = in->index[i] == 2 ? 3.0f : -1.0f;
        out->clip[3][i] = 1;
    }
}
static void white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int k = 0; k < 3; k++) {
        SHADE_EACH_LANE(i) { out->color[k][i] = 2 * in->z[i]; }
    }
}
int main(void)
{
    static unsigned char pixels[4 * 64 * 64];
    static shade_pipeline pipeline;
    shade_target target = { 64, 64, 0, SHADE_FORMAT_RGBA8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    target.color = pixels;
    pipeline.vertex = vertices;
    pipeline.fragment = white;
    pipeline.varyings = SHADE_MAX_VARYINGS;
    if (shade_draw(&target, &pipeline, 0, 3, 3, 0) != SHADE_OK) return 1;
    for (int i = 0; i < 4 * 64 * 64; i++) {
        if (pixels[i] != 255) return 2;
    }
    return 0;
}
END
sized() {                       # object, lanes_varyings, compiler, flags and file
    object=$1 sizes="-DSHADE_LANES=${2%_*} -DSHADE_MAX_VARYINGS=${2#*_}"; shift 2
    check "$object.o" "$@" $WARN $sizes -I. -c -o "$T/$object.o"
}
sized impl_16_8 16_8 $CC -std=c99 $fixed $quick -DSHADE_NO_EXPLAIN "$T/impl.c"
linked() { $CC "$T/$1.o" "$T/$2.o" -lm $pie -o "$T/linked"; }
draws() { linked "$@" && "$T/linked"; }
not_linked() { ! linked "$@"; }
for size in 128_16 16_8 16_16 128_8; do
    sized c_$size $size $CC -std=c99 "$T/packets.c"
    [ -z "$CXX" ] || sized cxx_$size $size $CXX -std=c++11 -x c++ "$T/packets.c"
    for f in c ${CXX:+cxx}; do
        how=not_linked; [ $size != 128_16 ] || how=draws
        check "$size in $f, $how with the defaults" $how ${f}_$size impl
        how=not_linked; [ $size != 16_8 ] || how=draws
        check "$size in $f, $how with 16_8" $how ${f}_$size impl_16_8
    done
done

# a draw that needs more varyings than there are is a bad state; the same with enough is drawn
cat >"$T/few.c" <<'END'
#include "shade.h"
#include <string.h>
static void own(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    (void)out;
}
int main(void)
{
    static const float corner[9] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    static unsigned char pixels[256], texel[1];
    shade_target target = { 8, 8, 0, SHADE_FORMAT_RGBA8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    shade_texture map = { 0, 1, 1, 0, SHADE_FORMAT_A8, 0, SHADE_WRAP_REPEAT, SHADE_WRAP_REPEAT,
                          SHADE_FILTER_NEAREST, 0, 0 };
    target.color = pixels;
    map.pixels = texel;
    for (int k = 0; k < 16; k++) {    /* colours, a map, a shader; per fragment or per vertex */
        const int color = k & 1, textured = k >> 1 & 1, shader = k >> 2 & 1, vertex = k >> 3;
        int need = shader ? 11 : vertex ? textured ? 8 : 3 : 6 + 3 * color + 2 * textured, i;
        shade_result want = need > SHADE_MAX_VARYINGS ? SHADE_ERROR_STATE : SHADE_OK;
        shade_mesh mesh;
        shade_draw_state state;
        memset(&mesh, 0, sizeof mesh);
        memset(&state, 0, sizeof state);
        memset(pixels, 7, sizeof pixels);
        mesh.positions = corner;
        mesh.vertex_count = 3;
        mesh.colors = color ? corner : 0;
        mesh.texcoords = textured ? corner : 0;
        state.diffuse_map = &map;
        state.fragment = shader ? own : 0;
        state.shading = vertex ? SHADE_SHADING_PER_VERTEX : SHADE_SHADING_PER_FRAGMENT;
        if (shader && vertex) want = SHADE_ERROR_STATE;
        if (shade_draw_mesh(&target, &mesh, &state, 0) != want) return 1 + k;
        for (i = 0; i < 256 && pixels[i] == 7; i++) {}
        if ((i < 256) != (want == SHADE_OK)) return 32 + k;
    }
    return 0;
}
END
sized impl_16_6 16_6 $CC -std=c99 $fixed $quick -DSHADE_NO_EXPLAIN "$T/impl.c"
for n in 6 8; do
    check "meshes with $n varyings" $CC -std=c99 $WARN -DSHADE_LANES=16 -DSHADE_MAX_VARYINGS=$n -I. \
          "$T/few.c" "$T/impl_16_$n.o" -lm $pie -o "$T/few"
    check "meshes with $n varyings are drawn or refused" run "$T/few"
done

# options
option() { printf '%s\n' "$@" '#define SHADE_IMPLEMENTATION' '#include "shade.h"' >"$T/option.c"; }
option_check() {                # name, lines of the file; sizes are the same text in C++
    name=$1; shift; option "$@"
    check "$name" $CC -std=c99 $WARN -I. -fsyntax-only "$T/option.c"
    case $2 in '#define SHADE_MAX_VARYINGS'*) return ;; esac
    [ -z "$CXX" ] || check "$name, C++" $cxx -fsyntax-only "$T/option.c"
}
option_check "SHADE_NO_STDIO" '#define SHADE_NO_STDIO'
option_check "SHADE_NO_LIBM" '#define SHADE_NO_LIBM'
option_check "SHADE_NO_DISPATCH" '#define SHADE_NO_DISPATCH'
option_check "SHADE_STATIC" '#define SHADE_STATIC'
option_check "SHADE_NO_EXPLAIN" '#define SHADE_NO_EXPLAIN'
option_check "small packets" '#define SHADE_LANES 16' '#define SHADE_MAX_VARYINGS 8'
option_check "smallest" '#define SHADE_LANES 8' '#define SHADE_MAX_VARYINGS 1'
option_check "biggest" '#define SHADE_LANES 256' '#define SHADE_MAX_VARYINGS 64'
option_check "SHADE_ASSERT empty" '#define SHADE_ASSERT(x) ((void)0)'
option_check "SHADEDEF" '#define SHADEDEF extern'
option_check "own memory functions" '#include <string.h>' \
             '#define SHADE_MEMCPY(d, s, n) memcpy(d, s, n)' '#define SHADE_MEMSET(d, c, n) memset(d, c, n)'
option_check "everything small" '#define SHADE_NO_LIBM' '#define SHADE_STATIC' \
             '#define SHADE_LANES 16' '#define SHADE_MAX_VARYINGS 4'
refused() {
    printf '#define %s\n#include "shade.h"\n' "$1" >"$T/option.c"
    ! $CC -std=c99 -I. -fsyntax-only "$T/option.c"
}
check "SHADE_LANES 24 is refused" refused "SHADE_LANES 24"
check "SHADE_MAX_VARYINGS 65 is refused" refused "SHADE_MAX_VARYINGS 65"

# without explanations the three functions have nothing to say, not even of NULL
cat >"$T/speaks.c" <<'END'
#include "shade.h"
int main(void)
{
    return shade_explain(0, 0, 0, 0)[0] != SPEAKS || shade_explain_lines(0, 0, 1, 0, 0)[0] != SPEAKS ||
           shade_explain_draw(0, 0, 0, 3, 3, 0)[0] != SPEAKS;
}
END
option '#define SHADE_NO_EXPLAIN'
check "SHADE_NO_EXPLAIN compiles" $CC -std=c99 $WARN $fixed $quick -I. -c "$T/option.c" -o "$T/silent.o"
says() { $CC -std=c99 $WARN "-DSPEAKS=$2" -I. "$T/speaks.c" "$T/$1.o" -lm $pie -o "$T/speaks" && "$T/speaks"; }
check "explanations speak" says impl "'t'"
check "SHADE_NO_EXPLAIN: they return \"\"" says silent 0

# -ffast-math: gcc is told not to heed it; clang cannot be told, and is refused where it compiles
# the implementation
fast() { $CC -std=c99 $WARN "$@" -I. -fsyntax-only; }
not_fast() { ! fast "$@"; }
for flag in -ffast-math -Ofast -ffinite-math-only; do
    accepts "$CC" $flag c || { echo "compile: $CC has no $flag: left out"; continue; }
    check "header with $flag" fast $flag "$T/header.c"
    if $CC --version 2>/dev/null | grep -q clang; then
        check "implementation with $flag is refused" not_fast $flag "$T/impl.c"
        check "... but where it is allowed" fast $flag -DSHADE_ALLOW_FAST_MATH "$T/impl.c"
        check "... or taken back" $CC $flag -fno-fast-math -I. -fsyntax-only "$T/impl.c"
    else
        check "implementation with $flag" fast $flag "$T/impl.c"
    fi
done

# what objects need and export
undefined() { nm "$1" | sed -n 's/.* U _*//p' | sort -u; }
only() {                        # object, allowed names
    object=$1; shift; bad=
    for s in $(undefined "$object"); do
        case " $* " in *" $s "*) ;; *) bad="$bad $s" ;; esac
    done
    [ -z "$bad" ] || { echo "undefined:$bad"; return 1; }
}
no_mutable_globals() {          # but tables of addresses, which position-independent code relocates
    if nm -f sysv "$1" >"$T/sections" 2>/dev/null; then
        found=$(awk -F'|' '$7 ~ /data|bss|COM/ && $7 !~ /rodata|\.rel\.ro/' "$T/sections")
    else found=$(nm "$1" | awk '$2 ~ /^[DdBbCGgSs]$/'); fi
    [ -z "$found" ] || { echo "$found"; return 1; }
}
exports_only_shade() {
    found=$(nm -g "$1" | awk 'NF == 3 { sub(/^_/, "", $3); if ($3 !~ /^shade_[a-z0-9]/) print }')
    [ -z "$found" ] || { echo "$found"; return 1; }
}
if command -v nm >/dev/null 2>&1; then
    check "freestanding needs four functions" only "$T/bare.o" memcpy memset memmove memcmp
    # G6
    check "no malloc, no printing, no exit" only "$T/impl.o" memcpy memset memmove memcmp sqrtf \
          fopen fclose fwrite ferror assert_fail assert_rtn assert stack_chk_fail \
          stack_chk_fail_local GLOBAL_OFFSET_TABLE_ cpu_model cpu_indicator_init
    check "no mutable globals" no_mutable_globals "$T/impl.o"
    check "exports begin with shade_" exports_only_shade "$T/impl.o"
    check "no mutable globals, freestanding" no_mutable_globals "$T/bare.o"
    check "SHADE_NO_EXPLAIN needs no more" only "$T/silent.o" $(undefined "$T/impl.o")
    option '#define SHADE_STATIC'
    check "SHADE_STATIC compiles" $CC -std=c99 $WARN -O1 -I. -c "$T/option.c" -o "$T/static.o"
    printf '#define SHADE_STATIC\n#define SHADE_IMPLEMENTATION\n#include "shade.h"\n%s\n' \
        'float term(void) { return shade_lambert(shade_v3(0, 0, 1), shade_v3(0, 1, 0)); }' >"$T/term.c"
    $CC -std=c99 -w -O1 -I. -c "$T/term.c" -o "$T/term.o"
    check "SHADE_STATIC holds what is called" sh -c "! nm '$T/term.o' | grep -q 'shade_.*draw'"
    check "SHADE_STATIC exports nothing" sh -c "test -z \"\$(nm -g '$T/static.o' | awk 'NF == 3')\""
else
    echo "compile: no nm: what objects need and export is left out"
fi

# names: nothing but shade_ and SHADE_ is defined in the user's file
names() {
    for h in float stddef stdint math stdio assert string; do echo "#include <$h.h>"; done >"$T/std.c"
    $CC -std=c99 -I. -dM -E "$T/header.c" | awk '{ sub(/\(.*/, "", $2); print $2 }' | sort -u >"$T/with"
    $CC -std=c99 -dM -E "$T/std.c" | awk '{ sub(/\(.*/, "", $2); print $2 }' | sort -u >"$T/without"
    found=$(comm -23 "$T/with" "$T/without" | grep -v '^SHADE_\|^SHADEDEF$' | grep -v '^_')
    [ -z "$found" ] || { echo "$found"; return 1; }
}
check "macros begin with SHADE_" names

finish
