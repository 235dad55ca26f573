#!/bin/sh
# all.sh make cc - everything that "make test" promises: what is done, what each step says when it ends,
# and one closing line.
make=${1:-make} CC=${2:-cc}
export CC MAKE="$make"
T=$(mktemp -d) || exit 1
trap 'rm -rf "$T"' EXIT INT TERM
cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null) || cores=1

# Starts a command that ends with "N passed, N failed"; when it has ended, says so, adds up what it said,
# and shows all of it if something failed.
step() {
    name=$1; shift
    {
        "$@" >"$T/$name" 2>&1 </dev/null
        status=$?
        line=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$T/$name" | tail -n 1)
        p=${line%% *} f=${line##*, } f=${f%% *}
        : "${p:=0}" "${f:=1}"
        [ "$status" -ne 0 ] && [ "$f" -eq 0 ] && f=1
        if [ "$f" -gt 0 ]; then cat "$T/$name"; else grep 'left out' "$T/$name"; fi
        printf '%-10s %4d passed, %d failed\n' "$name" "$p" "$f"
        echo "$p $f" >"$T/$name.count"
    } &
}
# Builds; a warning is a failure.
build() {
    echo "builds $*"
    "$make" -s -j"$cores" "$@" 2>"$T/said" || { cat "$T/said"; wait; echo "0 passed, 1 failed"; exit 1; }
    [ ! -s "$T/said" ] || { cat "$T/said"; echo "0 1" >"$T/warnings.count"; }
}
build build/shade.o    # with all warnings; most steps link it
export OBJECT=build/shade.o
step compile sh tests/scripts/dialects.sh
build build/test_main
step runner build/test_main
step board sh tests/scripts/microcontroller.sh
build build/test_count
step count build/test_count work
build build/golden build/tables pictures
step elsewhere build/tables examples/elsewhere/tables/*.txt
# G15
step pictures build/golden out/*.ppm
step shown sh examples/pictures/gallery.sh --check
step png sh tests/scripts/png.sh
step readme sh tests/scripts/readme.sh
wait
cat "$T"/*.count | awk '{ p += $1; f += $2 } END { printf "%d passed, %d failed\n", p, f; exit f > 0 }'
