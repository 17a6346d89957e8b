"""The images of the documents: each is made by docs/make_images.py, and shown somewhere."""

import importlib.util
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
SLOW = {"literal_methods", "gallery_paper"}  # whose parts other tests cover


def load():
    spec = importlib.util.spec_from_file_location("make_images", ROOT / "docs" / "make_images.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


MAKERS = {make.__name__: make for make in load().MAKERS}


@pytest.mark.parametrize("name", sorted(set(MAKERS) - SLOW))
def test_an_image_is_made(name, tmp_path, monkeypatch):
    module = load()
    monkeypatch.setattr(module, "IMAGES", tmp_path)
    with module.styled():
        getattr(module, name)()
    made = sorted(path.name for path in tmp_path.iterdir())
    assert made
    for image in made:
        assert (IMAGES / image).is_file(), f"run python docs/make_images.py {name}"


def test_every_image_is_shown_and_described():
    shown = set()
    for page in (ROOT / "docs").rglob("*.md"):
        for words, target in re.findall(r"!\[(.*?)\]\((.*?)\)", page.read_text(encoding="utf-8")):
            assert words, f"{page.name}: {target} has no description"
            shown.add((page.parent / target).resolve().name)
    assert {path.name for path in IMAGES.iterdir()} <= shown
