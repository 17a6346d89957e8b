"""The notebooks run, and what they show is what comes out."""

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def tool(name):
    """A module of a folder that is no package."""
    spec = importlib.util.spec_from_file_location(name, ROOT / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


RUN = tool("docs/run_notebooks")
DOCS = tool("tests/docs/test_docs")


def texts(outputs):
    """What a cell shows as text."""
    pieces = [shown.get("text") or shown["data"].get("text/plain", ()) for shown in outputs]
    return "".join("".join(piece) + "\n" for piece in pieces)


def test_there_are_four():
    assert [path.stem for path in RUN.notebooks()] == ["equipment", "identify", "tower", "vehicle"]


@pytest.mark.parametrize("path", RUN.notebooks(), ids=lambda path: path.stem)
def test_a_notebook_shows_what_comes_out(path, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    cells = [c for c in RUN.read(path)["cells"] if c["cell_type"] == "code"]
    found = RUN.run(path, tmp_path, figures=False)
    for number, (cell, outputs) in enumerate(zip(cells, found, strict=True), 1):
        if shown := texts(cell["outputs"]).strip():
            DOCS.assert_shown(shown, texts(outputs), f"{path.stem}, code cell {number}")


def test_a_number_that_is_not_so_is_seen(tmp_path):
    (path,) = (p for p in RUN.notebooks() if p.stem == "tower")
    spoilt = tmp_path / "tower.ipynb"
    text = path.read_text(encoding="utf-8")
    shown = re.search(r"3 bending from (0\.\d+)", text)[1]
    spoilt.write_text(text.replace(f"from {shown}", "from 0.999999"), encoding="utf-8")
    with pytest.raises(AssertionError, match="shows"):
        test_a_notebook_shows_what_comes_out(spoilt, tmp_path, pytest.MonkeyPatch())


def test_a_notebook_is_a_page_with_its_figures(tmp_path):
    (path,) = (p for p in RUN.notebooks() if p.stem == "tower")
    RUN.as_page(path, tmp_path)
    page = (tmp_path / "tower.md").read_text(encoding="utf-8")
    figures = re.findall(r"!\[[^]]*\]\((\S+\.png)\)", page)
    assert figures
    assert all((tmp_path / name).read_bytes().startswith(b"\x89PNG") for name in figures)
    assert '```{raw} html\n<div class="antinode-card">' in page
