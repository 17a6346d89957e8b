"""The documents as a site: it builds without a warning, loads nothing, and its links lead on."""

import importlib.util
import re
import warnings
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

ROOT = Path(__file__).resolve().parents[2]


class Page(HTMLParser):
    """What a page loads, where it leads, and its anchors."""

    def __init__(self, text):
        super().__init__()
        self.loaded, self.links, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.anchors.add(values.get("id"))
        target = values.get("src") if tag != "a" else None
        if tag == "link" and values.get("rel") not in ("next", "prev", "index", "search"):
            target = values.get("href")
        if target:
            self.loaded.append(target)
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built; every warning of Sphinx is an error."""
    spec = importlib.util.spec_from_file_location("build_site", ROOT / "docs" / "build_site.py")
    build_site = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(build_site)
    folder = tmp_path_factory.mktemp("site") / "html"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Python's, of what Sphinx's extensions still use
        assert build_site.build(folder) == 0
    return {
        path: Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))
    }, folder


@pytest.mark.filterwarnings("ignore")
def test_it_loads_nothing_and_its_links_lead_on(site):
    pages, folder = site
    for path, page in pages.items():
        for target in page.loaded:
            assert not re.match(r"(https?:)?//", target), f"{path.name} loads {target}"
        for target in page.links:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            assert file.exists(), f"{path.name}: {target} leads nowhere"
            if parts.fragment and file in pages:
                assert unquote(parts.fragment) in pages[file].anchors, f"{path.name}: {target}"
    for style in folder.rglob("*.css"):
        text = style.read_text(encoding="utf-8")
        assert not re.search(r"(@import|url\()\s*[\"']?(https?:)?//", text), style.name


def test_every_document_and_the_interface_have_a_page(site):
    _, folder = site
    for document in (ROOT / "docs").rglob("*.md"):
        page = folder / document.relative_to(ROOT).with_suffix(".html")
        assert page.is_file(), f"{document.name} has no page"
    api = (folder / "api" / "index.html").read_text(encoding="utf-8")
    for name in ("solve_modes", "load_case", "Beam", "sweep"):
        assert f"an.{name}" in api
    assert (folder / "index.html").is_file()


def test_pages_of_the_interface_name_types_as_people_do(site):
    _, folder = site
    for page in sorted((folder / "api").glob("*.html")):
        text = re.sub("<[^>]*>", "", page.read_text(encoding="utf-8"))
        assert not re.search(r"ndarray\[tuple|typing\.|_NestedSequence", text), page.name
