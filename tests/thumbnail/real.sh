# real.sh - sourced by thumbnail.sh: real files of two packages, their pictures beside goldens of
# 64 x 64 pixels in tests/thumbnail/real, and a memory bomb.  Versions of assimp read some files
# differently: of 4096 pixels 3 % may differ by more than 24 of 255.  A package that is not there is
# named and left out.
# REAL_GOLDENS=write draws the goldens anew.
MODELS=/usr/share/assimp/models PROFILES=build/node_modules/@webxr-input-profiles/assets/dist/profiles

real() {                        # name, model
    golden=tests/thumbnail/real/$1.png
    check "$1 drawn" "$THUMBNAIL" "$2" "$T/$1.png" --size 64x64 --samples 4 --quiet
    [ "$REAL_GOLDENS" != write ] || cp "$T/$1.png" "$golden"
    check "$1 as it was" "$T/compare" --limit 24 --count 3% "$golden" "$T/$1.png"
}
real_file() {                   # the name of a golden by the name of a file
    name=${1%.*}
    echo "$name" | tr /A-Z -a-z
}

compile -DSHADE__IMPLEMENTED $STB examples/programs/compare/compare.c "$T/shade.o" -lm -o "$T/compare"
if [ -d "$MODELS" ]; then
    for k in OBJ/spider.obj Collada/duck.dae FBX/huesitos.fbx MD2/sydney.md2 MS3D/jeep1.ms3d \
        PLY/Wuson.ply STL/Spider_binary.stl 3DS/fels.3ds AC/Wuson.ac FBX/phong_cube.fbx \
        STL/Wuson.stl glTF2/ClearCoat-glTF/ClearCoatTest.gltf; do
        real "$(real_file $k)" "$MODELS/$k"
    done
    check "goldens differ from one another" no "$T/compare" --limit 24 --count 3% \
        tests/thumbnail/real/obj-spider.png tests/thumbnail/real/stl-spider_binary.png
else echo "no assimp-testmodels: twelve real files are left out"
fi
if [ -d "$PROFILES" ]; then
    for k in oculus-touch/left.glb valve-index/left.glb htc-vive/none.glb; do
        real "$(real_file $k)" "$PROFILES/$k"
    done
else echo "no @webxr-input-profiles/assets (npm): three controllers are left out"
fi

# memory: 520 kB that unpack to gigabytes, and the same file with fewer vertices
if there python3; then
    check "a small bomb" python3 tests/thumbnail/bomb.py "$T/small.3mf" 10000
    check "is a triangle" draw small.3mf a.ppm $flat --max-memory 512
    check "a large bomb" python3 tests/thumbnail/bomb.py "$T/large.3mf" 8000000
    check "is refused" refused "large.3mf: out of memory; see --max-memory" "$THUMBNAIL" "$T/large.3mf" "$T/none.ppm" --max-memory 512
else echo "no python3: a memory bomb is left out"
fi
