#!/bin/sh
# all.sh make cc - everything that "make test" promises, and one closing line.
make=${1:-make} CC=${2:-cc}
export CC MAKE="$make"
passed=0 failed=0 steps=
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null) || cores=1

# Starts a command that ends with "N passed, N failed".
step() {
    name=$1; shift
    steps="$steps $name"
    { "$@" >"$T/$name" 2>&1 </dev/null; echo $? >"$T/$name.status"; } &
}
# Adds up what it said; shows all of it if something failed.
report() {
    line=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$T/$1" | tail -n 1)
    p=$(printf '%s' "$line" | sed -n 's/^\([0-9]*\) passed.*/\1/p')
    f=$(printf '%s' "$line" | sed -n 's/.* \([0-9]*\) failed$/\1/p')
    : "${p:=0}" "${f:=1}"
    [ "$(cat "$T/$1.status")" != 0 ] && [ "$f" -eq 0 ] && f=1
    if [ "$f" -gt 0 ]; then cat "$T/$1"; else grep 'left out' "$T/$1"; fi
    printf '%-10s %4d passed, %d failed\n' "$1" "$p" "$f"
    passed=$((passed + p)) failed=$((failed + f))
}

build() { "$make" -s -j"$cores" "$@" || { wait; echo "0 passed, 1 failed"; exit 1; }; }
step compile sh tests/scripts/dialects.sh
step board sh tests/scripts/microcontroller.sh
build build/shade.o    # which the README's programs are linked to as well
step readme sh tests/scripts/readme.sh
build build/test_main
step runner build/test_main
build build/test_count
step count build/test_count work
build build/golden build/tables pictures
step elsewhere build/tables examples/elsewhere/tables/*.txt
# G15
step pictures build/golden out/*.ppm
step shown sh examples/pictures/gallery.sh --check
step png sh tests/scripts/png.sh
# nothing here runs the programs: they are read for errors, unless they are there
"$make" -s CFLAGS=-fsyntax-only programs >"$T/programs" 2>&1 || { cat "$T/programs"; failed=1; }
grep 'left out' "$T/programs"
wait
for name in $steps; do report "$name"; done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
