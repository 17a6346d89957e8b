"""Sensitivities as a table."""

from __future__ import annotations

from collections.abc import Sequence

from antinode.study.sensitivity.influence import Influence

from .blocks import Block, Section, paragraph, table
from .numbers import signed

_HOW = (
    "Change of each bending frequency, in percent, when one input grows by what the second column "
    "says and all others stay. To first order: small changes add up."
)
_KINK = (
    "* The slope differs on the two sides, as where a fin or the tail begins to be wetted; shown "
    "is the mean."
)


def influence_section(found: Sequence[Influence]) -> Section:
    """Return the section on sensitivities."""
    modes = max((len(each.percent) for each in found), default=0)
    head = ("input", "grows by", *(f"bending {k}" for k in range(1, modes + 1)))
    rows = [_row(each) for each in found]
    blocks: list[Block] = [
        paragraph(_HOW),
        table("Change of frequency [%].", head, rows, left=(0, 1)),
    ]
    if any(each.kink for each in found):
        blocks.append(paragraph(_KINK))
    return Section("Sensitivities", tuple(blocks))


def _row(each: Influence) -> list[str]:
    name = each.name + (" *" if each.kink else "")
    return [name, each.change, *(signed(float(value)) for value in each.percent)]
