# pictures.sh - what stb gives: PNG, its alpha, textures.  Read by tests/scripts/thumbnail.sh.

check "PNG by its name" draw torus.obj a.png --samples 1
check "PPM" draw torus.obj a.ppm --samples 1
check "the same picture" "$T/look" same "$T/a.png" "$T/a.ppm" 0
"$THUMBNAIL" "$T/torus.obj" - --png --size 120x90 --samples 1 >"$T/b.png"
check "PNG to standard output" "$T/look" same "$T/b.png" "$T/a.ppm" 0
check "no background" draw flat.obj a.png --background none --no-shadow --rotate 0 --model emissive
check "nothing around" "$T/look" alpha "$T/a.png" 0.01 0.01 0
check "the model is opaque" "$T/look" alpha "$T/a.png" 0.5 0.5 255
color=$("$T/look" display 0.448 0.1329 0.0331)
check "in its own color" "$T/look" pixel "$T/a.png" 0.5 0.5 $color 1
check "glass over nothing" draw glass.obj a.png --background none --no-shadow --rotate 0 \
    --model emissive --size 90x90
check "is as clear as d says" "$T/look" alpha "$T/a.png" 0.5 0.9 64
check "a full device" refused "No space left" "$THUMBNAIL" "$T/torus.obj" /dev/full --png

# quarters of the texture on a square seen from the front, times k_e 0.448
quarters="--model emissive --background black --no-shadow --rotate 0 --size 200x200"
check "texture" draw map.obj a.ppm $quarters
check "no warning" test ! -s "$T/err"
check "blue" pixel 0.28 0.3 0.00945 0.0360 0.2587
check "green" pixel 0.72 0.3 0.00593 0.1572 0.0203
check "red" pixel 0.28 0.75 0.3200 0.0143 0.00302
check "grey" pixel 0.72 0.75 0.0573 0.0573 0.0573
sed 's/map_Kd/map_Ke/' "$T/map.mtl" >"$T/glow.mtl"
sed 's/map.mtl/glow.mtl/' "$T/map.obj" >"$T/glow.obj"
check "a texture of what shines" draw glow.obj b.ppm $quarters
check "shines as a colored surface does" "$T/look" same "$T/a.ppm" "$T/b.ppm" 0
check "no warning about it" test ! -s "$T/err"
sed '/^Ke/d' "$T/glow.mtl" >"$T/bare.mtl"
sed 's/map.mtl/bare.mtl/' "$T/map.obj" >"$T/bare.obj"
check "without Ke" draw bare.obj b.ppm $quarters
check "it shines as it is" sh -c "'$T/look' pixel '$T/b.ppm' 0.72 0.75 $("$T/look" display 0.128 0.128 0.128) 3"
check "holes" draw holes.obj a.ppm $quarters
check "blue stays" pixel 0.28 0.3 0.00945 0.0360 0.2587
check "red is cut out" pixel 0.28 0.75 0 0 0
check "the same alpha, which no map_d asks for" draw whole.obj a.ppm $quarters
check "cuts nothing out" pixel 0.28 0.75 0.3200 0.0143 0.00302
check "map_d with a picture of its own" draw other.obj a.ppm $quarters
check "is a warning" grep "mask.tga.*map_d counts only" "$T/err"
check "a lost texture" draw lost.obj a.ppm $quarters
check "is a warning" grep "no such file.png.*No such file" "$T/err"
check "and the plain color" pixel 0.5 0.5 0.448 0.1329 0.0331
check "quietly" draw lost.obj a.ppm $quarters --quiet
check "says nothing" test ! -s "$T/err"
printf 'no picture' >"$T/no such file.png"
check "a broken texture" draw lost.obj a.ppm $quarters
check "is a warning too" grep "no such file.png.*no picture" "$T/err"
rm "$T/no such file.png"
