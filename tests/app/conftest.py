"""A server for all tests of a process, a browser, and a fresh page."""

import pytest

from app_browser import CHROMIUM, FLAGS, Tab, serving


@pytest.fixture(scope="session")
def address():
    """Address of a page with the starter vehicle."""
    with serving() as (url, _):
        yield url


@pytest.fixture(scope="session")
def chromium():
    """Chromium without a window."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    if CHROMIUM is None:
        pytest.skip("chromium is not installed (apt-get install chromium)")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        yield browser
        browser.close()


@pytest.fixture
def tab(chromium, address):
    """A fresh page."""
    opened = Tab(chromium, address)
    yield opened
    opened.page.close()
