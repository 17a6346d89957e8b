"""Do 95 % intervals hold 95 % of the truth? Twins of the starter vehicle, identified blind.

Each twin is the starter vehicle with parameters drawn from the prior that its identification
states: cavitator, thrust, fins, gravity rise, four control points each for mass and bending
stiffness. Its frequencies in 12 conditions, six bending modes each, get a relative noise of 1e-4;
then they are identified from the plain starter vehicle. A parameter counts as identifiable where
the data halve its prior's standard deviation. Its true value should lie in the 95 % interval in
90 to 99 % of all pairs of a twin and such a parameter.

The end forces follow the body, keep their direction, or turn with it by shares of which that of the
thrust is unknown as well:

    python validation/identification.py --twins 40 --seed 2026 --ends follows_body
"""

import argparse
import datetime
import platform
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np

NOISE = 1e-4
IDENTIFIABLE = 0.75  # share of the prior's variance that the data remove: half the deviation
BOUNDS = 0.90, 0.99
MODES = 6

CONDITIONS = (
    {},
    {"cavitation_number": 0.012},
    {"cavitation_number": 0.016},
    {"cavitation_number": 0.024},
    {"speed": 40.0},
    {"speed": 60.0},
    {"speed": 120.0},
    {"cavitator_angle": "0 deg"},
    {"cavitator_angle": "5 deg"},
    {"cavitator_angle": "15 deg"},
    {"fin_position": 5.4},
    {"fin_position": 5.7},
)

PARAMETERS = (
    {"key": "vehicle.cavitator.diameter", "prior": {"sd": "2 mm"}},
    {"key": "thrust", "prior": {"sd": "5 kN"}},
    {"key": "fins.0.thickness", "prior": {"kind": "lognormal", "sd": 0.1}},
    {"key": "fins.0.tip_radius", "prior": {"sd": "5 mm"}},
    {"key": "model.gravity_rise_factor", "prior": {"sd": 0.1}},
)

DISTRIBUTIONS = (
    {"column": "mass_per_length", "control_points": 4, "prior_sd": 0.1},
    {"column": "bending_stiffness", "control_points": 4, "prior_sd": 0.1},
)


ENDS = {
    "follows_body": (["model.end_force=follows_body"], ()),
    "fixed_direction": (["model.end_force=fixed_direction"], ()),
    "shares": (
        ["model.thrust_follows=0.8", "model.cavitator_follows=0.9"],
        ({"key": "model.thrust_follows", "prior": {"sd": 0.05}},),
    ),
}
"""By name: what the file says of the end forces, and what is unknown besides."""
TITLES = {
    "follows_body": "Thrust and cavitator follow",
    "fixed_direction": "Fixed directions",
    "shares": "Shares that follow, that of the thrust unknown",
}


class Pair(NamedTuple):
    """A parameter of a twin, as it is and as found."""

    twin: int
    name: str
    true: float
    value: float
    low: float
    high: float
    sd: float
    determined: float

    @property
    def covered(self):
        return self.low <= self.true <= self.high


def starter(folder, ends="follows_body"):
    """The starter vehicle."""
    import antinode as an
    from antinode.examples import write_example

    write_example("starter", folder)
    return an.load_case(folder / "case.toml", ENDS[ends][0])


def problem(case, frequencies=None, more=()):
    """The identification of a twin, given its frequencies, with more unknowns."""
    import antinode as an

    if frequencies is None:
        frequencies = np.ones((len(CONDITIONS), MODES))
    rows = [
        {**condition, "bending": list(map(float, row))}
        for condition, row in zip(CONDITIONS, frequencies, strict=True)
    ]
    return an.IdentificationProblem(
        case=case,
        observations=rows,
        parameters=(*PARAMETERS, *more),
        distributions=DISTRIBUTIONS,
        fit={"relative_sd": NOISE},
    )


def draw(case, seed, twin, more=()):
    """True vector of a twin and its noisy frequencies; drawn again where the vehicle cannot be."""
    import antinode as an
    from antinode.study.identify.identification import prepare

    misfit = prepare(problem(case, more=more))
    random = np.random.default_rng([seed, twin])
    while True:
        vector = misfit.unknowns.start + random.normal(size=len(misfit.unknowns.items))
        low, high = misfit.unknowns.bounds
        if np.any((vector < low) | (vector > high)):
            continue
        try:
            found = misfit.evaluate(vector)
        except an.AntinodeError:
            continue
        exact = np.array([found.fitted_hz(k, "bending") for k in range(len(CONDITIONS))])
        noisy = exact * (1 + NOISE * random.normal(size=exact.shape))
        return misfit.unknowns.values(vector), noisy


def identify_twin(case, seed, twin, more=()):
    """Pairs of one twin, and the result of its identification."""
    import antinode as an

    true, frequencies = draw(case, seed, twin, more)
    result = an.identify(problem(case, frequencies, more))
    pairs = [
        Pair(twin, p.name, float(t), p.value, *p.interval, p.sd, p.determined)
        for p, t in zip(result.parameters, true, strict=True)
    ]
    return pairs, result


def identifiable(pairs):
    """Pairs whose parameter the data determine."""
    return [pair for pair in pairs if pair.determined >= IDENTIFIABLE]


def heading():
    """What all twins have in common, as Markdown."""
    lines = [
        "# Coverage of the intervals of identified parameters",
        "",
        " ".join(__doc__.split("\n\n")[1].split("\n")),
        "",
    ]
    return "\n".join(lines)


def record(pairs, results, seed, seconds, ends):
    """The record of twins of one kind of end forces, as Markdown."""
    known = identifiable(pairs)
    coverage = np.mean([p.covered for p in known])
    costs = [2 * r.cost / (len(r.comparisons)) for r in results]
    seconds_each, calls = [r.seconds for r in results], [r.evaluations for r in results]
    lines = [
        f"## {TITLES[ends]}",
        "",
        f"- {datetime.date.today()}, Python {platform.python_version()}, "
        f"antinode {version('antinode')}, numpy {version('numpy')}, scipy {version('scipy')}",
        f"- command: `python validation/identification.py --twins {len(results)} --seed {seed} "
        f"--ends {ends}`, {seconds:.0f} s in one process",
        f"- {len(results)} twins, {len(known)} pairs of a twin and an identifiable parameter "
        f"(of {len(pairs)})",
        f"- **95 % intervals hold the truth in {coverage:.1%}** (90 to 99 % allowed)",
        f"- all {len(pairs)} pairs, identifiable or not: {np.mean([p.covered for p in pairs]):.1%}",
        f"- twice the cost over the number of frequencies: median {np.median(costs):.2f}, most "
        f"{np.max(costs):.2f}",
        f"- a fit takes {np.median(seconds_each):.1f} s and {np.median(calls):.0f} evaluations "
        f"(median), {max(seconds_each):.1f} s and {max(calls)} at most",
        "",
        "| parameter | prior's sd removed | identifiable in | covered | worst error / sd |",
        "|---|---|---|---|---|",
    ]
    for name in dict.fromkeys(p.name for p in pairs):
        some = [p for p in pairs if p.name == name]
        good = identifiable(some)
        removed = 1 - np.sqrt(1 - np.median([p.determined for p in some]))
        covered = f"{np.mean([p.covered for p in good]):.0%}" if good else ""
        worst = f"{max(abs(p.value - p.true) / p.sd for p in good):.1f}" if good else ""
        lines.append(f"| {name} | {removed:.0%} | {len(good)} | {covered} | {worst} |")
    return "\n".join(lines) + "\n"


def kept(path, ends, text):
    """The whole record, with the part of these end forces replaced and the others as they are."""
    old = path.read_text() if path.exists() else ""
    parts = {p.split("\n")[0]: p for p in old.split("\n## ")[1:]}
    parts[TITLES[ends]] = text.removeprefix("## ")
    known = [parts[title].strip() for title in TITLES.values() if title in parts]
    return "\n\n## ".join([heading().strip(), *known]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--twins", type=int, default=40)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--ends", choices=ENDS, default="follows_body")
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).with_suffix(".md"))
    options = parser.parse_args()
    start, more = time.perf_counter(), ENDS[options.ends][1]
    pairs, results = [], []
    with tempfile.TemporaryDirectory() as folder:
        case = starter(Path(folder), options.ends)
        for twin in range(options.twins):
            found, result = identify_twin(case, options.seed, twin, more)
            pairs += found
            results.append(result)
            known = identifiable(found)
            print(
                f"twin {twin}: cost {result.cost:.2f}, {sum(p.covered for p in known)} of "
                f"{len(known)} covered, {result.evaluations} evaluations, {result.seconds:.1f} s",
                file=sys.stderr,
            )
    text = record(pairs, results, options.seed, time.perf_counter() - start, options.ends)
    options.output.write_text(kept(options.output, options.ends, text))
    print(text)
    coverage = np.mean([p.covered for p in identifiable(pairs)])
    return 0 if BOUNDS[0] <= coverage <= BOUNDS[1] else 1


if __name__ == "__main__":
    sys.exit(main())
