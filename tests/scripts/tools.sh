# tools.sh - sourced by tests in shell: a folder $T of their own, checks, counts, their end.
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT
trap 'exit 1' INT TERM
passed=0 failed=0 skipped=0

there() { command -v "$1" >/dev/null 2>&1; }
left_out() { skipped=$((skipped + 1)); echo "left out  $1"; }
fail() {                        # what, file that tells more
    failed=$((failed + 1)); echo "FAIL      $1"; sed 's/^/    /;12q' "$2"
}
check() {                       # what, command ...
    what=$1; shift
    if "$@" >"$T/log" 2>&1; then passed=$((passed + 1))
    else fail "$what" "$T/log"; fi
}
no() { "$@"; [ $? -eq 1 ]; }      # what cannot be asked, with a status above 1, is no answer
same() { [ "$1" = "$2" ] || { echo "got \"$1\", want \"$2\""; return 1; }; }
# Status 1, one line on stderr, of a program, that holds a text, and nothing on stdout
refused_by() {                  # program, text, command ...
    begins="^$1: .*$2"; shift 2
    "$@" >"$T/out" 2>"$T/err" </dev/null
    [ $? -eq 1 ] && [ "$(wc -l <"$T/err")" -eq 1 ] && grep -e "$begins" "$T/err" && [ ! -s "$T/out" ]
}
# Sets CC and CXX where they are not set; CXX stays empty if there is no C++ compiler.
find_compilers() {
    CC=${CC:-cc}
    [ "${CXX:-}" ] || for c in c++ g++ clang++; do there $c && CXX=$c && break; done
}
# Sets STB, ZLIB and ASSIMP to what programs are built with where a library is here, else to nothing,
# and LIBRARIES to those of assimp.
find_libraries() {
    STB= ZLIB= ASSIMP= LIBRARIES=
    echo | $CC -fsyntax-only -include stb/stb_image.h -include stb/stb_image_write.h -x c - \
        2>/dev/null && STB=-DMODEL_STB
    echo 'int main(void) { return !zlibVersion(); }' | $CC -include zlib.h -x c - -lz -o "$T/probe" \
        2>/dev/null && ZLIB="-DMODEL_ZLIB -lz"
    echo 'int main(void) { aiDetachAllLogStreams(); return 0; }' | $CC -include assimp/cimport.h \
        -x c - -lassimp -o "$T/probe" 2>/dev/null && ASSIMP=-DMODEL_ASSIMP LIBRARIES=-lassimp
}
# Sets $python to a Python that has these modules, or to nothing.
find_python() {                 # modules, with commas between them
    for python in python3 /usr/bin/python3; do
        $python -c "import $1" 2>/dev/null && return
    done
    python=
}
# Processors that are emulated with LONG=1: runner, compiler and flags
far_machines() {
    cat <<'END'
qemu-ppc64le powerpc64le-linux-gnu-gcc -O2
qemu-ppc64 powerpc64-linux-gnu-gcc -O2
qemu-ppc powerpc-linux-gnu-gcc -O2
qemu-alpha alpha-linux-gnu-gcc -O2 -mieee -Wl,--no-relax
qemu-hppa hppa-linux-gnu-gcc -O2
qemu-sparc64 sparc64-linux-gnu-gcc -O2
qemu-arm arm-linux-gnueabi-gcc -O2
qemu-mips mips-linux-gnu-gcc -O2
qemu-mipsel mipsel-linux-gnu-gcc -O2
qemu-mips64 mips64-linux-gnuabi64-gcc -O2
qemu-mips64el mips64el-linux-gnuabi64-gcc -O2
qemu-mips mipsisa32r6-linux-gnu-gcc -O2
END
}
# The builds of shade.h's loops that this processor can run, and flags by which $LEVEL chooses one of them
levels() {
    echo 0
    [ ! -r /proc/cpuinfo ] || awk '/^flags/ { if (/ sse4_1 /) print 1; if (/ avx2 /) print 2
        if (/ avx512vl / && / avx512bw / && / avx512dq /) print 3; exit }' /proc/cpuinfo
}
level_chosen='-include stdlib.h -DSHADE__LEVEL=atoi(getenv("LEVEL"))'
# A compiler $T/bin/NAME, to be put before others, that leaves out what only makes drawing faster, and
# without other flags the sentences of explain: the same bits, compiled in a seventh of the time.
quick_compiler() {              # name, what it is, flags behind all others
    mkdir -p "$T/bin"
    printf '#!/bin/sh\nexec %s -DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED "$@" %s\n' "$2" "${3:--DSHADE_NO_EXPLAIN -O0}" \
        >"$T/bin/$1" && chmod +x "$T/bin/$1"
}
# The inline functions of shade.h's public part, one a line
inline_functions() { sed -n 's/^SHADE__EXPORT [a-z0-9_]* \(shade_[a-z0-9_]*\)(.*/\1/p' shade.h; }
# Lessons draw with one sample a pixel where $one_sample is included before them, but for those that
# count the samples of their picture themselves.
one_sample=$T/one_sample.h alone="32_z_buffer 37_rays"
printf '#include "%s/examples/shared/canvas.h"\n#define canvas_new(w, h, samples) canvas_new(w, h, 1)\n' \
    "$PWD" >"$one_sample"
among() { case " $2 " in *" $1 "*) return 0 ;; esac; return 1; }      # word, words
soon() {                        # waits up to $patience seconds, 20, for a command to succeed
    for i in $(seq $((10 * ${patience:-20}))); do "$@" >/dev/null 2>&1 && return 0; sleep 0.1; done
    "$@"
}
# SIGINT while a program reads noise.stl, whose 3 million triangles have nothing in common: it ends by
# that signal, at once, and leaves nothing behind.  program, arguments
interrupted() {
    { printf '%80s\300\306\055\000' noise; head -c 150000000 /dev/urandom; } >"$T/noise.stl"
    ls -A "$T" >"$T.before"
    # a job of a shell without job control is deaf to INT
    env --default-signal=INT "$@" >/dev/null 2>"$T.said" &
    until [ ! -d /proc/$! ] || [ "$(awk '/^VmRSS/ { print $2 }' /proc/$!/status)" -gt 160000 ]; do
        sleep 0.02
    done
    kill -INT $!
    wait $!
    said="$? $(sed 's/^[a-z-]*: //' "$T.said")"
    echo "$said"
    [ "$said" = "130 interrupted while reading $T/noise.stl" ] &&
        ls -A "$T" | diff "$T.before" - && rm "$T.before" "$T.said" "$T/noise.stl"
}
# Sets $wine to what runs programs for Windows, or to nothing.  Debian's wine64 alone is not on the
# path.  Wine's server runs until stop_wine: one that ends when it is idle resets the connection of a
# program that has just begun.  It writes into its folder until it ends.
find_wine() {
    export WINEPREFIX="$T/wine" WINEDEBUG=-all
    wine=
    for w in wine64 wine /usr/lib/wine/wine64; do there "$w" && wine=$w && break; done
    trap 'stop_wine >/dev/null 2>&1; rm -rf "$T"' EXIT
    [ -z "$wine" ] || { mkdir -p "$WINEPREFIX" && wine_server -p; }
}
# Sets $i686 to what runs programs of 32 bits: nothing, or an emulator where the kernel takes none
find_i686() {
    i686=
    echo 'int main(void) { return 0; }' |
        i686-linux-gnu-gcc -static -x c - -o "$T/i686" 2>/dev/null && ! "$T/i686" 2>/dev/null &&
        i686=qemu-i386
}
wine_server() {                 # options
    for w in wineserver /usr/lib/wine/wineserver64; do there "$w" && "$w" "$@" && break; done
}
stop_wine() { [ -d "$WINEPREFIX" ] && wine_server -k && wine_server -w; }
finish() {
    [ "$skipped" -eq 0 ] || echo "$skipped left out"
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
    exit
}
