#!/bin/sh
# all.sh make cc - everything that "make test" promises, and one closing line.
make=${1:-make} CC=${2:-cc}
export CC
passed=0 failed=0

# Runs a command that ends with "N passed, N failed" and adds that up; shows all of it if something failed.
step() {
    name=$1; shift
    log=$("$@" 2>&1); status=$?
    line=$(printf '%s\n' "$log" | grep -E '^[0-9]+ passed, [0-9]+ failed$' | tail -n 1)
    p=$(printf '%s' "$line" | sed -n 's/^\([0-9]*\) passed.*/\1/p')
    f=$(printf '%s' "$line" | sed -n 's/.* \([0-9]*\) failed$/\1/p')
    : "${p:=0}" "${f:=1}"
    [ "$status" -ne 0 ] && [ "$f" -eq 0 ] && f=1
    if [ "$f" -gt 0 ]; then printf '%s\n' "$log"; else printf '%s\n' "$log" | grep 'left out'; fi
    printf '%-10s %4d passed, %d failed\n' "$name" "$p" "$f"
    passed=$((passed + p)) failed=$((failed + f))
}

"$make" -s build/test_main build/golden all || { echo "0 passed, 1 failed"; exit 1; }
step runner build/test_main
step pictures build/golden out/*.ppm
step compile sh tests/compile.sh
step readme sh tests/readme.sh
step board sh tests/microcontroller.sh
step lint sh tests/lint.sh
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
