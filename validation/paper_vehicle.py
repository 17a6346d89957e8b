"""How the paper's vehicle was reconstructed: python -m validation.paper_vehicle [--ship]

Forty elements of 0.15 m start from a smooth hump of mass and a constant bending stiffness with a
tapered nose. `antinode.identify` then finds mass, stiffness, burnt mass, the body's radius and the
fins' thickness from the 23 rows of Tables 1 to 5 that are not held out. Everything else is given:
thrust 50 kN, D_n = 80 mm, length 6 m, fin tips at 0.53 m, and the readings of equations 10 to 22
in the example's [model]. Prints the report as Markdown; --ship writes the example's stations and
the thickness to put into its case.toml.
"""

import argparse
import math
from dataclasses import replace
from pathlib import Path

import numpy as np

import antinode as an
from antinode.paper.comparison import Line, example, size_of
from antinode.paper.tables import BURN_FRACTION, MODES, read_rows
from antinode.study.identify.file import IdentificationProblem
from antinode.vehicle.vehicle import Stations, Vehicle

LENGTH, ELEMENTS = 6.0, 40
THRUST = 50e3
CONTROL_POINTS = 16
FIT = {"relative_sd": 1e-4, "tolerance": 1e-7, "max_evaluations": 900}
SMOOTH = {"prior_sd": 0.3, "smoothness": 2.0}
PARAMETERS = [{"key": "vehicle.fins.0.thickness", "prior": {"sd": "5 mm"}}]
DISTRIBUTIONS = [
    {"column": "radius", "control_points": 1, "prior_sd": 0.1},
    {"column": "mass_per_length", "control_points": CONTROL_POINTS, **SMOOTH},
    {
        "column": "mass_per_length:burnt",
        "relative_to": "mass_per_length",
        "control_points": 6,
        "interpolation": "linear",
        "upper": 1.17,  # times 0.85 at the start: no element gains mass
        "prior_sd": 0.2,
        "smoothness": 2.0,
    },
    {"column": "bending_stiffness", "control_points": CONTROL_POINTS, **SMOOTH},
]
HEAD = """\
# RECONSTRUCTION: the data of the paper's Figures 4 to 6 and 16 are lost. These forty elements of
# 0.15 m were found from the frequencies of its Tables 1 to 5; docs/paper.md says how.
# mass_per_length holds at t = 0 s, mass_per_length:burnt at t = 10 s. The axial stiffness is that
# of a thin tube of the body's radius, EA = 2 EI/radius^2; the nose only has to fit in the cavity.
x [m],mass_per_length [kg/m],mass_per_length:burnt [kg/m],bending_stiffness [kN m^2],\
axial_stiffness [MN],radius [mm]
"""


def body_radius(x, R):
    """A nose that fits inside the cavity, then a cylinder."""
    return np.minimum(R, 0.04 + (R - 0.04) * (x / 1.5) ** 0.75)


def start_stations(elements=ELEMENTS):
    x = np.linspace(0, LENGTH, elements + 1)
    middle = np.append((x[1:] + x[:-1]) / 2, x[-1]) / LENGTH
    m = 300 * (0.45 + np.exp(-(((middle - 0.35) / 0.25) ** 2)))
    EI = 4e5 * np.minimum(1, (middle / 0.12) ** 1.5 + 0.03)
    R = body_radius(x, 0.18)
    return Stations(
        x=x,
        mass_per_length={"initial": m, "burnt": 0.85 * m},
        bending_stiffness=EI,
        axial_stiffness=2 * EI / R**2,
        radius=R,
    )


def with_stations(case, stations):
    vehicle = case.vehicle.model_copy(update={"stations": stations})
    return case.model_copy(update={"vehicle": Vehicle.model_validate(vehicle.model_dump())})


def start(elements=ELEMENTS, **model):
    """The example with nothing but its readings left, ready to be identified."""
    case = an.load_case(example(), ["vehicle.fins.0.thickness=15mm"])
    case = with_stations(case, start_stations(elements))
    return case.model_copy(update={"model": type(case.model)(**{**dict(case.model), **model})})


def observations(thrust=THRUST):
    """The rows that may be fitted, each condition once."""
    rows = {}
    for row in read_rows():
        condition = {"thrust": thrust, **row.condition}
        if not row.held_out:
            rows.setdefault(tuple(condition.values()), (row, condition))
    return [
        {"name": f"Table {row.table}", **condition, "bending": row.frequencies_hz}
        for row, condition in rows.values()
    ]


def problem(case, thrust=THRUST, parameters=(), fit=None):
    return IdentificationProblem.model_validate(
        {
            "case": case,
            "observations": observations(thrust),
            "parameters": [*PARAMETERS, *parameters],
            "distributions": DISTRIBUTIONS,
            "fit": FIT | (fit or {}),
        }
    )


def lines(case, thrust=THRUST):
    """All thirty rows with the frequencies of a vehicle."""
    for row in read_rows():
        at = case.condition.model_copy(update={"thrust": thrust, **row.condition})
        moved = case.model_copy(update={"condition": at})
        beam = replace(moved.beam(), axial_stiffness=None)
        yield Line(row, moved, an.solve_modes(beam, MODES).frequencies_hz())


def masses(case):
    return [case.vehicle.mass_distribution(b).moments(LENGTH)[0] for b in BURN_FRACTION.values()]


def steepness(column):
    """Largest over smallest value along the middle 80 % of the length."""
    inner = column[round(0.1 * ELEMENTS) : round(0.9 * ELEMENTS)]
    return max(inner) / min(inner)


def digits(value, count=5):
    return np.format_float_positional(float(f"{value:.{count}g}"), trim="-")


def shipped_csv(case):
    s = case.vehicle.stations
    m, burnt = s.mass_per_length.values()
    EI, R = s.bending_stiffness, body_radius(s.x, float(s.radius[-1]))
    rows = [
        ",".join(
            [
                *map(digits, (s.x[k], m[k], burnt[k], EI[k] / 1e3)),
                digits(2e-6 * EI[k] / R[k] ** 2, 4),
                digits(1e3 * R[k], 4),
            ]
        )
        for k in range(ELEMENTS)
    ]
    return HEAD + "\n".join([*rows, f"{LENGTH:g},,,,,"]) + "\n"


def report(result):
    case, s = result.case, result.case.vehicle.stations
    found = list(lines(case))
    parts = {
        "fitted": [line for line in found if not line.row.held_out],
        "held out": [line for line in found if line.row.held_out],
        "all": found,
    }
    m, burnt = s.mass_per_length.values()
    yield f"- {result.evaluations} evaluations in {result.seconds:.0f} s, cost {result.cost:.1f}"
    for name, some in parts.items():
        size = size_of(some)
        yield f"- {name}: {len(some)} rows, worst {size.worst:.2e}, rms {size.rms:.2e}"
    yield "- mass {:.0f} kg at t = 0 s, {:.0f} kg at t = 10 s".format(*masses(case))
    yield f"- radius {s.radius[-1]:.5f} m, fins {case.vehicle.fins[0].thickness:.6f} m thick"
    yield (
        f"- largest over smallest along the middle 80 %: mass {steepness(m):.1f}, burnt "
        f"{steepness(burnt):.1f}, EI {steepness(s.bending_stiffness):.1f}"
    )
    yield "\n| parameter | value | standard deviation | by data |\n|---|---|---|---|"
    for p in result.parameters:
        sd = f"{p.sd:.2g}" if math.isfinite(p.sd) else "at its bound"
        yield f"| {p.name} | {p.value:.5g} {p.unit} | {sd} | {p.determined:.0%} |"
    yield ""
    yield from (f"- {warning}" for warning in result.warnings)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--ship", action="store_true", help="write the example's stations")
    options = parser.parse_args()
    result = an.identify(problem(start()))
    print("# The paper's vehicle, identified\n\n`python -m validation.paper_vehicle`\n")
    print("\n".join(report(result)))
    if options.ship:
        file = Path(example()).parent / "stations.csv"
        file.write_text(shipped_csv(result.case), encoding="utf-8")
