"""What README.md shows runs, one block after the other."""
import re
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from test_mujoco import Engine, model

import shade_h as shade

HERE = Path(__file__).resolve().parents[1]


def test_the_blocks_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names, alone = {}, []
    engine = Engine()    # the package itself is not to be had everywhere
    engine.MjModel = SimpleNamespace(from_xml_string=lambda xml: model())
    engine.MjData, engine.mj_forward = (lambda model: "state"), (lambda model, data: None)
    monkeypatch.setitem(sys.modules, "mujoco", engine)
    blocks = re.findall(r"```python\n(.*?)```", (HERE / "README.md").read_text("utf-8"), re.S)
    assert len(blocks) == 9
    for i, block in enumerate(blocks):
        if i and block.startswith("import"):    # a program of its own
            alone.append({})
        exec(compile(block, "README.md", "exec"), alone[-1] if i and block.startswith("import") else names)
    cameras, mujoco, pyrender = alone
    assert cameras["ids"].shape == (96, 128, 2) and len(np.unique(cameras["ids"][..., 0])) == 3
    assert shade.Picture.open("cameras.png").size == (4 * 128, 96)
    assert mujoco["pairs"].shape == (60, 80, 2) and len(np.unique(mujoco["pairs"][..., 0])) > 5
    assert mujoco["metres"].dtype == np.float32 and mujoco["pixels"].shape == (60, 80, 3)
    assert 0.05 < (pyrender["depth"] > 0).mean() < 0.5 and 3 <= pyrender["depth"].max() <= 4
    assert names["light"].shape == (1000, 3) and names["rgb"].shape == (8, 48, 64, 3)
    assert shade.Picture.open("gear.png") == shade.Picture.open(HERE / "picture.png")
    stress = shade.Picture.open("stress.png")
    assert stress.size == (640, 480) and np.ptp(stress.rgba[:, 560:, 0]) > 200
    for name in shade.__all__:
        assert name in ("Error", "fitted", "VIEWS", "PRESETS", "Part", "load") or \
            getattr(shade, name).__doc__, name


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
