#!/bin/sh
# pkgconfig.sh PREFIX - prints shade.pc, by which pkg-config finds the header.
v=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
cat <<END
prefix=$1
includedir=\${prefix}/include

Name: shade
Description: Phong and Blinn-Phong light and an exact z-buffer rasterizer, one header
Version: $((v / 10000)).$((v / 100 % 100)).$((v % 100))
Cflags: -I\${includedir}
Libs: -lm
END
