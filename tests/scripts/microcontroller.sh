#!/bin/sh
# microcontroller.sh - the example for small machines: its strips are the whole picture; the
# program for a Cortex-M4F is small, stays within its memory, and sends out the same bits.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
CC=${CC:-cc}
export CC
B=build/microcontroller

below() {                       # most, value
    [ -n "$2" ] && echo "$2, allowed $1" && [ "$2" -lt "$1" ]
}
number() { sed -n "s/^$1 *\([0-9][0-9]*\).*/\1/p"; }

mkdir -p build && rm -rf $B
# an object that is there draws the same pictures as one without builds for other processors
[ -z "${OBJECT:-}" ] || { mkdir $B && cp "$OBJECT" $B/shade.o; }
make="make -s -C examples/microcontroller CC=$CC"
check "strips are the picture drawn at once" $make ../../$B/picture.565
if command -v arm-none-eabi-gcc >/dev/null 2>&1; then
    check "builds for the board" $make ../../$B/board.elf
    check "less than 30 kB of code" \
        below 30720 "$(arm-none-eabi-size -A $B/board.elf | number '\.text')"
    if command -v qemu-system-arm >/dev/null 2>&1; then
        check "runs" timeout 120 $make ../../$B/board.565
        check "less than 20 kB of RAM, static and stack" below 20000 "$(number together <$B/board.txt)"
        # G12
        check "the same bits" cmp $B/picture.565 $B/board.565
    else left_out "memory and picture of the board: no qemu-system-arm"; fi
else left_out "the board: no arm-none-eabi-gcc"; fi
finish
