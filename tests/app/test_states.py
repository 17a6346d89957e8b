"""Every state of the page in two views: what axe-core says, words that are cut, pictures."""

from contextlib import contextmanager

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")
pytest.importorskip("PIL", reason="pillow is not installed")

from app_browser import Tab, axe
from app_pictures import FOLDER, PICTURED, TOLERANCE, VIEWS, difference, ink, reference
from app_states import FAULTS, STATES


@pytest.mark.parametrize("name", STATES)
def test_a_state_is_accessible_uncut_and_as_it_was_looked_at(context, address, name):
    pytest.importorskip("axe_playwright_python", reason="axe is not installed")
    query, steps = STATES[name]
    tab = Tab(context, address + query)
    steps(tab)
    for width, scheme in VIEWS:
        tab.view(width, scheme)
        assert axe(tab) == [], (width, scheme)
        assert tab.page.evaluate(FAULTS) == [], (width, scheme)
        if name in PICTURED:
            kept = reference(name, width, scheme)
            assert becomes(tab, kept, lambda far: far < TOLERANCE), (width, scheme)
    assert tab.errors == []


BROKEN = {
    "no vehicle": ".an-at-vehicle { visibility: hidden }",
    "no curve": ".an-at-curve .an-picture { visibility: hidden }",
    "no body": ".an-at-body .an-picture { visibility: hidden }",
    "a panel on another": ".an-at-modes { transform: translateX(-90px) }",
    "nothing at the side": ".an-side { opacity: 0 }",
    "one column": ".an-main { grid-template-columns: 2fr 1fr 1fr !important }",
}


def test_pictures_forgive_fonts_and_see_a_missing_or_overlapping_panel(context, address):
    tab = Tab(context, address)
    tab.view(1280, "light")
    kept = reference("starter", 1280, "light")
    with style(tab, "body, body *:not(.q-icon) { font-family: 'DejaVu Sans', serif !important }"):
        tab.page.wait_for_timeout(300)
        assert 0 < difference(kept, ink(tab.picture())) < TOLERANCE
    for what, rule in BROKEN.items():
        with style(tab, rule):
            assert becomes(tab, kept, lambda far: far > TOLERANCE), what
    assert becomes(tab, kept, lambda far: far < TOLERANCE)


def becomes(tab, kept, wanted, tries=20):
    """Tell whether the difference of the page's picture is as wanted, once it is drawn."""
    for _ in range(tries):
        if wanted(difference(kept, ink(tab.picture()))):
            return True
        tab.page.wait_for_timeout(200)
    return False


@contextmanager
def style(tab, rule):
    """Add a rule to the page for a while."""
    added = tab.page.add_style_tag(content=rule)
    yield
    added.evaluate("e => e.remove()")


def test_references_are_small():
    assert sum(path.stat().st_size for path in FOLDER.iterdir()) < 60_000
    assert len(list(FOLDER.iterdir())) == len(PICTURED) * len(VIEWS)
    assert np.mean(reference("starter", 1280, "light")) > 1
