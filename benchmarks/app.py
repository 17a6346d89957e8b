"""How fast the page answers in a real browser: python benchmarks/app.py (writes benchmarks/app.md).

A slider is moved by one step of the keyboard, each time to a value where it has not been: the
server keeps what it has computed. Measured in the browser, from the key to the moment at which a
picture has drawn its new data: the last of all pictures, the curve over thrust with its first
points. Needs chromium and playwright; runs on loopback for some two minutes.
"""

import json
import os
import statistics
import sys
import time
from pathlib import Path
from urllib.parse import urlencode

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from playwright.sync_api import sync_playwright  # noqa: E402

from app_browser import CHROMIUM, FLAGS, Tab, serving  # noqa: E402

SLIDERS = ("speed", "cavitation number", "cavitator angle", "thrust", "fin position", "burn")
MOVES = 12
SESSIONS = 20

MEASURE = """async ([label, key]) => {
    const slider = document.querySelector(`.an-slider[aria-label^="${label}"]`);
    const focus = slider.querySelector('.q-slider__track-container');
    focus.focus();
    const seen = {}, original = {};
    for (const [name, view] of Object.entries(window.antinode.views)) {
        original[name] = view.show;
        view.show = (data) => {
            original[name].call(view, data);
            if (name === 'curve') seen.cursor ??= performance.now();
            if (name !== 'curve' || data.curve) seen[name] ??= performance.now();
        };
    }
    const code = key === 'ArrowRight' ? 39 : 37;
    const start = performance.now();
    focus.dispatchEvent(new KeyboardEvent('keydown', {key, keyCode: code, bubbles: true}));
    await new Promise((done) => setTimeout(done, 900));
    for (const [name, view] of Object.entries(window.antinode.views)) view.show = original[name];
    focus.dispatchEvent(new KeyboardEvent('keyup', {key, keyCode: code, bubbles: true}));
    await new Promise((done) => setTimeout(done, 200)); // letting go is a throttled event
    return Object.fromEntries(Object.entries(seen).map(([name, t]) => [name, t - start]));
}"""


FARTHER = """(label) => {
    const slider = document.querySelector(`.an-slider[aria-label^="${label}"]`);
    const value = (name) => Number(slider.getAttribute(`aria-value${name}`));
    const [low, now, high] = ['min', 'now', 'max'].map(value);
    return now - low < high - now ? 'ArrowRight' : 'ArrowLeft';
}"""


def moves(tab, label, times):
    """Move a slider towards its farther end; return the times of each move by picture [ms]."""
    key = tab.page.evaluate(FARTHER, label)
    return [tab.page.evaluate(MEASURE, [label, key]) for _ in range(times)]


def another(address, k, **view):
    """Return a link to a case of its own, which the server has not solved yet."""
    values = {"condition.cavitator_angle": 0.001 * k}
    query = {"set": json.dumps(values)} | {key: json.dumps(value) for key, value in view.items()}
    return f"{address}?{urlencode(query)}"


def medians(rows):
    """Return the median of the first picture, of all but the curve, and of all pictures [ms]."""
    main = [{k: v for k, v in row.items() if k not in ("curve", "cursor")} for row in rows if row]
    first, last, every = (
        [min(row.values()) for row in main],
        [max(row.values()) for row in main],
        [max(row.values()) for row in rows if row],
    )
    return [statistics.median(values) for values in (first, last, every)]


def measure(browser, address):
    """Yield the lines of the record."""
    yield "| slider | first picture | all but the curve | all, curve with 5 points |"
    yield "|---|---|---|---|"
    tab = Tab(browser, address)
    everything = []
    for label in SLIDERS:
        moves(tab, label, 2)
        rows = moves(tab, label, MOVES)
        everything += rows
        yield f"| {label} | " + " | ".join(f"{v:.0f}" for v in medians(rows)) + " |"
    yield "| **all sliders** | " + " | ".join(f"**{v:.0f}**" for v in medians(everything)) + " |"
    yield ""
    tab.open(another(address, 1, panel="response"))
    moves(tab, "thrust", 2)
    times = [row["response"] for row in moves(tab, "thrust", MOVES) if "response" in row]
    yield "| the response panel chosen | curve and peaks |"
    yield "|---|---|"
    yield f"| thrust | {statistics.median(times):.0f} |"
    yield ""
    others = [Tab(browser, another(address, 2 + k)) for k in range(SESSIONS - 1)]
    rows = moves(tab, "thrust", MOVES)
    idle = medians(rows)
    for other in others:
        other.page.evaluate(
            """() => { setInterval(() => {
                const s = document.querySelector('.an-slider[aria-label^="speed"]')
                    .querySelector('.q-slider__track-container');
                s.dispatchEvent(new KeyboardEvent('keydown', {keyCode: 39, bubbles: true}));
            }, 5000 + 1000 * Math.random()); }"""
        )
    rows = moves(tab, "thrust", MOVES)
    busy = medians(rows)
    yield "| 20 sessions, the response chosen | first picture | all but the curve | all |"
    yield "|---|---|---|---|"
    for name, values in (("the others rest", idle), ("each moves a slider every 5 s", busy)):
        yield f"| {name} | " + " | ".join(f"{v:.0f}" for v in values) + " |"


def main():
    """Measure and write the record."""
    with sync_playwright() as playwright, serving() as (address, _):
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        time.sleep(5)  # the kernel comes out of its cache
        lines = []
        for line in measure(browser, address):
            print(line, flush=True)
            lines.append(line)
        table = "\n".join(lines)
        browser.close()
    load = os.getloadavg()[0]
    text = (ROOT / "benchmarks" / "app.md").read_text(encoding="utf-8")
    head, _, _ = text.partition("<!-- measured -->")
    text = f"{head}<!-- measured -->\n\n{table}\n\n"
    text += f"Load average while measuring: {load:.1f} on {os.cpu_count()} cores.\n"
    (ROOT / "benchmarks" / "app.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
