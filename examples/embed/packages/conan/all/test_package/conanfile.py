"""Builds a program against the package, and runs it."""
import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class TestPackageConan(ConanFile):
    """A program that finds the package by CMake."""

    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"

    def requirements(self):
        """The package that is being tested."""
        self.requires(self.tested_reference_str)

    def layout(self):
        """Conan's own folders for CMake."""
        cmake_layout(self)

    def build(self):
        """Configures and compiles."""
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        """Runs the program where the processor can."""
        if can_run(self):
            self.run(os.path.join(self.cpp.build.bindir, "test_package"), env="conanrun")
