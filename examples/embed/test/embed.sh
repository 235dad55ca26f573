#!/bin/sh
# embed.sh - examples/embed: the commands of its README in a copy of this tree; the same projects
# with shade.h from a git repository, as submodule, by FetchContent, by a wrap file; what they draw
# and print.  What is not installed is named and left out.
cd "$(dirname "$0")/../../.." || exit 1
. tests/scripts/tools.sh
quick_compiler cc "$(command -v "${CC:-cc}")"
TOP=$PWD

# A copy of what the projects need
mkdir -p "$T/tree"
cp -R Makefile shade.h examples "$T/tree"
E=$T/tree/examples/embed B=$T/tree/build/embed
cxx=${CXX:-$(command -v c++ || command -v g++ || command -v clang++)}
[ -n "$cxx" ] && quick_compiler c++ "$(command -v "$cxx")"
find_python "numpy, PIL"
[ -z "$python" ] || ln -s "$(command -v $python)" "$T/bin/python3"
PATH=$T/bin:$PATH CC=$T/bin/cc CXX=$T/bin/c++
export PATH CC CXX

# The commands of the block of the README that holds a text
commands() {
    awk -v text="$1" '/^```/ { if (inside && index(block, text)) printf "%s", block
                               inside = $0 == "```sh"; block = ""; next }
                      inside { block = block $0 "\n" }' "$E/README.md" >"$T/commands"
    [ -s "$T/commands" ] || { echo "no commands with $1"; return 1; }
    (cd "$E" && sh -e "$T/commands")
}
cc -O1 -pthread "-I$TOP" "$TOP/examples/programs/compare/compare.c" -lm -o "$T/compare"
cc -O1 -I. examples/embed/cmake/*.c -lm -o "$T/saddle" && "$T/saddle" "$T/saddle.ppm"
cc -O1 -I. examples/embed/meson/*.c -lm -o "$T/ball" && "$T/ball" >"$T/ball.txt"
alike() { "$T/compare" "$T/saddle.ppm" "$@"; }

# ---- what it should be --------------------------------------------------------------------------
# Blinn-Phong at each character in double; where the brightness is that of the next character within
# 1e-4, either will do
ball() {
    awk '
        function max(a, b) { return a > b ? a : b }
        { for (column = 0; column < 48; column++) {
            x = (column - 23.5) / 24; y = (11.5 - (NR - 1)) / 12; zz = 1 - x * x - y * y
            got = substr($0, column + 1, 1); chars++
            if (zz < 0) { wrong += got != " "; continue }
            z = sqrt(zz); lx = -2 - x; ly = 3 - y; lz = 4 - z; vx = -x; vy = -y; vz = 5 - z
            l = sqrt(lx * lx + ly * ly + lz * lz); v = sqrt(vx * vx + vy * vy + vz * vz)
            hx = lx / l + vx / v; hy = ly / l + vy / v; hz = lz / l + vz / v
            h = sqrt(hx * hx + hy * hy + hz * hz)
            nl = (x * lx + y * ly + z * lz) / l; nh = (x * hx + y * hy + z * hz) / h
            I = 0.1 + (nl > 0 ? 0.6 * nl + 0.4 * exp(30 * log(max(nh, 1e-9))) : 0)
            least = int(9 * (I - 1e-4)); most = int(9 * (I + 1e-4))
            at = index(".:-=+*%@#", got) - 1
            wrong += at < (least > 8 ? 8 : least) || at > (most > 8 ? 8 : most)
            seen[got]
        } }
        END { for (c in seen) n++; print chars " characters, " wrong + 0 " wrong, " n " different"
              exit chars != 24 * 48 || wrong || n < 9 }' "$1"
}
check "the ball" ball "$T/ball.txt"
# Its corner is the colour it was cleared to, encoded; its middle is the saddle, green.
corner() {
    same "$(head -n 2 "$T/saddle.ppm" | tr '\n' ' ')" "P6 640 480 " &&
        same "$(tail -c +16 "$T/saddle.ppm" | od -An -tu1 -N3 | tr -s ' ')" " 39 48 63" &&
        tail -c +$((16 + 3 * (240 * 640 + 320))) "$T/saddle.ppm" | od -An -tu1 -N3 |
        awk '{ print; exit !($2 > $1 + 20 && $2 > $3 + 20) }'
}
check "the saddle" corner

# ---- CMake, Meson, and git ----------------------------------------------------------------------
if there git; then
    git() { command git "$@"; }
    # your copy and your tag: https://example.org/ is a directory here
    GIT_CONFIG_COUNT=5 GIT_CONFIG_NOSYSTEM=1 GIT_CONFIG_GLOBAL=/dev/null
    GIT_CONFIG_KEY_0=url.file://$T/remote/.insteadOf GIT_CONFIG_VALUE_0=https://example.org/
    GIT_CONFIG_KEY_1=protocol.file.allow GIT_CONFIG_VALUE_1=always
    GIT_CONFIG_KEY_2=user.name GIT_CONFIG_VALUE_2=tester
    GIT_CONFIG_KEY_3=user.email GIT_CONFIG_VALUE_3=tester@example.org
    GIT_CONFIG_KEY_4=advice.detachedHead GIT_CONFIG_VALUE_4=false
    export GIT_CONFIG_COUNT GIT_CONFIG_NOSYSTEM GIT_CONFIG_GLOBAL \
        GIT_CONFIG_KEY_0 GIT_CONFIG_KEY_1 GIT_CONFIG_KEY_2 GIT_CONFIG_KEY_3 GIT_CONFIG_KEY_4 \
        GIT_CONFIG_VALUE_0 GIT_CONFIG_VALUE_1 GIT_CONFIG_VALUE_2 GIT_CONFIG_VALUE_3 \
        GIT_CONFIG_VALUE_4
    repository() {
        git init -q "$T/remote/shade.git" && cd "$T/remote/shade.git" && cp "$TOP/shade.h" . &&
            git add shade.h && git commit -q -m "shade.h" && git tag v1.4.0
    }
    (repository) >"$T/log" 2>&1 || { cat "$T/log"; failed=$((failed + 1)); }
else left_out "git: FetchContent from a repository, submodule and wrap file"
fi
# The last -O of a file's line in compile_commands.json; nothing is compiled.
level_of() {                    # the file's name, where it is built
    grep -o '"command": ".*'"$1"'[^/]*"' "$2/compile_commands.json" | grep -oE ' -O[0-9sg]' | tail -n 1
}
built() {                       # where CMake builds
    cmake --build "$1" && "$1/saddle" "$1/drawn.ppm" && alike "$1/drawn.ppm"
}
if there cmake; then
    check "CMake, as the README says" commands "cmake -S"
    check "the bits of the saddle" alike "$B/saddle.ppm"
    optimised() {               # build type, flag of shade.c, flag of saddle.c
        cmake -S "$E/cmake" -B "$T/b$1" -DCMAKE_BUILD_TYPE="$1" -DCMAKE_EXPORT_COMPILE_COMMANDS=1 \
            -DFETCHCONTENT_SOURCE_DIR_SHADE="$T/tree" &&
            same "$(level_of shade.c "$T/b$1")" "$2" && same "$(level_of saddle.c "$T/b$1")" "$3"
    }
    check "no build type: the implementation alone has -O2" optimised "" " -O2" ""
    check "Debug: likewise" optimised Debug " -O2" ""
    check "Release: what CMake takes" optimised Release " -O3" " -O3"
    check "MinSizeRel: likewise" optimised MinSizeRel " -Os" " -Os"
    if there git; then
        cp -R "$E/cmake" "$T/fetch"
        check "CMake fetches" cmake -S "$T/fetch" -B "$T/fetch/b"
        check "into its own directory" test -f "$T/fetch/b/_deps/shade-src/shade.h"
        check "and draws the saddle" built "$T/fetch/b"
        cp -R "$E/cmake" "$T/submodule"
        submodule() {
            cd "$T/submodule" && git init -q &&
                git submodule add https://example.org/shade.git shade && test -f shade/shade.h
        }
        check "a submodule" submodule
        cd "$TOP" || exit 1
        check "CMake takes it" cmake -S "$T/submodule" -B "$T/submodule/b"
        check "and fetches nothing" test ! -e "$T/submodule/b/_deps"
        check "and draws the saddle" built "$T/submodule/b"
    fi
else left_out CMake
fi
if there meson && there ninja; then
    if there pkg-config; then
        check "Meson, as the README says" commands "meson setup"
        check "the installed header is taken" grep -q 'Run-time dependency shade found: YES 1\.' \
            "$B/meson/meson-logs/meson-log.txt"
        check "the ball" sh -c "'$B/meson/ball' | cmp - '$T/ball.txt'"
        check "a debug build" env PKG_CONFIG_PATH="$B/prefix/share/pkgconfig" \
            meson setup --buildtype=debug "$T/debug" "$E/meson"
        check "the implementation has -O2 there" same "$(level_of shade.c "$T/debug")" " -O2"
        check "the program has not" test "$(level_of ball.c "$T/debug")" != " -O2"
    else left_out "pkg-config: an installed header with Meson"
    fi
    if there git; then
        cp -R "$E/meson" "$T/wrap"
        check "Meson fetches" meson setup --wrap-mode=forcefallback "$T/wrap/b" "$T/wrap"
        check "into its own directory" test -f "$T/wrap/subprojects/shade/shade.h"
        check "Meson builds" ninja -C "$T/wrap/b"
        check "the ball" sh -c "'$T/wrap/b/ball' | cmp - '$T/ball.txt'"
    fi
else left_out "Meson with ninja"
fi

# ---- other languages, other memory --------------------------------------------------------------
if [ -x "$T/bin/c++" ] && printf '#include <bit>\n#include <glm/glm.hpp>\n' |
    c++ -std=c++20 -x c++ -fsyntax-only - 2>/dev/null; then
    check "GLM, as the README says" commands glm.cpp
    check "the saddle but for GLM's roundings" alike --limit 2 --count 50 "$B/glm.ppm"
else left_out "C++20 with GLM"
fi
if [ -x "$T/bin/python3" ]; then
    check "Python, as the README says" commands saddle.py
    check "a PNG of 640 x 480, red green blue alpha" python3 -c "
from PIL import Image
image = Image.open('$B/saddle.png')
assert image.size == (640, 480) and image.mode == 'RGBA', (image.size, image.mode)
image.convert('RGB').save('$T/python.ppm')"
    check "the bits of the saddle" alike "$T/python.ppm"
else left_out "Python with numpy and Pillow"
fi
if printf '#include <linux/fb.h>\n' | cc -fsyntax-only -x c - 2>/dev/null; then
    check "the framebuffer, as the README says" commands framebuffer.c
    check "no such device" sh -c "! '$B/framebuffer' '$T/none'"
    check "no device at all" sh -c "! '$B/framebuffer' '$T/saddle.ppm'"
    check "the device of the test" cc -O1 -I. examples/embed/test/framebuffer.c \
        examples/embed/cmake/saddle.c -lm -o "$T/framebuffer"
    "$T/framebuffer" "$T/device" >"$T/run" 2>"$T/messages"
    grep -vE '^[0-9]+ passed, ' "$T/run"
    p=$(sed -n 's/^\([0-9]*\) passed, .*/\1/p' "$T/run")
    f=$(sed -n 's/.* passed, \([0-9]*\) failed$/\1/p' "$T/run")
    passed=$((passed + ${p:-0})) failed=$((failed + ${f:-1}))
    check "each refusal in one line" same "$(wc -l <"$T/messages")" 4
else left_out "linux/fb.h"
fi

# ---- golden pictures ----------------------------------------------------------------------------
check "golden, as the README says" commands golden.sh
check "no difference" same "$(tail -n 1 "$T/log")" same
golden() {                      # exit status, options
    want=$1; shift
    sh "$E/golden/golden.sh" "$@"
    same "$?" "$want"
}
red() {
    tail -c +14 "$B/golden/difference.ppm" | od -An -v -tu1 -w3 | grep -c '  0   0$'
}
sed 's/PRESET_JADE/PRESET_RUBY/' examples/embed/cmake/saddle.c >"$E/cmake/saddle.c"
check "a ruby is no jade" golden 1
check "which the picture shows" test "$(red)" -gt 300
check "accepted" golden 0 --accept
check "it is the golden one" golden 0
sed 's/positions\[k\]/position[k]/' examples/embed/cmake/saddle.c >"$E/cmake/saddle.c"
check "what does not compile is no difference" golden 2

# the recipe: its steps, in a project that has shade.h in shade/
mkdir "$T/project"
ln -s "$TOP" "$T/project/shade"
cp examples/embed/cmake/*.[ch] examples/embed/golden/golden.ppm "$T/project"
sed -n 's/^      - run: //p' examples/embed/README.md >"$T/recipe"
check "a recipe of three steps" test "$(wc -l <"$T/recipe")" -eq 3
recipe() { (cd "$T/project" && sh -e "$T/recipe"); }
check "the recipe passes" recipe
sed 's/0, 0, 1/0, 0.1f, 1/' examples/embed/cmake/saddle.c >"$T/project/saddle.c"
check "and fails when the camera leans" sh -c "cd '$T/project'; sh -e '$T/recipe'; [ \$? -eq 1 ]"
check "with a picture to keep" test -s "$T/project/difference.ppm"

finish
