"""A server for the tests of a file, a browser that ends with them, and a fresh page."""

import pytest

from app_browser import CHROMIUM, FLAGS, Tab, serving


@pytest.fixture(scope="module")
def address():
    """Address of a page with the starter vehicle."""
    with serving() as (url, _):
        yield url


@pytest.fixture(scope="module")
def chromium():
    """Chromium without a window."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if CHROMIUM is None:
        pytest.skip("chromium is not installed (apt-get install chromium)")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        yield browser
        browser.close()


@pytest.fixture(autouse=True)
def no_page_stays_open(request):
    """Close what a test leaves open: a page that is looked at by nobody draws on."""
    used = "chromium" in request.fixturenames
    browser = request.getfixturevalue("chromium") if used else None
    yield
    for context in browser.contexts if browser else ():
        context.close()


@pytest.fixture
def tab(chromium, address):
    """A fresh page."""
    return Tab(chromium, address)
