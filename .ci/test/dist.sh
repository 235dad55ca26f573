#!/bin/sh
# dist.sh - what `make dist` writes: the same bytes twice, from git and from its own tarball; each file
# used alone, in an empty environment; versions that are repeated are those of shade.h.
cd "$(dirname "$0")/../.." || exit 1
. tests/scripts/tools.sh
D=$T/dist
number=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
V=$((number / 10000)).$((number / 100 % 100)).$((number % 100))

# ---- versions
sh .ci/version.sh list >"$T/versions"
while read -r file version; do
    check "the version of $file" same "$version" "$V"
done <"$T/versions"
check "the version of CHANGELOG.md" grep -q "^## ${V%.*}, " CHANGELOG.md
check "the version of Debian's changelog" sh -c "head -n 1 examples/embed/packages/debian/changelog | grep -qF '($V-1)'"
check "the version of >>history" grep -q "^   ${V%.*} of " shade.h

# ---- the size of shade.h's parts
if command -v python3 >/dev/null; then
    check "the ceilings of tokens" same "$(python3 tests/scripts/halves.py shade.h --budgets)" ""
else left_out "the ceilings of tokens (no python3)"; fi

# ---- the tarball: twice from git, and from itself
git rev-parse --is-inside-work-tree >/dev/null 2>&1 || [ -f .ci/files ] ||
    { left_out "the release: no clone and no tarball"; finish; }
made() { sh .ci/dist.sh "$@" >"$T/made" 2>&1 || { cat "$T/made"; return 1; }; }
check "make dist" made "$D"
A=$D/shade-$V.tar.gz
check "all of it again" sh .ci/dist.sh "$T/again"
for file in "$T"/again/*.gz "$T"/again/*.whl "$T"/again/*.tgz "$T"/again/*.zip; do
    [ ! -f "$file" ] || check "the same bytes: ${file##*/}" cmp "$file" "$D/${file##*/}"
done
check "nothing else, and no file less" cmp "$T/again/SHA256SUMS" "$D/SHA256SUMS"
check "pip tells the tarball and the sdist apart" no test -e "$D/shade-h-$V.tar.gz"
mkdir "$T/own" && tar -C "$T/own" -xzf "$A"
check "a tarball of the tarball" sh "$T/own/shade-$V/.ci/dist.sh" "$T/third" source
check "the same bytes from it" cmp "$A" "$T/third/shade-$V.tar.gz"
check "checksums" sh -c "cd '$D' && sha256sum --quiet -c SHA256SUMS"
check "notes" grep -q . "$D/NOTES.txt"
clean="env -i PATH=/usr/local/bin:/usr/bin:/bin HOME=$T/own"
tar -C "$T/own" -xzf "$D/shade-core-$V.tar.gz"
check "make in the core" $clean make -s -C "$T/own/shade-core-$V"
check "make test in the core" $clean make -s -C "$T/own/shade-core-$V" test

# ---- shade.h alone, and each library: a triangle with the same bits everywhere
mkdir "$T/alone" && cp "$D/shade.h" "$T/alone"
cp .ci/test/dist.c "$T/alone"
check "shade.h alone" cc -std=c99 -Wall -Werror -O2 -DSHADE_IMPLEMENTATION "$T/alone/dist.c" -I"$T/alone" -lm -o "$T/alone/own"
want=$("$T/alone/own")
check "it draws" sh -c "echo '$want' | grep -Eqx '[0-9a-f]{8}'"
unpacked() {                    # end of a wheel's name: its folder
    rm -rf "$T/wheel"
    mkdir "$T/wheel" && python3 -m zipfile -e "$D"/shade_h-*$1.whl "$T/wheel" && ls "$T"/wheel/shade_h/libshade.*
}
loaded() {                      # end of a wheel's name, compiler, what runs it
    there "$2" || { left_out "$1: no $2"; return; }
    [ -z "$3" ] || there "${3%% *}" || { left_out "$1: no ${3%% *}"; return; }
    ls "$D"/shade_h-*"$1".whl >/dev/null 2>&1 || { left_out "$1: no wheel"; return; }
    file=$(unpacked "$1")
    case $file in *.dll) link= ;; *) link=-ldl ;; esac
    check "a program for $1" "$2" -std=gnu99 -O1 -DLOADED "$T/alone/dist.c" -I"$T/alone" $link -lm \
        -o "$T/alone/load.exe"
    case $1 in win*) file=$(echo "$file" | tr / '\\' | sed 's/^/Z:/') ;; esac
    check "the library of $1" same "$($3 "$T/alone/load.exe" "$file" 2>/dev/null | tr -d '\r')" "$want"
}
loaded manylinux_2_17_x86_64 gcc ""
loaded musllinux_1_2_x86_64 musl-gcc ""
loaded manylinux_2_17_aarch64 aarch64-linux-gnu-gcc "qemu-aarch64 -L /usr/aarch64-linux-gnu"
find_wine
loaded win_amd64 x86_64-w64-mingw32-gcc "${wine:-wine}"
left_out "musllinux aarch64, macOS and Windows on Arm: nothing here runs them"

# ---- wheels
for wheel in "$D"/shade_h-*.whl; do
    [ -f "$wheel" ] || { left_out "wheels: none"; break; }
    name=${wheel##*/}
    check "licence, types and one library in $name" sh -c "python3 -m zipfile -l '$wheel' >'$T/list' &&
        grep -q 'dist-info/LICENSE' '$T/list' && grep -q 'shade_h/py.typed' '$T/list' &&
        [ \$(grep -c 'shade_h/libshade' '$T/list') -eq 1 ]"
    if there readelf; then
        case $name in *manylinux*)
            most=$(readelf -V "$(unpacked "${name##*.}" 2>/dev/null || unpacked "$(echo "$name" |
                sed 's/.*\(manylinux_2_17_[a-z0-9_]*\)\.whl/\1/')")" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
            check "glibc 2.17 is enough for $name" sh -c "printf '%s\n' $most GLIBC_2.17 | sort -V | tail -n 1 |
                grep -qx GLIBC_2.17" ;;
        esac
    fi
done
if there twine; then check "twine" sh -c "twine check --strict '$D'/shade_h-*"
else left_out "twine"; fi
find_python "numpy, venv, ensurepip"
if [ "$python" ] && ls "$D"/shade_h-*manylinux_2_17_x86_64.whl >/dev/null 2>&1 && [ "$(uname -m)" = x86_64 ]; then
    check "an environment" $python -m venv --system-site-packages "$T/env"
    check "the wheel is installed" $clean "$T/env/bin/pip" install -q --no-index --no-deps \
        "$D"/shade_h-*manylinux_2_17_x86_64.whl
    check "and draws" $clean sh -c "cd '$T' && '$T/env/bin/python' -c \"
import shade_h
shade_h.render([[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 2]]).save('wheel.png')\" && [ -s wheel.png ]"
else left_out "the wheel in Python: no numpy with venv"; fi

# ---- npm
if [ -f "$D/shade-h-$V.tgz" ]; then
    mkdir "$T/npm"
    check "the npm package is installed" sh -c "cd '$T/npm' && npm install --silent --offline --no-audit '$D/shade-h-$V.tgz'"
    check "and draws" sh -c "cd '$T/npm' && node -e \"
        require('shade-h').render({ positions: [0, 0, 0, 1, 0, 0, 0, 0, 1] }).png().then((x) =>
            process.exit(x.length > 500 ? 0 : 1))\""
else left_out "npm"; fi
if [ -f "$D/shade-$V-pages.zip" ]; then
    check "the pages" sh -c "python3 -m zipfile -l '$D/shade-$V-pages.zip' | grep -q index.html"
    mkdir "$T/pages"
    check "they unpack" python3 -m zipfile -e "$D/shade-$V-pages.zip" "$T/pages"
    lost() {                    # what a page of the courses names and the archive lacks
        cd "$T/pages/shade-$V-pages" || return
        grep -ohE '(src|href)="[^"#:]+["#]' course*.html slides*.html 2>/dev/null |
            sed 's/["#]$//; s/.*"//' | sort -u | while read -r file; do [ -s "$file" ] || echo "$file"; done
    }
    check "pictures and scripts of the courses are in it" same "$(lost)" ""
else left_out "pages"; fi

# ---- the programs for Windows, as a newcomer tries them: the first commands of the zip's README
Z=$D/shade-$V-windows.zip
if [ -f "$Z" ] && [ "$wine" ]; then
    check "the zip for Windows unpacks" python3 -m zipfile -e "$Z" "$T"
    first() {                   # the command of README.txt that begins with .\ and a word
        cd "$T/shade-$V-windows" || return
        line=$(tr -d '\r' <README.txt | sed -n "s/^ *\.\\\\\\(shade-$1\\( .*\\)*\\)\$/\1/p" | sed -n "${2:-1}p")
        echo "$line"
        name=${line%% *}
        "$wine" "$name.exe" ${line#* }
    }
    check "a thumbnail" first thumbnail
    check "is a PNG" grep -q IHDR "$T/shade-$V-windows/nut.png"
    check "a sheet" first thumbnail 2
    check "is a PNG too" grep -q IHDR "$T/shade-$V-windows/sheet.png"
    check "a turn" first batch
    check "of 36 pictures" same "$(ls "$T/shade-$V-windows/frames" | wc -l)" 36
    check "the picture and the model agree" first compare
    check "the program tells its version" sh -c "'$wine' '$T/shade-$V-windows/shade-thumbnail.exe' --version | grep -q '$V'"
else left_out "the zip for Windows: no wine, or no zip"; fi

# ---- what of others is in it: the SBOM tells of it, and its notice is there
holds() {                       # end of a file's name, file in it, name, words of its notice
    python3 - "$D" "$@" <<'END'
import fnmatch, json, pathlib, sys, tarfile, zipfile
folder, end, notices, name, words = sys.argv[1:]
path, = pathlib.Path(folder).glob(f"*{end}")
if path.suffix == ".tgz":
    text = tarfile.open(path).extractfile(f"package/{notices}").read()
else:
    with zipfile.ZipFile(path) as file:
        found, = [n for n in file.namelist() if n.endswith(notices)]
        text = file.read(found)
assert words in text.decode(), words
told = json.loads(next(pathlib.Path(folder).glob("*.spdx.json")).read_text())
one, = [p for p in told["packages"] if p["name"] == name]
assert one["licenseDeclared"] != "NOASSERTION" and one["versionInfo"] not in ("", "unknown"), one
file, = [p["SPDXID"] for p in told["packages"] if p.get("packageFileName") == path.name]
assert {"spdxElementId": file, "relationshipType": "CONTAINS", "relatedSpdxElement": one["SPDXID"]} in told["relationships"]
END
}
zip=-windows.zip
if [ -f "$D/shade-$V$zip" ]; then
    check "stb in the programs for Windows" holds $zip NOTICES.txt stb "Copyright (c) 2017 Sean Barrett"
    check "zlib" holds $zip NOTICES.txt zlib "Jean-loup Gailly and Mark Adler"
    check "their runtime" holds $zip NOTICES.txt mingw-w64 "Zope Public License"
fi
for wheel in win_amd64 win_arm64; do
    [ ! -f "$D/shade_h-$V-py3-none-$wheel.whl" ] ||
        check "the runtime in the wheel for $wheel" holds $wheel.whl NOTICES.txt mingw-w64 "Zope Public License"
done
[ ! -f "$D/shade-h-$V.tgz" ] || check "wasi-libc in the npm package" holds .tgz NOTICES.txt wasi-libc "wasi-libc contributors"
[ ! -f "$D/shade-$V-pages.zip" ] || ! python3 -m zipfile -l "$D/shade-$V-pages.zip" | grep reveal.js >/dev/null ||
    check "reveal.js in the pages" holds -pages.zip NOTICES.txt reveal.js "Hakim El Hattab"

# ---- the pages of the registries in what is uploaded
linked() {                      # archive, file in it: every link is absolute
    tar -xzOf "$1" "$2" >"$T/page" && grep -q '^## New in ' "$T/page" && grep -q '](https://' "$T/page" &&
        same "$(grep -oE '\]\([^)]*\)' "$T/page" | grep -v '](https://\|](#')" ""
}
[ ! -f "$D/shade_h-$V.tar.gz" ] || check "the page of PyPI" linked "$D/shade_h-$V.tar.gz" "shade_h-$V/README.md"
[ ! -f "$D/shade-h-$V.tgz" ] || check "the page of npm" linked "$D/shade-h-$V.tgz" package/README.md

# ---- the bill of materials, its ids, relations and checksums
check "SBOM: a version, and a sum for each file" python3 -c "
import hashlib, json, pathlib
told = json.load(open('$D/shade-$V.spdx.json'))
files = {p['packageFileName']: p['checksums'][0]['checksumValue'] for p in told['packages'] if 'packageFileName' in p}
own = {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in pathlib.Path('$D').iterdir()
       if p.name != 'SHA256SUMS' and not p.name.endswith('.spdx.json')}
assert files == own, set(files) ^ set(own)
ids = {p['SPDXID'] for p in told['packages']} | {told['SPDXID']}
assert all({r['spdxElementId'], r['relatedSpdxElement']} <= ids for r in told['relationships'])"
finish
