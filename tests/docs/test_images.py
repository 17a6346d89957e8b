"""The images of the documents: each is made by docs/make_images.py, and shown somewhere."""

import importlib.util
import re
from pathlib import Path

import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
SLOW = {"literal_methods", "gallery_paper"}  # whose parts other tests cover


def load(path=ROOT / "docs" / "make_images.py"):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


DOCUMENTS = load(Path(__file__).with_name("test_docs.py"))
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
        kept = IMAGES / image
        assert kept.is_file(), f"run python docs/make_images.py {name}"
        if words := shown(tmp_path / image):
            try:
                DOCUMENTS.assert_shown(shown(kept), words, image)
            except AssertionError as error:
                raise AssertionError(f"stale: run python docs/make_images.py {name}") from error


def shown(path):
    """The words and numbers that a figure shows, as it was saved with them."""
    with Image.open(path) as image:
        return image.info.get("Description", "")


def test_a_picture_of_other_numbers_is_seen():
    kept = shown(IMAGES / "ruler_modes.png")
    with pytest.raises(AssertionError):
        DOCUMENTS.assert_shown(kept, kept.replace("bending 1: 3.1", "bending 1: 3.2"), "ruler")


def test_every_image_is_shown_and_described():
    shown = set()
    for page in (ROOT / "docs").rglob("*.md"):
        for words, target in re.findall(r"!\[(.*?)\]\((.*?)\)", page.read_text(encoding="utf-8")):
            assert words, f"{page.name}: {target} has no description"
            shown.add((page.parent / target).resolve().name)
    assert {path.name for path in IMAGES.iterdir()} <= shown
