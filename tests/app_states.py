"""States of the page by name: how a browser gets into each, and what then stands in it."""

import json
from urllib.parse import quote

from antinode.app.source import read_example


def of_example(name, **view):
    """Return the query of an example's page."""
    return "?" + "&".join([f"case={read_example(name).packed()}", *_viewed(view)])


def of_starter(**view):
    """Return the query of the starter's page."""
    return "?" + "&".join(_viewed(view))


def _viewed(view):
    return [f"{key}={quote(json.dumps(value))}" for key, value in view.items()]


def _nothing(tab):
    """The page as it opens."""


def _stations(tab):
    tab.page.get_by_role("button", name="Stations").click()
    tab.page.locator(".ag-cell").first.wait_for()


def _wrong_cell(tab):
    _stations(tab)
    cell = tab.page.locator(".ag-row[row-index='1'] [col-id='x']")
    cell.dblclick()
    cell.locator("input").fill("9 kg")
    cell.locator("input").press("Enter")
    tab.page.locator(".an-cellwrong").first.wait_for()


def _snapshots(tab):
    tab.page.locator("[data-name=compare] p").wait_for()
    for speed in ("90", "100"):
        before = tab.frequency(1)
        tab.page.get_by_role("button", name="Keep").click()
        tab.set_field("thrust [kN]", speed)
        tab.wait_for_change(before)
        tab.settle()
    tab.page.locator("[data-name=compare] td").nth(8).wait_for()


def _chosen(tab):
    tab.page.get_by_role("button", name="Show bending 2").click()
    tab.page.wait_for_function("Boolean(window.antinode.data.mode)")
    tab.settle()


def _large(panel):
    def enlarge(tab):
        tab.page.get_by_label(f"Enlarge: {panel}", exact=True).click()
        tab.page.locator(".an-large").wait_for()

    return enlarge


def _wrong_field(tab):
    tab.set_field("speed [m/s]", "50 kg")
    tab.page.locator(".an-message:visible").wait_for()


def _refused(tab):
    files = [{"name": "bad.toml", "text": "[vehicle]\nname = 3\n"}]
    tab.drop(files)
    tab.page.locator(".an-toast").wait_for()


def _attached(tab):
    for what in ("Spring", "Mass", "Dashpot"):
        before = tab.frequency(1)
        tab.page.get_by_role("button", name="Attach").click()
        tab.page.get_by_role("menuitem", name=what, exact=True).click()
        tab.wait_for_change(before)
        tab.settle()


def _attaching(tab):
    tab.page.get_by_role("button", name="Attach").click()
    tab.page.locator(".q-menu").wait_for()


def _asked(tab):
    tab.page.get_by_label("Force, output, damping").click()
    tab.page.locator(".an-asked").wait_for()


def _menu(name):
    def opened(tab):
        tab.page.get_by_role("button", name=name).click()
        tab.page.locator(".q-menu").wait_for()

    return opened


def _filled(panel):
    def wait(tab):
        tab.page.locator(f"[data-name={panel}] td").first.wait_for()

    return wait


def _pinned(tab):
    tab.page.get_by_label("Pin the frequencies").click()
    tab.page.wait_for_selector(".an-pinned")
    tab.page.get_by_label("from", exact=True).fill("18")
    tab.page.get_by_label("to", exact=True).fill("25")
    tab.page.get_by_label("to", exact=True).press("Enter")
    tab.page.get_by_text("mode 3 in the equipment band").wait_for()


STATES = {
    "starter": (of_starter(), _nothing),
    "pinned": (of_starter(), _pinned),
    "beam": (of_example("beam"), _nothing),
    "tower": (of_example("tower"), _nothing),
    "drawing": (of_example("drawing"), _nothing),
    "attached": (of_example("beam"), _attached),
    "attaching": (of_example("beam"), _attaching),
    "stations": (of_starter(), _stations),
    "wrong cell": (of_starter(), _wrong_cell),
    "wrong field": (of_starter(), _wrong_field),
    "refused": (of_starter(), _refused),
    "compare": (of_starter(panel="compare"), _snapshots),
    "effects": (of_starter(panel="effects"), _filled("effects")),
    "ends": (of_starter(panel="ends"), _filled("ends")),
    "chosen": (of_starter(), _chosen),
    "response": (of_starter(panel="response"), _filled("response")),
    "asked": (of_example("tower", panel="response"), _asked),
    "stability": (of_example("drawing", panel="stability"), _filled("stability")),
    "large chosen": (of_starter(panel="mode"), _large("chosen panel")),
    "large modes": (of_starter(), _large("Mode shapes")),
    "large frequencies": (of_starter(), _large("Frequencies")),
    "large response": (of_example("tower", panel="response"), _large("chosen panel")),
    "large effects": (of_starter(panel="effects"), _large("chosen panel")),
    "opening": (of_starter(), _menu("Open")),
    "saving": (of_starter(), _menu("Save")),
    "keys": (of_starter(), _menu("Keys")),
}
"""Query and steps of each state."""
