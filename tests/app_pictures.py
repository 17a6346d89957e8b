"""Pictures of the page as small maps of ink, which fonts hardly move and a missing panel does.

A screenshot becomes a grid of cells of 16 pixels; each holds how far its grey differs from the
page's ground, on average. Letters of another font put the same ink into the same cells, nearly; a
panel that is missing, empty or on another one does not. Compared are windows of 4 x 4 cells.
`python tests/app_pictures.py` draws the references in tests/app/pictures anew.
"""

import io
import sys
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).parent / "app" / "pictures"
VIEWS = ((1280, "light"), (390, "dark"))
PICTURED = ("starter", "pinned", "beam", "stations", "wrong field", "compare", "response", "chosen")
TOLERANCE = 1.0
"""Largest difference of a window's ink, over that of the page's windows on average."""
_CELL, _WINDOW = 16, 4


def ink(picture):
    """Return the map of a picture given as PNG, shape (rows, columns), 0 to 255."""
    grey = np.asarray(Image.open(io.BytesIO(picture)).convert("L"), dtype=float)
    ground = np.median(grey)
    rows, columns = (size // _CELL for size in grey.shape)
    cut = np.abs(grey - ground)[: rows * _CELL, : columns * _CELL]
    cells = cut.reshape(rows, _CELL, columns, _CELL).mean(axis=(1, 3))
    return np.minimum(255, np.round(4 * cells)).astype(np.uint8)


def difference(one, other):
    """Return the largest difference of two maps in any window, over the ink of the first."""
    if one.shape != other.shape:
        return np.inf
    a, b = (_windows(each.astype(float)) for each in (one, other))
    return float(np.max(np.abs(a - b)) / np.mean(a))


def _windows(cells):
    view = np.lib.stride_tricks.sliding_window_view(cells, (_WINDOW, _WINDOW))
    return view.mean(axis=(-2, -1))


def path_of(name, width, scheme):
    """Return where the reference of a view is."""
    return FOLDER / f"{name.replace(' ', '_')}_{width}_{scheme}.png"


def reference(name, width, scheme):
    """Return the map that is kept of a view."""
    return np.asarray(Image.open(path_of(name, width, scheme)))


def main():
    """Draw all references anew."""
    from playwright.sync_api import sync_playwright

    from app_browser import CHROMIUM, FLAGS, Tab, serving
    from app_states import STATES

    FOLDER.mkdir(exist_ok=True)
    with serving() as (address, _), sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        context = browser.new_context()
        for name in sys.argv[1:] or PICTURED:
            query, steps = STATES[name]
            tab = Tab(context, address + query)
            steps(tab)
            for width, scheme in VIEWS:
                tab.view(width, scheme)
                map_ = Image.fromarray(ink(tab.picture()))
                map_.save(path_of(name, width, scheme), optimize=True)
            tab.page.close()
        browser.close()


if __name__ == "__main__":
    main()
