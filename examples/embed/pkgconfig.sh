#!/bin/sh
# pkgconfig.sh PREFIX FOLDER - writes into a folder shade.pc, by which pkg-config finds the header,
# and shade-config.cmake with its version, by which CMake's find_package(shade) does.
n=$(sed -n 's/^#define SHADE_VERSION \([0-9]*\).*/\1/p' shade.h)
v=$((n / 10000)).$((n / 100 % 100)).$((n % 100))
cat >"$2/shade.pc" <<END
prefix=$1
includedir=\${prefix}/include

Name: shade
Description: Phong and Blinn-Phong light and an exact z-buffer rasterizer, one header
Version: $v
Cflags: -I\${includedir}
Libs: -lm
END
cat >"$2/shade-config.cmake" <<'END'
# find_package(shade 1.2) makes the target shade::shade, which has the header's folder and -lm.
get_filename_component(shade_PREFIX "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET shade::shade)
    add_library(shade::shade INTERFACE IMPORTED)
    set_target_properties(shade::shade PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${shade_PREFIX}/include"
        INTERFACE_LINK_LIBRARIES "$<$<BOOL:${UNIX}>:m>")
endif()
END
cat >"$2/shade-config-version.cmake" <<END
set(PACKAGE_VERSION $v)
if(PACKAGE_FIND_VERSION_MAJOR EQUAL $((n / 10000)) AND NOT PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_FIND_VERSION STREQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
endif()
END
