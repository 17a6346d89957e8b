"""What the water does as the body vibrates: devices, contact on and off, where contacts end."""

from __future__ import annotations

from collections.abc import Iterator

from antinode.modes.result import ModalResult
from antinode.response.units import STANDARD_GRAVITY
from antinode.show.water import contact_ends, side_by_side, water_notes
from antinode.vehicle.case import Case

from .blocks import Block, Section, paragraph, table
from .numbers import number

TITLE = "What the water does as the body vibrates"
_HOW = (
    "The forces of fins, planing tail and cavitator, linearised exactly about the computed state: "
    "springs, dashpots, and what turns with the body. The cavity stays where the steady state has "
    "it; what the nose does to it arrives further aft only later."
)
_ENDS = (
    "A planing tail that touches on one side leaves the wall of the cavity at some amplitude. Up "
    "to it the frequencies with the contact hold; a body that vibrates much more is off the wall "
    "for half of the time, and its frequencies lie between those with the contact and without."
)


def water_section(case: Case, result: ModalResult) -> tuple[Section, ...]:
    """Return the chapter, or none where the water's stiffness is left out."""
    return (Section(TITLE, tuple(_blocks(case, result))),) if case.tangents else ()


def _blocks(case: Case, result: ModalResult) -> Iterator[Block]:
    yield paragraph(_HOW)
    head = "device", "x [m]", "spring [kN/m]", "dashpot [N s/m]", "turns with it [kN/rad]"
    rows = [
        (t.name, *(number(v, 4) for v in (t.x, t.spring / 1e3, t.dashpot, t.following / 1e3)))
        for t in case.tangents
    ]
    yield table("The water's stiffness and damping, device by device.", head, rows)
    beside = side_by_side(case, result)
    shown = min(map(len, beside.values()))
    yield table(
        "Bending frequencies of modes that oscillate [Hz], by what acts, each solved.",
        ("what acts", *map(str, range(1, shown + 1))),
        [(name, *(number(m.frequency_hz, 6) for m in own[:shown])) for name, own in beside.items()],
    )
    if ends := contact_ends(case, result)[:shown]:
        yield paragraph(_ENDS)
        yield table(
            "Where the contact ends, mode by mode.",
            (
                "mode",
                "f [Hz]",
                "at the tail [mm]",
                "there [g]",
                "largest along the body [mm]",
            ),
            [
                (
                    end.name,
                    number(end.frequency_hz, 6),
                    number(end.amplitude * 1e3, 3),
                    number(end.acceleration / STANDARD_GRAVITY, 3),
                    number(end.largest * 1e3, 3),
                )
                for end in ends
            ],
        )
    for line in water_notes(case, result):
        yield paragraph(line)
