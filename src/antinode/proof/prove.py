"""`prove`: lists of modes proven in ball arithmetic, for beams of uniform segments."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.modes import following
from antinode.modes.backends import choose
from antinode.modes.damped import family as damped_family
from antinode.modes.damped.family import DampedFamily, solve_damped, without_dashpots
from antinode.modes.damped.modes import shown
from antinode.modes.result import ModalResult, Mode
from antinode.riccati.chain import omega2_scale
from antinode.riccati.damped.chain import Damped

from .function import Characteristic, Variable
from .lists import Listed, Outcome, Verdict, prove_list

_PADS = 0.05, 1e-3, 1e-5, 1e-7  # of the largest listed omega^2, by which the circle is larger
_MORE = 12  # oscillating modes beyond those listed, which the solver's circle may need
_WIDER = 1.0, 4.0, 16.0, 64.0  # of the same, further to the left
_NOT_PROVEN = damped_family.NOT_PROVEN, following.NOT_PROVEN


@dataclass(frozen=True)
class Proof:
    """What balls say about the modes of a result.

    Attributes
    ----------
    verdict : {"proven", "refuted", "undecided"}
        The worst of all families.
    sentence : str
    precision_bits : int
        Largest that was needed.
    arcs : int
        Along which the argument principle was applied, all told.
    regions : dict
        What was proven, by family: the circle and how many eigenvalues it holds.
    """

    verdict: Verdict
    sentence: str
    precision_bits: int
    arcs: int
    regions: dict[str, dict[str, Any]]

    @property
    def proven(self) -> bool:
        """Whether every list is complete, and every eigenvalue where it is said to be."""
        return self.verdict == "proven"

    def to_dict(self) -> dict[str, Any]:
        """Return what a certificate gains, as JSON has it."""
        record: dict[str, Any] = {
            "balls": self.proven,
            "balls_verdict": self.verdict,
            "precision_bits": self.precision_bits,
            "arcs": self.arcs,
            "ball_regions": self.regions,
        }
        return record if self.proven else record | {"balls_reason": self.sentence}

    def applied(self, result: ModalResult) -> ModalResult:
        """Return a result with this in its certificate.

        What the solver could not prove, and balls could, is no warning any more.
        """
        certificate = {**result.certificate, **self.to_dict()}
        if not self.proven or certificate["kind"] != "none":
            return replace(result, certificate=certificate)
        region = dict(next(iter(self.regions.values())))
        del region["eigenvalues"]
        kept = [w for w in result.noted if not w.endswith(_NOT_PROVEN)]
        certificate |= {"kind": "winding", "region": region}
        return replace(result, certificate=certificate, noted=tuple(kept))


@dataclass(frozen=True)
class _Problem:
    """A list with the region in which it is to be complete."""

    damped: Damped
    variable: Variable
    centre: float
    radius: float
    listed: list[Listed]
    zeros: int

    def outcome(self) -> Outcome:
        far = abs(self.centre) + self.radius
        omega2 = far if self.variable == "omega2" else far**2
        make = partial(Characteristic, self.damped, self.variable, omega2)
        return prove_list(make, self.centre, self.radius, self.listed, self.zeros)

    def region(self, eigenvalues: int) -> dict[str, Any]:
        if self.variable == "s":
            where: dict[str, Any] = {"abs_s_below": self.radius}
        else:
            where = {"omega2_centre": self.centre, "omega2_radius": self.radius}
        return where | {"eigenvalues": eigenvalues}


@out_of_range_is_an_error()
def prove(result: ModalResult) -> Proof:
    """Prove in ball arithmetic that the modes of a result are all there are in a region.

    The region is a circle about s = 0 for complex modes, and else one about those listed, in
    omega^2; the error stated for each mode is the radius of its own circle. What is proven holds
    for the beam whose numbers are those of the file in double precision.

    Parameters
    ----------
    result : ModalResult
        Of a beam with constant properties between its stations.

    Raises
    ------
    InputError
        If python-flint is not installed, something varies between stations, loss factors act
        beside dashpots, or the method gives no errors.
    """
    import_extra("flint", "prove")
    if result.method != "riccati":
        raise InputError(
            "a proof needs the errors that method = 'riccati' states; leave out method = 'tmm'"
        )
    for family in result.families:
        _check_uniform(result.beam, family)
    regions: dict[str, dict[str, Any]] = {}
    worst, sentence, bits, arcs = "proven", "", 0, 0
    for family in result.families:
        problem, outcome = _family(result, family)
        bits, arcs = max(bits, outcome.precision_bits), arcs + outcome.arcs
        if problem is not None:
            regions[family] = problem.region(outcome.eigenvalues)
        if outcome.verdict != "proven" and worst != "refuted":
            worst, sentence = outcome.verdict, f"{family} modes {outcome.verdict}: {outcome.reason}"
    if worst == "proven":
        number = sum(r["eigenvalues"] for r in regions.values())
        sentence = (
            f"proven in ball arithmetic ({bits} bits, {arcs} arcs): the regions hold {number} "
            "eigenvalues, those listed, each within its error"
        )
    return Proof(worst, sentence, bits, arcs, regions)  # type: ignore[arg-type]


def _check_uniform(beam: Beam, family: FamilyName) -> None:
    """Refuse beams that a chain only approximates."""
    varies = np.flatnonzero(beam.varies(family))
    if len(varies):
        low, high = beam.x[varies[0]], beam.x[varies[0] + 1]
        raise InputError(
            f"a proof needs properties and axial force that are constant between stations, and "
            f"something varies from x = {low:g} to {high:g} m: the chain of uniform segments is an "
            "approximation there, and balls would prove its list only; give steps "
            "(interpolation = 'step'), or leave out --prove"
        )


def _family(result: ModalResult, family: FamilyName) -> tuple[_Problem | None, Outcome]:
    modes = result.family(family)
    if not all(math.isfinite(m.error_omega2) for m in modes):
        return None, Outcome("undecided", "not every mode has an error", -1, 0, 0)
    if any(m.eigenvalue is not None for m in modes):
        return _complex(result, family, modes)
    damped = Damped(without_dashpots(result.beam.chain(family, 1)))
    for problem in _real(damped, modes):
        outcome = problem.outcome()
        missing = outcome.eigenvalues - len(problem.listed) - problem.zeros
        if outcome.verdict == "proven" or (outcome.verdict == "refuted" and missing <= 0):
            return problem, outcome
    last = max(problem.listed, key=lambda v: v.z.real, default=None)
    if outcome.verdict == "refuted" and last is not None and last.z.imag:
        reason = f"no circle holds those listed alone, up to the pair {last.name}; ask for more"
        outcome = replace(outcome, verdict="undecided", reason=reason)
    return problem, outcome


def _real(damped: Damped, modes: Sequence[Mode]) -> Iterator[_Problem]:
    """Yield ever tighter circles in omega^2 that hold what is listed; one at least."""
    at_zero = [m for m in modes if m.omega2 == 0 and m.number == 0]
    zeros = len(at_zero)
    listed = [Listed(m.name, _omega2(m), m.error_omega2) for m in modes if m not in at_zero]
    high = max([0.0, *(v.z.real + v.radius for v in listed)])
    low = min([0.0, *(v.z.real - v.radius for v in listed)])
    scale = max([abs(v.z) for v in listed], default=omega2_scale(damped.chain))
    for pad in _PADS:
        right = high + pad * scale
        for more in _WIDER:
            left = low - more * scale
            centre, radius = (left + right) / 2, (right - left) / 2
            if all(abs(v.z - centre) + v.radius < radius for v in listed):
                yield _Problem(damped, "omega2", float(centre), float(radius), listed, zeros)
                break


def _omega2(mode: Mode) -> complex:
    """Return omega^2 = -s^2, complex where the mode grows or decays as it oscillates."""
    if not mode.growth:
        return complex(mode.omega2)
    return -(mode.eigenvalue_per_s**2)


def _complex(
    result: ModalResult, family: FamilyName, modes: Sequence[Mode]
) -> tuple[_Problem | None, Outcome]:
    """Prove the list of the circle in s that the solver states, and that it is what is shown."""
    own = [m for m in modes if m.eigenvalue]
    number = sum(1 for m in own if m.eigenvalue_per_s.imag)
    reach = max((abs(m.eigenvalue_per_s) + (m.error_per_s or 0.0) for m in own), default=0.0)
    for more in range(_MORE):  # the least circle that holds all of them
        wanted = max(number, 1) + more
        solved = solve_damped(
            result.beam, family, wanted, result.tolerance, choose("numpy"), lossy=True
        )
        if solved.certificate["region"]["abs_s_below"] > reach:
            break
    reason = _differs(own, solved, number) or _rests(len(modes) - len(own), solved)
    if reason:
        return None, Outcome("refuted", reason, -1, 0, 0)
    if not np.all(np.isfinite(solved.error)):
        return None, Outcome("undecided", "not every mode has an error", -1, 0, 0)
    problem = _in_s(solved)
    return problem, problem.outcome()


def _differs(own: Sequence[Mode], solved: DampedFamily, number: int) -> str:
    """Say how a result differs from the list that its beam has."""
    left = list(range(len(own)))
    for k in shown(solved, max(number, 1)):
        s, error = solved.eigenvalues[k].s, float(solved.error[k])
        far = {i: abs(own[i].eigenvalue_per_s - s) for i in left}
        near = [i for i in left if far[i] <= error + (own[i].error_per_s or 0.0)]
        if not near:
            return f"the list lacks s = {s:.10g} 1/s"
        left.remove(min(near, key=far.__getitem__))
    if left:
        extra = own[left[0]]
        return f"the list has {extra.name} at s = {extra.eigenvalue_per_s:.10g} 1/s, the beam none"
    return ""


def _rests(number: int, solved: DampedFamily) -> str:
    """Say how many rigid modes at rest a result has, if the beam has others."""
    right = len(solved.rest.motions)
    return "" if number == right else f"the list has {number} modes at rest, the beam {right}"


def _listed(solved: DampedFamily) -> Iterator[Listed]:
    for value, error in zip(solved.eigenvalues, solved.error.tolist(), strict=True):
        yield Listed(f"s = {value.s:.10g} 1/s", value.s, error)


def _in_s(solved: DampedFamily) -> _Problem:
    """Return the list in s, with the conjugates.

    Where loss factors act D is that of Im s > 0, which depends on s^2 alone: its other zeros are
    those of the list times -1.
    """
    lossy = solved.damped.columns is not None
    if lossy and solved.damped.acting.C.any():
        raise InputError(
            "loss factors act beside dashpots, and no one entire function has the eigenvalues of "
            "both halves of the plane: leave out --prove, or one of them"
        )
    listed = list(_listed(solved))
    listed += [
        Listed(v.name, -v.z if lossy else v.z.conjugate(), v.radius) for v in listed if v.z.imag
    ]
    radius = float(solved.certificate["region"]["abs_s_below"])
    return _Problem(solved.damped, "s", 0.0, radius, listed, solved.rest.multiplicity)
