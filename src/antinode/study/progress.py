"""Progress on stderr: one changing line on a terminal, or plain lines now and then."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable

_CHANGES = 0.1  # seconds between changes of the line
_LINES = 2.0  # seconds between lines about cases where there is no terminal
_TEXTS = 1.0  # the same of texts


def cases_progress() -> Callable[[int, int], None]:
    """Return what shows how many of all cases are done, their rate and the time left."""
    terminal, start, first = sys.stderr.isatty(), time.monotonic(), [-1]
    last = [-math.inf]

    def show(done: int, cases: int) -> None:
        now = time.monotonic()
        if first[0] < 0:
            first[0] = done
        ended = done == cases
        if not ended and now - last[0] < (_CHANGES if terminal else _LINES):
            return
        last[0] = now
        _write(_cases_text(done, cases, done - first[0], now - start), changing=terminal)

    return show


def text_progress() -> Callable[[str], None]:
    """Return what shows texts about a fit; that it was interrupted stays on the screen."""
    terminal = sys.stderr.isatty()
    last = [-math.inf]

    def show(text: str) -> None:
        final = text.startswith("interrupted")
        if terminal and not final:
            _write(text, changing=True)
        elif final or time.monotonic() - last[0] >= _TEXTS:
            _write(text, changing=False)
            last[0] = time.monotonic()

    return show


def end_progress() -> None:
    """Clear the changing line."""
    if sys.stderr.isatty():
        _write("", changing=True)


def _write(text: str, *, changing: bool) -> None:
    sys.stderr.write(f"\r\x1b[K{text}" if changing else f"{text}\n")
    sys.stderr.flush()


def _cases_text(done: int, cases: int, here: int, seconds: float) -> str:
    text = f"{done} of {cases} cases ({done / cases:.0%})"
    if here <= 0 or seconds <= 0:
        return text
    rate = here / seconds
    return f"{text}, {rate:.3g} a second, {_duration((cases - done) / rate)} left"


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return (
        f"{hours} h {minutes} min"
        if hours
        else f"{minutes} min {rest} s"
        if minutes
        else f"{rest} s"
    )
