"""What the ends do: bending frequencies for every choice of the end forces, side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence

from antinode.arrays import Array
from antinode.beam.families import BENDING
from antinode.modes.result import ModalResult
from antinode.show.end_forces import plot_end_forces
from antinode.vehicle.case import Case
from antinode.vehicle.end_forces import Choice, compare_end_forces

from .blocks import Section, paragraph, table
from .modal_sections import drawn
from .numbers import number, percent, small

TITLE = "What the end forces do"
_HOW = (
    "A force that follows turns with the end of the body, as the thrust of a fixed nozzle and the "
    "pressure on a disk do; one of fixed direction does not. Each row is solved, not estimated. A "
    "nozzle that a control turns is neither."
)


def end_forces_section(case: Case, result: ModalResult) -> tuple[Section, ...]:
    """Return the chapter, or none where the choices cannot be set side by side."""
    choices = compare_end_forces(case, result)
    if not choices:
        return ()
    number_of = range(1, len(choices[0].frequencies_hz) + 1)
    head = ("bending f [Hz], if", *map(str, number_of), "largest ± error", "mode 1 against file")
    rows = [_row(choice, choices[0].frequencies_hz) for choice in choices]
    first = next(mode for mode in result.family(BENDING) if mode.number == 1)
    figure = drawn(
        "end_forces",
        plot_end_forces(result.x, first.shape, choices),
        "Bending 1 with thrust and the cavitator's drag, for each choice; the shape is that of "
        "the file's own, its size and turns not to scale.",
    )
    own = table("Frequencies under each choice of the end forces.", head, rows)
    return (Section(TITLE, (paragraph(_HOW), own, figure)),)


def _row(choice: Choice, own: Array) -> Sequence[str]:
    mark = " (this file)" if choice.stated else "" if choice.proven else " (not proven)"
    values = [_frequency(f, choice.proven) for f in choice.frequencies_hz]
    errors = [float(e) for e in choice.error_hz if math.isfinite(e)]
    change = float(choice.frequencies_hz[0] / own[0] - 1)
    told = "–" if choice.stated or not math.isfinite(change) else percent(change)
    return choice.name + mark, *values, small(max(errors)) if errors else "–", told


def _frequency(hz: float, proven: bool) -> str:
    return number(hz, 7) if math.isfinite(hz) else "diverges" if proven else "not found"
