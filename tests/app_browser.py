"""A server of the page in a process of its own, and a page in a browser, for tests."""

import asyncio
import os
import re
import shutil
import socket
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = (
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)

LONGEST = 120_000.0
"""What a test waits for at most, on a machine that is busy with other work [ms]."""


def run_async(coroutine):
    """Run a coroutine in a thread of its own: playwright keeps a loop in the main one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()


def wait_for(url, most=120.0):
    """Wait until a server answers [s]."""
    parts, end = urlsplit(url), time.monotonic() + most
    while time.monotonic() < end:
        try:
            socket.create_connection((parts.hostname, parts.port), 1.0).close()
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise AssertionError(f"no answer from {url}")


@contextmanager
def serving(*arguments):
    """Run serve.py; yield the address of its page."""
    script = Path(__file__).parent / "app" / "serve.py"
    process = subprocess.Popen(
        [sys.executable, str(script), *arguments],
        stderr=subprocess.PIPE,
        text=True,
        env={k: v for k, v in os.environ.items() if not k.startswith(("PYTEST", "NICEGUI"))},
    )
    try:
        line = process.stderr.readline()
        found = re.search(r"http://\S+", line)
        assert found, line + process.stderr.read()
        wait_for(found[0])
        yield found[0], process
    finally:
        process.kill()
        process.wait(10)
        process.stderr.close()


def axe(tab):
    """Return what axe-core finds wrong with the page as it stands."""
    import axe_playwright_python

    script = Path(axe_playwright_python.__file__).parent / "axe.min.js"
    if not tab.page.evaluate("Boolean(window.axe)"):
        tab.page.evaluate(script.read_text(encoding="utf-8"))
    found = tab.page.evaluate("axe.run(document, {resultTypes: ['violations']})")
    return [(v["id"], v["nodes"][0]["html"][:200]) for v in found["violations"]]


class Tab:
    """A page in the browser with all that it complained of and asked for."""

    def __init__(self, context, url, *, width=1280, height=800):
        self.page = context.new_page()
        self.page.set_viewport_size({"width": width, "height": height})
        self.errors, self.requests = [], []
        self.page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("websocket", lambda socket: self.requests.append(socket.url))
        self.page.set_default_timeout(LONGEST)
        self.open(url)

    def open(self, url):
        """Open a page and wait until its full result is shown."""
        self.page.goto(url)
        self.settle()

    def view(self, width, scheme):
        """Give the window a width, light or dark, and wait until nothing moves any more."""
        self.page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        self.page.set_viewport_size({"width": width, "height": 800})
        self.page.evaluate("window.scrollTo(0, 0)")
        self.page.mouse.move(1, 1)
        self.settle()
        self.page.wait_for_timeout(300)  # charts move by scripts
        self.stand_still()

    def picture(self):
        """Return a picture of the window, on a phone of the whole page."""
        return self.page.screenshot(full_page=self.page.viewport_size["width"] < 760)

    def settle(self):
        """Wait until all that the page has sent is answered and drawn, a full result in the table.

        The server answers the question after all that came before it, events that were on their
        way included; files that are dropped go another way: wait for what they bring.
        """
        begun = "window.antinode?.shown > 0"  # a first server may have its code compiled yet
        self.page.wait_for_function(begun, timeout=5 * LONGEST)
        asked = self.page.evaluate("window.antinode.ask()")
        self.page.wait_for_function("(asked) => window.antinode.answered >= asked", arg=asked)
        self.page.wait_for_selector(".an-table:not(.an-quick) tbody tr")

    def stand_still(self):
        """Wait until nothing moves by the style sheet: menus, thumbs, messages."""
        self.page.wait_for_function(
            "document.getAnimations().every((a) => a.playState !== 'running'"
            " || a.effect.getComputedTiming().endTime === Infinity)"
        )

    def frequency(self, mode=1):
        """Return the text of a mode's frequency."""
        return self.page.locator(".an-table tbody tr").nth(mode - 1).locator(".an-hz").inner_text()

    def wait_for_frequency(self, text, mode=1):
        """Wait until a mode's frequency is the one that is stated, of a full result."""
        script = (
            "([row, text]) => document.querySelectorAll('.an-table:not(.an-quick) tbody .an-hz')"
            "[row]?.innerText === text"
        )
        self.page.wait_for_function(script, arg=[mode - 1, text])
        self.settle()

    def changed(self, before, mode=1):
        """Return the text of a mode's frequency once all is answered: another than before."""
        self.settle()
        now = self.frequency(mode)
        assert now != before
        return now

    def set_field(self, label, text):
        """Type into a field."""
        field = self.page.get_by_label(label).and_(self.page.locator("input"))
        field.fill(text)
        field.press("Enter")

    def drop(self, files):
        """Drop files on the page, each with a name and a text."""
        self.page.evaluate(
            """(files) => {
                const data = new DataTransfer();
                for (const f of files) data.items.add(new File([f.text], f.name));
                for (const type of ['dragenter', 'dragover', 'drop'])
                    window.dispatchEvent(
                        new DragEvent(type, {dataTransfer: data, cancelable: true}));
            }""",
            files,
        )
