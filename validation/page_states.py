"""Every state of the page at four widths, light and dark: python validation/page_states.py FOLDER.

Chromium goes through the states of tests/app_states.py. In each it is asked what axe-core finds
wrong, whether the page is wider than the window, and which words are cut without an ellipsis or lie
on others. With a folder the pictures are kept there, to be looked at. Writes page_states.md.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from playwright.sync_api import sync_playwright  # noqa: E402

from app_browser import CHROMIUM, FLAGS, Tab, axe, serving  # noqa: E402
from app_states import FAULTS, STATES  # noqa: E402

WIDTHS = (1280, 960, 760, 390)


def look(tab, folder, name):
    """Yield what is wrong with a state, at every width, light and dark."""
    for scheme in ("light", "dark"):
        for width in WIDTHS:
            tab.view(width, scheme)
            where = f"{name}, {width} px, {scheme}"
            for rule, html in axe(tab):
                yield f"{where}: {rule}: {html[:90]}"
            for fault in tab.page.evaluate(FAULTS):
                yield f"{where}: {fault}"
            if folder:
                file = f"{name.replace(' ', '_')}_{width}_{scheme}.png"
                tab.page.screenshot(path=folder / file)
    yield from (f"{name}: console: {error}" for error in tab.errors)


def main():
    """Go through all states and write the record."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    chosen = sys.argv[2].split(",") if len(sys.argv) > 2 else list(STATES)
    found = []
    with serving() as (address, _), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        context = browser.new_context(viewport={"width": 1280, "height": 800})
        for name in chosen:
            query, steps = STATES[name]
            tab = Tab(context, address + query)
            steps(tab)
            faults = list(look(tab, folder, name))
            print(name, *faults, sep="\n  ", flush=True)
            found += faults
            tab.page.close()
        browser.close()
    if len(chosen) == len(STATES):
        record(found)


def record(found):
    """Write what was looked at, and what was found."""
    path = ROOT / "validation" / "page_states.md"
    head, _, _ = path.read_text(encoding="utf-8").partition("<!-- found -->")
    widths = ", ".join(map(str, WIDTHS))
    count = len(STATES) * len(WIDTHS) * 2
    lines = [f"{len(STATES)} states at {widths} pixels, light and dark: {count} views.", ""]
    lines += [f"- {fault}" for fault in found] or ["Nothing was found."]
    lines += ["", "States: " + ", ".join(STATES) + "."]
    path.write_text(head + "<!-- found -->\n\n" + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
