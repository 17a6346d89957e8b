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
    for count, (thrust, newtons) in enumerate((("90", "90000 N"), ("100", "100000 N")), 3):
        tab.page.get_by_role("button", name="Keep").click()
        tab.page.wait_for_function(f"window.antinode.data.compare.columns.length === {count}")
        tab.set_field("thrust [kN]", thrust)
        tab.page.locator("[data-name=compare] td", has_text=newtons).last.wait_for()
    tab.settle()


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
        tab.changed(before)


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
        table = ".an-peaks:not(.an-quick)" if panel == "response" else ""
        tab.page.locator(f"[data-name={panel}] {table} td").first.wait_for()

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


FAULTS = """() => {
    const found = [];
    if (document.documentElement.scrollWidth > window.innerWidth)
        found.push(`wider than the window: ${document.documentElement.scrollWidth}`);
    const shown = (e) => {
        const box = e.getBoundingClientRect();
        return box.width > 1 && box.height > 1 && getComputedStyle(e).visibility !== 'hidden';
    };
    const own = (e) => [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    for (const e of document.querySelectorAll('.an-app *, .an-dialog *, .q-menu *')) {
        if (!shown(e) || !own(e) || e.closest('svg, .an-sr, .ag-root-wrapper')) continue;
        const style = getComputedStyle(e);
        const cut = style.overflowX === 'hidden' && e.scrollWidth > e.clientWidth + 1;
        if (cut && style.textOverflow !== 'ellipsis')
            found.push(`cut: ${e.textContent.trim().slice(0, 40)}`);
    }
    for (const input of document.querySelectorAll('.an-app input'))
        if (shown(input) && input.value && input.scrollWidth > input.clientWidth + 2)
            found.push(`cut: ${input.getAttribute('aria-label')}: ${input.value}`);
    for (const root of document.querySelectorAll('.an-svg')) {
        const around = root.getBoundingClientRect();
        const words = [...root.querySelectorAll('text')];
        const boxes = words.map((e) => [e.textContent, e.getBoundingClientRect()]);
        boxes.forEach(([text, a], k) => {
            const beside = a.left < around.left - 2 || a.right > around.right + 2;
            if (beside) found.push(`outside: ${text}`);
            for (const [other, b] of boxes.slice(k + 1)) {
                const across = a.left < b.right - 2 && b.left < a.right - 2;
                if (across && a.top < b.bottom - 4 && b.top < a.bottom - 4)
                    found.push(`on one another: ${text}, ${other}`);
            }
        });
    }
    return found;
}"""
"""A script that tells which words are cut, or lie on others."""
