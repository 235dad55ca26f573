"""Modules with the names of other packages, for programs that change one import."""
