"""Loads of a vehicle: forces, balance, its checks, N, Q and M, and the ranges of validity."""

from __future__ import annotations

import math
from collections.abc import Iterator
from types import ModuleType

from antinode.show.loads_table import EXPLANATION, HEADINGS, internal_rows
from antinode.vehicle.case import Case
from antinode.vehicle.hydrodynamics import cavitator, cavity, fins, planing
from antinode.vehicle.hydrodynamics.validity import Range, Validity
from antinode.vehicle.statics import FRAME, static_shape

from .blocks import Block, Section, paragraph, table
from .numbers import number, small

_CLOSED = 1e-9
_STATIONS = 11


def load_sections(case: Case, figure: Block) -> list[Section]:
    """Return the sections on loads."""
    return [
        Section("Loads", (*_forces(case), *_checks(case), _internal(case), figure)),
        Section("Ranges of the correlations", tuple(_validity(case))),
    ]


def _forces(case: Case) -> Iterator[Block]:
    loads = case.loads
    hole = loads.cavity
    yield paragraph(
        f"Cavitation number σ = {number(loads.sigma)}"
        + ("" if loads.depth is None else f", depth {number(loads.depth)} m")
        + ("" if loads.cavity_pressure is None else f", cavity {number(loads.cavity_pressure)} Pa")
        + f". The cavity is {number(hole.L_c, 4)} m long and {number(hole.D_c, 4)} m wide."
    )
    rows = [(f.name, number(f.x), number(f.F_X, 6), number(f.F_Y, 6)) for f in loads.forces]
    rows.append(("thrust", number(case.vehicle.length), number(-loads.thrust, 6), "–"))
    rows.append(("weight", number(loads.x_M), "–", number(-loads.weight, 6)))
    yield table("Forces on the body.", ("force", "x [m]", "drag, aft [N]", "lift, up [N]"), rows)
    yield table(
        "The body as a whole.",
        ("quantity", "value", "unit"),
        [
            ("mass", number(loads.mass, 6), "kg"),
            ("centre of mass, from the nose", number(loads.x_M), "m"),
            ("moment of inertia about it", number(loads.inertia, 6), "kg m^2"),
            ("acceleration, forward", number(loads.a_X), "m/s^2"),
            ("acceleration, up", number(loads.a_Y), "m/s^2"),
            ("angular acceleration, nose-up", number(loads.beta), "rad/s^2"),
        ],
        left=(0, 2),
    )
    added = [
        (p.name, p.formula, f"{number(p.start)} … {number(p.end)}", number(p.mass, 4))
        for p in case.added_masses
    ]
    if added:
        yield table(
            "Added mass: water that moves sideways with the body, spread evenly along each part. "
            "It has no weight, and does not move along.",
            ("part", "formula", "x [m]", "mass [kg]"),
            added,
            left=(0, 1),
        )


def _checks(case: Case) -> Iterator[Block]:
    checks = case.loads.checks
    axial = max(abs(checks.axial_nose), abs(checks.axial_tail))
    lateral = max(map(abs, checks[2:]))
    rows = [
        ("axial: N is the cavitator's drag at the nose, the thrust at the tail", axial),
        ("lateral: Q and M vanish at both free ends", lateral),
    ]
    yield table(
        "The two checks of the balance: what is left at the ends, over the largest force (times "
        "the length).",
        ("check", "left over", "verdict"),
        [
            (text, small(left), "closes" if left < _CLOSED else "DOES NOT CLOSE")
            for text, left in rows
        ],
        left=(2,),
        wide=(0,),
        marked=[k for k, (_, left) in enumerate(rows) if left >= _CLOSED],
    )


def _internal(case: Case) -> Block:
    shape = static_shape(case)
    rows = [[_fixed(v) for v in row] for row in internal_rows(case, shape, _STATIONS).tolist()]
    return table(
        "Internal forces (at a step the value ahead of it) and static displacements. "
        f"{EXPLANATION}{FRAME}",
        HEADINGS,
        rows,
        left=(),
    )


def _fixed(value: float) -> str:
    return f"{round(value, 4) + 0.0:.4f}".replace("-", "−")


def _validity(case: Case) -> Iterator[Block]:
    rows = case.loads.validity
    outside = [k for k, row in enumerate(rows) if not row.inside]
    verdict = "This condition lies inside all of them."
    if outside:
        verdict = (
            f"This condition lies outside {len(outside)} of {len(rows)}; they are marked, and the "
            "warnings say what to do."
        )
    yield paragraph(f"The forces rest on correlations, each with its range. {verdict}")
    known = {(r.correlation, r.quantity): r for r in _ranges()}
    body = [
        (
            row.correlation,
            row.quantity,
            number(row.value, 4),
            _range(row),
            "inside" if row.inside else "OUTSIDE",
            _source(known.get((row.correlation, row.quantity))),
        )
        for row in rows
    ]
    head = ("correlation", "quantity", "value", "range", "", "where the range comes from")
    yield table("Ranges of validity.", head, body, left=(1, 3, 4), wide=(0, 5, 5), marked=outside)


def _range(row: Validity) -> str:
    if math.isinf(row.high):
        return f"from {number(row.low, 4)}"
    return f"{number(row.low, 4)} … {number(row.high, 4)}"


def _source(known: Range | None) -> str:
    return known.source if known else ""


def _ranges() -> Iterator[Range]:
    modules: tuple[ModuleType, ...] = (cavitator, cavity, fins, planing)
    for module in modules:
        yield from (value for value in vars(module).values() if isinstance(value, Range))
