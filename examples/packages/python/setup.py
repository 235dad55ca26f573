"""Compiles library.c with shade.h into a library that is loaded by ctypes.

The library knows nothing of Python, so that one wheel serves all versions on a platform.  In a
clone the headers are those of the tree; a source distribution carries copies in headers/.
"""
import shutil
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist
from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
FOLDERS = ("examples/elsewhere", "examples/kit", "examples/shared")


def top() -> Path:
    """Returns the folder that shade.h is in."""
    for folder in (HERE / "headers", HERE.parents[2]):
        if (folder / "shade.h").is_file():
            return folder
    sys.exit("shade.h is neither in headers/ nor three folders up: build from a clone or an sdist")


class BuildLibrary(build_ext):
    """Builds a plain shared library under one name for all versions of Python."""

    def get_ext_filename(self, fullname: str) -> str:
        """Leaves the version of Python out of the name."""
        return fullname.replace(".", "/") + (".dll" if sys.platform == "win32" else ".so")

    def get_export_symbols(self, ext: Extension) -> list:
        """Exports no PyInit function, because there is none."""
        return []


class PlatformWheel(bdist_wheel):
    """A wheel for one platform and every Python 3."""

    def finalize_options(self) -> None:
        """Marks the wheel as one with machine code."""
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple:
        """Keeps the platform alone of the tag."""
        return ("py3", "none", super().get_tag()[2])


class SourceWithHeaders(sdist):
    """Copies the headers beside setup.py into the archive."""

    def make_release_tree(self, base_dir: str, files: list) -> None:
        """Adds headers/ to what the archive holds."""
        super().make_release_tree(base_dir, files)
        headers = Path(base_dir) / "headers"
        for folder in FOLDERS:
            for header in (top() / folder).rglob("*.[ch]"):
                if "test" in header.parts:
                    continue
                copy = headers / header.relative_to(top())
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(header, copy)
        shutil.copy(top() / "shade.h", headers)
        for path in (headers / "shade.h", Path(base_dir) / "library.c"):
            if not path.is_file():
                sys.exit(f"{path} is missing from the archive")


# A product and a sum are rounded apart, as in shade.h, so that all machines give the same bytes.
# Python's own flags often have -fwrapv, with which gcc makes no vectors of some loops: a small
# picture takes twice as long.
FLAGS = [] if sys.platform == "win32" else ["-O2", "-std=gnu99", "-fno-wrapv",
                                              "-ffp-contract=off", "-Wno-unused-function"]
windows = sys.platform == "win32"
setup(
    ext_modules=[Extension(
        "shade_h.libshade", ["library.c"], include_dirs=[str(top())],
        define_macros=[("_DEFAULT_SOURCE", None)],
        extra_compile_args=FLAGS,
        extra_link_args=[] if windows else ["-lm", "-pthread"])],
    cmdclass={"build_ext": BuildLibrary, "bdist_wheel": PlatformWheel, "sdist": SourceWithHeaders},
)
