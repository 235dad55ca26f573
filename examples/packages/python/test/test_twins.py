"""The structs of _native.py are those of shade.h, field by field."""
import ctypes
import subprocess
import sys
from pathlib import Path

import pytest

from shade_h import _native

STRUCTS = Path(__file__).resolve().parents[4] / "tests/scripts/structs.py"
TWINS = {twin.__doc__: twin for twin in vars(_native).values()
         if isinstance(twin, type) and issubclass(twin, ctypes.Structure)
         and (twin.__doc__ or "").startswith("shade_")}


@pytest.fixture(scope="module")
def lines():
    if not STRUCTS.is_file():
        pytest.skip("needs a clone")
    told = subprocess.run([sys.executable, STRUCTS], check=True, stdout=subprocess.PIPE)
    return [line.split() for line in told.stdout.decode().splitlines()]


@pytest.mark.parametrize("struct", TWINS)
def test_fields(struct, lines):
    twin = TWINS[struct]
    wanted = [(name, int(at), int(size)) for of, name, at, size in lines if of == struct]
    made = [(name, getattr(twin, name).offset, getattr(twin, name).size)
            for name, *_ in twin._fields_]
    assert wanted and made == wanted
