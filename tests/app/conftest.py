"""A server for the tests of a file, a browser that ends with them, and a fresh page."""

import pytest

from app_browser import CHROMIUM, FLAGS, LONGEST, Tab, serving


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
        browser = playwright.chromium.launch(
            executable_path=CHROMIUM, args=list(FLAGS), timeout=LONGEST
        )
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def context(chromium):
    """One profile for all pages of a file: scripts are fetched and read once."""
    context = chromium.new_context(permissions=["clipboard-read", "clipboard-write"])
    context.set_default_timeout(LONGEST)
    yield context
    context.close()


@pytest.fixture(autouse=True)
def no_page_stays_open(request):
    """Close what a test leaves open: a page that is looked at by nobody draws on."""
    used = "context" in request.fixturenames
    context = request.getfixturevalue("context") if used else None
    yield
    for page in context.pages if context else ():
        page.close()


@pytest.fixture
def tab(context, address):
    """A fresh page."""
    return Tab(context, address)
