"""The header as a package of Conan 2, in the form of conan-center-index's recipes/shade-h."""
import os

from conan import ConanFile
from conan.tools.files import copy, get
from conan.tools.layout import basic_layout

required_conan_version = ">=2.0"


class ShadeHConan(ConanFile):
    """One header; the program that uses it compiles the implementation."""

    name = "shade-h"
    description = "Phong and Blinn-Phong light and an exact z-buffer rasterizer, one header"
    license = ("MIT", "Unlicense")
    url = "https://github.com/conan-io/conan-center-index"
    homepage = "https://example.org/shade"
    topics = ("graphics", "rasterizer", "software-rendering", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def layout(self):
        """Sources in a folder of their own."""
        basic_layout(self, src_folder="src")

    def package_id(self):
        """One package serves all systems."""
        self.info.clear()

    def source(self):
        """Fetches the tarball of the release."""
        get(self, **self.conan_data["sources"][self.version], strip_root=True)

    def package(self):
        """Lays the two files where Conan looks for them."""
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        copy(self, "shade.h", self.source_folder, os.path.join(self.package_folder, "include"))

    def package_info(self):
        """The names are those of the files that make install lays out: shade-config.cmake, shade.pc."""
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "shade")
        self.cpp_info.set_property("cmake_target_name", "shade::shade")
        self.cpp_info.set_property("pkg_config_name", "shade")
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs.append("m")
