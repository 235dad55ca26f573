#!/bin/sh
# matrix.sh - the built-in scenes from other compilers, flags, vector widths and processors have the same bits.
# What is not installed is named and left out.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
grep '^{' tests/unit/scenes.h >"$T/want"

# Scenes need no explanations, which take a fifth of the time to compile: builds of options have none.
alone="-DSCENE_MAIN -DSHADE_NO_EXPLAIN"
builds() {
    with=$1; shift
    $with -w $alone -I. "$@" tests/unit/scene.c -lm -o "$T/scenes"
}
# With -ffast-math the linker adds code that flushes denormal numbers to zero, in all of the program.
builds_fast() {
    with=$1; shift
    $with -w $alone -I. "$@" -c tests/unit/scene.c -o "$T/scenes.o" &&
        $with $static "$T/scenes.o" -lm -o "$T/scenes"
}
# name, runner of what has been built (or "")
draws() {
    if $2 "$T/scenes" >"$T/got" 2>&1 && cmp -s "$T/want" "$T/got"; then
        passed=$((passed + 1)); echo "same      $1"
    else
        diff "$T/want" "$T/got" >"$T/log"; fail "$1" "$T/log"
    fi
}
# name, runner (or ""), compiler and flags
one() {
    name=$1 runner=$2; shift 2
    if ! there "$1" || { [ -n "$runner" ] && ! there "${runner%% *}"; }; then
        left_out "$name"
    elif ! $build "$@" 2>"$T/log"; then
        fail "$name does not compile" "$T/log"
    else
        draws "$name" "$runner"
    fi
}
# One program draws with each build of the loops that this processor can run.
each_level() {                  # compiler and flags
    if ! there "$1"; then left_out "builds of the loops, $*"
    elif ! builds "$@" $level_chosen 2>"$T/log"; then fail "$* does not compile" "$T/log"
    else for level in $(levels); do draws "$*, build $level" "env LEVEL=$level"; done
    fi
}

# G12, G13
build=builds
for cc in gcc clang; do
    each_level $cc -O2
    lanes="8 16 64 256"; [ $cc = gcc ] || lanes=16
    for flags in -O0 -O1 -Os; do one "$cc $flags" "" $cc $flags; done
    # a build for one processor is compiled in a third of the time
    for flags in "-O3 -march=native" "-std=c99 -O2" "-O2 -mavx2 -mfma" "-O2 -DSHADE_NO_LIBM" \
        $(printf -- '-DSHADE_LANES=%d ' $lanes); do
        one "$cc $flags, one build" "" $cc -O2 $flags -DSHADE_NO_DISPATCH
    done
done
# clang's back end fuses whatever the source says under -ffp-contract=fast; gcc heeds the header
one "gcc -ffp-contract=fast" "" gcc -O2 -ffp-contract=fast -march=native -DSHADE_NO_DISPATCH
one "tcc" "" tcc
find_i686
one "i686 -msse2 -mfpmath=sse" "$i686" i686-linux-gnu-gcc -static -msse2 -mfpmath=sse -O2
for std in "" "-std=c99"; do    # gcc contracts sums where no standard is named
    one "aarch64 $std" qemu-aarch64 aarch64-linux-gnu-gcc -static -O2 $std
done
one "armhf" qemu-arm arm-linux-gnueabihf-gcc -static -O2
one "riscv64" qemu-riscv64 riscv64-linux-gnu-gcc -static -O2
one "s390x, big-endian" qemu-s390x s390x-linux-gnu-gcc -static -O2
one "aarch64 -O3 -ffp-contract=fast" qemu-aarch64 aarch64-linux-gnu-gcc -static -O3 -ffp-contract=fast

one "ppc64le" qemu-ppc64le powerpc64le-linux-gnu-gcc -static -O2
if [ "$LONG" ]; then
    far_machines >"$T/far"
    while read -r runner command <&3; do
        one "$command" "$runner" $command -static
    done 3<"$T/far"
    # Boards of qemu with 4 MB of flash and 16 MB of memory; the code of a Cortex-M0 runs on an M3.
    # picolibc prints by semihosting, and hands a program its own path, which the scenes take for a
    # folder of pictures.
    cat >"$T/board" <<'END'
case $1 in *riscv32) bios="-bios none" ;; esac
"$1" -nographic -semihosting $bios -M "$2" -kernel "$3" </dev/null 2>&1 | grep -v 'cannot be written$'
END
    # name, system, machine, flash, memory, compiler and flags
    board() {
        name=$1 system=$2 machine=$3 flash=$4 ram=$5 run=$2; shift 5
        ! there "$system" || run="sh $T/board $system $machine"
        one "$name" "$run" "$@" --specs=picolibc.specs --oslib=semihost --crt0=semihost -O2 \
            "-Wl,--defsym=__flash=$flash" -Wl,--defsym=__flash_size=0x400000 "-Wl,--defsym=__ram=$ram" \
            -Wl,--defsym=__ram_size=0x1000000 -Wl,--defsym=__stack_size=0x40000
    }
    arm() {
        name=$1 machine=$2 ram=$3; shift 3
        board "$name" qemu-system-arm "$machine" 0 "$ram" arm-none-eabi-gcc -mthumb "$@"
    }
    arm "Cortex-M0" mps2-an385 0x21000000 -mcpu=cortex-m0
    arm "Cortex-M3" mps2-an385 0x21000000 -mcpu=cortex-m3
    arm "Cortex-M4F" mps2-an386 0x21000000 -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16
    arm "Cortex-M7" mps2-an500 0x60000000 -mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16
    board "riscv32 without an FPU" qemu-system-riscv32 virt 0x80000000 0x80400000 \
        riscv64-unknown-elf-gcc -march=rv32imac -mabi=ilp32
else
    left_out "$(far_machines | wc -l) processors and five boards more, with LONG=1"
fi

# gcc heeds the header under -ffast-math too; clang is refused
build=builds_fast static=
for flags in -Ofast "-O3 -march=native -ffast-math -DSHADE__AS_COMPILED" "-O0 -ffast-math" "-Os -ffast-math"; do
    one "gcc $flags" "" gcc $flags
done
for flags in "-O3 -march=native -ffast-math" "-ffast-math -DSHADE_NO_LIBM" "-ffp-contract=fast -mfma -ffast-math" \
    -funsafe-math-optimizations "-fassociative-math -fno-signed-zeros -fno-trapping-math" \
    -freciprocal-math -ffinite-math-only -fsingle-precision-constant; do
    one "gcc $flags, one build" "" gcc -O2 $flags -DSHADE_NO_DISPATCH
done
static=-static
one "i686 -Ofast" "$i686" i686-linux-gnu-gcc -msse2 -mfpmath=sse -Ofast
one "aarch64 -Ofast" qemu-aarch64 aarch64-linux-gnu-gcc -Ofast
one "armhf -Ofast" qemu-arm arm-linux-gnueabihf-gcc -Ofast
one "riscv64 -Ofast" qemu-riscv64 riscv64-linux-gnu-gcc -Ofast
one "s390x -Ofast" qemu-s390x s390x-linux-gnu-gcc -Ofast
build=builds

cat >"$T/wasi.js" <<'END'
const fs = require('fs');
const { WASI } = require('wasi');

const wasi = new WASI({ version: 'preview1', args: process.argv.slice(2) });
WebAssembly.instantiate(fs.readFileSync(process.argv[2]), { wasi_snapshot_preview1: wasi.wasiImport })
    .then(({ instance }) => process.exit(wasi.start(instance)));
END
wasi="node --no-warnings --experimental-wasi-unstable-preview1 $T/wasi.js"
if echo '#include <stdio.h>' | clang --target=wasm32-wasi -x c -fsyntax-only - 2>/dev/null; then
    one "wasm32 under Node" "$wasi" clang --target=wasm32-wasi -O2
    one "wasm32 with SIMD" "$wasi" clang --target=wasm32-wasi -O2 -msimd128
else
    left_out "wasm32: no wasi-libc"
fi

finish
