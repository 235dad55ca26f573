"""The header as a package of Conan 2, from a clone: conan create examples/embed/packages/conan"""
from pathlib import Path

from conan import ConanFile
from conan.tools.files import copy


class Shade(ConanFile):
    """One header; the program that uses it compiles the implementation."""

    name = "shade-h"
    version = "1.3.0"
    description = "Phong and Blinn-Phong light and an exact z-buffer rasterizer, one header"
    license = ("MIT", "Unlicense")
    homepage = "https://example.org/shade"
    topics = ("graphics", "rasterizer", "software-rendering", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def export_sources(self):
        """Takes the header and its licences from the top of the clone."""
        top = Path(self.recipe_folder).resolve().parents[3]
        for name in ("shade.h", "LICENSE"):
            copy(self, name, str(top), self.export_sources_folder)

    def package(self):
        """Lays the two files where Conan looks for them."""
        copy(self, "shade.h", self.source_folder, str(Path(self.package_folder) / "include"))
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder) / "licenses"))

    def package_id(self):
        """One package serves all systems."""
        self.info.clear()

    def package_info(self):
        """Names the package as CMake and pkg-config call it elsewhere."""
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "shade")
        self.cpp_info.set_property("cmake_target_name", "shade::shade")
        self.cpp_info.set_property("pkg_config_name", "shade")
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
