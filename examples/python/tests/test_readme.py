"""What README.md shows runs, one block after the other."""
import re
from pathlib import Path

import numpy as np
import pytest

import shade_h as shade

HERE = Path(__file__).resolve().parents[1]


def test_the_blocks_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    blocks = re.findall(r"```python\n(.*?)```", (HERE / "README.md").read_text("utf-8"), re.S)
    assert len(blocks) == 7
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
    assert names["light"].shape == (1000, 3) and names["rgb"].shape == (8, 48, 64, 3)
    assert shade.Picture.open("gear.png") == shade.Picture.open(HERE / "picture.png")
    stress = shade.Picture.open("stress.png")
    assert stress.size == (640, 480) and np.ptp(stress.rgba[:, 560:, 0]) > 200
    for name in shade.__all__:
        assert name in ("Error", "fitted", "VIEWS", "PRESETS", "Part", "load") or \
            getattr(shade, name).__doc__, name


def test_the_server_has_the_lines_that_are_said():
    lines = (HERE / "mcp_server.py").read_text("utf-8").count("\n")
    assert f"an MCP server of {lines} lines" in (HERE / "README.md").read_text("utf-8")


def test_the_notebook_runs_and_its_pictures_differ():
    nbformat = pytest.importorskip("nbformat")
    book = nbformat.read(HERE / "course.ipynb", 4)
    nbformat.validate(book)
    names = {}
    for cell in book.cells:
        if cell.cell_type == "code":
            exec(compile(cell.source, "course.ipynb", "exec"), names)
    pictures = names["iterations"]
    assert len(pictures) == 5
    for one, two in zip(pictures, pictures[1:]):
        assert np.count_nonzero(one.difference(two)) > 1000
    assert names["lobes"].rgba.std() > 10
