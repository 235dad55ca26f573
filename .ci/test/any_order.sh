#!/bin/sh
# any_order.sh [step ...] - make's targets, the scripts and the commands of READMEs share one tree, in
# any order.  They run in a fresh clone, forward, then backward over their own products, then each
# alone after make clean.  No path may be a file of one step and a directory of another, and nothing
# changes outside of build/ and out/.  Pictures are few and rounds single; long steps run forward.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
TOP=$PWD MAKE=${MAKE:-make}
there git || { left_out "everything: no git"; finish; }

# ---- compilers that compile the same thing once -------------------------------------------------
# A compiler's output is kept by its arguments, its preprocessed source and the objects it links.
# Headers that are missing and outputs that cannot be written still fail.
mkdir "$T/bin" "$T/cache" "$T/steps"
cached() {                      # name, compiler, flags
    compiler=$(command -v "$2") || return
    echo "#!/bin/sh
real='$compiler $3' cache=$T/cache" | cat - "$T/cached" >"$T/bin/$1"
    chmod +x "$T/bin/$1"
}
cat >"$T/cached" <<'END'
before= out=
for word; do                    # what writes more than its output, or reads a pipe, is not kept
    case $word in - | -E | -v | -M* | --version | -fstack-usage) exec $real "$@" ;; esac
    [ "$before" = -o ] && out=$word
    before=$word
done
case $out in '' | /dev/*) exec $real "$@" ;; esac
key=$({
    echo "$real" "$@"
    before=
    for word; do                # -E takes no -o where there are several files
        shift
        case $word in *.[oa]) [ "$before" = -o ] || cat "$word" ;; esac
        [ "$before" = -o ] || [ "$word" = -o ] || set -- "$@" "$word"
        before=$word
    done
    $real "$@" -E || echo "failed $$"
} 2>/dev/null | sed "s|${ORDERS_TREE:-//}||g" | cksum | tr ' ' -)
if [ -f "$cache/$key" ] && [ ! -d "$out" ]; then
    rm -f "$out"
    exec cp "$cache/$key" "$out"
fi
$real "$@" || exit
[ ! -f "$out" ] || { cp "$out" "$cache/$key.$$" && mv "$cache/$key.$$" "$cache/$key"; }
END
cached cc "${CC:-cc}" "-DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED"
cached c++ "${CXX:-c++}" "-DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED"
cached clang clang -DSHADE_NO_DISPATCH
cached arm-none-eabi-gcc arm-none-eabi-gcc
find_python "numpy, PIL"
[ -z "$python" ] || ln -s "$(command -v $python)" "$T/bin/python3"
unset BUILD OUT SHADE BASE LEVELS MESH MAKEFLAGS MFLAGS MAKELEVEL
PATH=$T/bin:$PATH CC=cc CXX=c++ CLANG=clang ROUNDS=1
REVEAL=$TOP/build/node_modules/reveal.js    # clones have nothing of npm
export PATH CC CXX CLANG MAKE ROUNDS REVEAL

# ---- the steps ----------------------------------------------------------------------------------
steps= long=
step() {                        # name, commands in the top directory
    steps="$steps $1"; printf '%s\n' "set -e" "$2" >"$T/steps/$1"
}
long_step() { long="$long $1"; step "$1" "$2"; }
have() {                        # program ...; one that is not installed is named and left out
    for program; do there "$program" || { left_out "$program"; return 1; }; done
}
few="NUMBERED='01_triangle 19_threads'"
step all "$MAKE -s $few all"
step test "$MAKE -s T=math test"
step pictures "$MAKE -s $few build/golden pictures; build/golden out/[0-9]*.ppm"
long_step readme "sh tests/scripts/readme.sh"
step course "sh examples/teaching/course/test/course.sh; $MAKE -s course || [ ! -d '$REVEAL' ]"
step board "sh tests/scripts/microcontroller.sh"
step microcontroller "$MAKE -s -C examples/microcontroller"
step install "$MAKE -s install PREFIX=\$PWD/build/usr; $MAKE -s uninstall PREFIX=\$PWD/build/usr"
long_step install-test "sh examples/programs/install/test/install.sh"
step programs "$MAKE -s build/view build/batch build/thumbnail build/compare build/shade.o"  # view.sh, batch.sh
step bench "sh bench/run.sh maths kernel"
long_step against "BASE=HEAD LEVELS=0 $MAKE -s bench"
step plot "$MAKE -s bench-plot"
step conformance "sh tests/scripts/conformance.sh --only no-scene"
long_step fuzz "sh tests/scripts/fuzz.sh 1 texture"
step playground "$MAKE -s playground"
have pnmenlarge pngquant && step gallery "$MAKE -s $few gallery"

# the blocks of the README of examples/embed, each by itself
awk -v to="$T/embed" '/^```/ { inside = $0 == "```sh"; blocks += inside; next }
    inside { print >(to blocks) }' examples/embed/README.md
try() {                         # compiler, flags, text: is it there?
    printf '%s\n' "$3" | $1 $2 -fsyntax-only - 2>/dev/null || { left_out "$3"; return 1; }
}
for block in "$T"/embed[0-9]*; do
    name=embed-${block##*/embed}
    case $(cat "$block") in
    cmake*) have cmake ;;
    *meson*) have meson ninja pkg-config ;;
    *glm.cpp*) try c++ "-std=c++20 -x c++" "#include <glm/glm.hpp>" ;;
    *python3*) [ -x "$T/bin/python3" ] || { left_out "Python with numpy and Pillow"; false; } ;;
    *framebuffer*) try cc "-x c" "#include <linux/fb.h>" ;;
    esac && step "$name" "cd examples/embed
$(cat "$block")"
done

# ---- none is forgotten --------------------------------------------------------------------------
# These write into a directory of mktemp alone and name no product of the tree ...
apart="abi cases dialects compare contract coverage drawing embed lint matrix mutation node packages prove
       project python questions rows static threads thumbnail user_files vector_report"
scripts=$(grep -l '^#!/bin/sh' tests/scripts/*.sh examples/*/test/*.sh examples/*/*/test/*.sh .ci/test/*.sh)
for name in $apart; do
    script=$(printf '%s\n' $scripts | grep "/$name\.sh\$")
    check "$name.sh has a directory of its own" \
        grep -qE 'T=\$\(mktemp -d\)|^\. tests/scripts/tools.sh$|>/tmp/lint_.*\$\$' "$script"
    check "$name.sh writes nowhere else" no grep -nE '^[^#]*(^|[ ="])(\$PWD/)?(build|out)/' "$script"
done
# ... and these are said above in other words: all.sh test, png.sh what it reads, view.sh, batch.sh, explain.sh and
# assignments.sh their make, dist.sh, github.sh and windows.sh directories of their own,
# compilers.sh and playground.sh build/zig, build/playwright and the page.  bench/size.sh measures for
# a minute; what it writes in build/ is size.* and stack*.
others="all png view batch explain compilers playground any_order assignments dist github windows"
# course.sh packs what course-zip packs, and the step fuzz runs the script that make fuzz runs
elsewhere="assignments clean conformance course-zip dist findings format format-check fuzz help install-header
    lint matrix products programs project questions
    vector-report"
{ there pnmenlarge && there pngquant; } || elsewhere="$elsewhere gallery"
forgotten() {                   # scripts and targets that are neither a step nor named here
    for script in $scripts; do
        name=$(basename "$script" .sh)
        case " $(echo $apart) $others " in *" $name "*) continue ;; esac
        grep -qF "$script" "$T"/steps/* || echo "$script"
    done
    for target in $(for file in Makefile examples/products.mk; do
        sed -n '/^\.PHONY:/,$s/^\.PHONY:\|^\.SECONDARY:\|\\$//gp' $file; done); do
        case " $(echo $apart $elsewhere) " in *" $target "*) continue ;; esac
        grep -qE "(MAKE|make).* $target( |;|\$)" "$T"/steps/* || echo "make $target"
    done
}
check "every script and target has its place" same "$(forgotten)" ""

# ---- the orders ---------------------------------------------------------------------------------
copy() {                        # where: a clone, with what has changed since
    git clone -q . "$1" 2>/dev/null || return
    git ls-files -co --exclude-standard | while read -r file; do
        if [ -e "$file" ]; then mkdir -p "$1/$(dirname "$file")" && cp -P "$file" "$1/$file"
        else rm -f "$1/$file"
        fi
    done
}
run() {                         # order, tree, step
    ORDERS_TREE=$2
    export ORDERS_TREE
    (cd "$2" && exec sh "$T/steps/$3") >"$T/log" 2>&1 </dev/null
    status=$?
    (cd "$2" && find build out -type d | sed 's/^/directory /' &&
        find build out ! -type d | sed 's/^/file /') 2>/dev/null >>"$T/kinds"
    if [ $status -eq 0 ]; then passed=$((passed + 1))
    else tail -n 12 "$T/log" >"$T/end"; fail "$1: $3" "$T/end"
    fi
}
unchanged() {                   # tree; examples/pictures is what the gallery draws
    diff -r -x .git -x build -x out -x pictures "$T/first" "$1"
}
[ $# -gt 0 ] && steps=$*
short= backward=
for name in $steps; do
    case " $long " in *" $name "*) continue ;; esac
    short="$short $name" backward="$name $backward"
done
copy "$T/first" && cp -R "$T/first" "$T/tree" || exit 1

for name in $steps; do run forward "$T/tree" "$name"; done
check "forward: nothing else has changed" unchanged "$T/tree"
for name in $backward; do run backward "$T/tree" "$name"; done
check "backward: nothing else has changed" unchanged "$T/tree"
for name in $short; do
    $MAKE -s -C "$T/tree" clean
    run alone "$T/tree" "$name"
done
check "alone: nothing else has changed" unchanged "$T/tree"
$MAKE -s -C "$T/tree" clean
check "make clean leaves nothing" test ! -e "$T/tree/build" -a ! -e "$T/tree/out"
check "directories are seen" grep -q '^directory build/' "$T/kinds"
check "no path is a file of one step and a directory of another" \
    same "$(sort -u "$T/kinds" | cut -d ' ' -f 2- | sort | uniq -d)" ""
finish
