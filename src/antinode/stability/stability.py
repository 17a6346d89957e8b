"""`stability`: where a beam loses its stability, along a factor on all axial forces.

End forces of fixed direction can only make modes diverge; counts find each load and prove the list
(`.counting`). Where end forces follow, all eigenvalues are watched along the factor, each change is
closed in on, and made sharp (`.search`, `.sharpening`).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from antinode.arguments import numbers, within
from antinode.beam.attachments import refuse_feedback, refuse_pedestals
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import out_of_range_is_an_error
from antinode.errors import InputError
from antinode.modes.backends import Backend, BackendName, choose, for_one
from antinode.modes.loading import greatest_in_shear, loading
from antinode.modes.result import not_modelled
from antinode.modes.solve import HasBeam
from antinode.riccati.chain import split_long

from .counting import divergences
from .damped import damped_loss
from .result import Certificate, CriticalLoad, Stability
from .search import changes, walk
from .sharpening import sharpen
from .states import Watcher

_ENOUGH = 4  # modes that have lost stability
_FAR = 1e3  # times the first critical load
_UNITS = 1e4  # times N L^2/EI = 1, where nothing loses stability
_ELASTIC = 6  # modes that are watched
_MOST_ELASTIC = 48
EVALUATIONS = 60
"""Of its chains, in which `modes.backends.for_one` weighs a beam."""
_REFINEMENT = 2
_MANY_PIECES = 10_000


@out_of_range_is_an_error()
def stability(
    problem: Beam | HasBeam,
    largest: float | None = None,
    *,
    tolerance: float = 1e-9,
    dampers: bool = True,
    backend: BackendName | None = None,
) -> Stability:
    """Find every change of stability along a factor on all axial forces, up to the first flutter.

    Parameters
    ----------
    problem : Beam or case
        Under the axial force that is to be multiplied; stiffness, mass and springs stay.
    largest : float, optional
        The largest factor; by default where four modes have lost stability, or 1e3 times the first
        that does.
    tolerance : float
        Largest relative error of a critical factor that is allowed to what varies inside segments.
    dampers : bool
        Whether to look as well where stability is lost with the beam's dashpots and loss factors.
    backend : {"auto", "numpy", "numba"}, optional
        What evaluates chains; by default numpy for a small beam.

    Returns
    -------
    Stability

    Raises
    ------
    InputError
        If there is no axial force, or an argument is out of range.
    ComputationError
        If eigenvalues could not be enclosed.
    """
    beam = problem if isinstance(problem, Beam) else problem.beam()
    tolerance = within("tolerance", tolerance, 1e-12, 0.1)
    most = None if largest is None else _largest(largest)
    refuse_feedback(beam.attachments, BENDING, "critical loads")
    refuse_pedestals(beam.attachments, "critical loads along a factor")
    if beam.is_unloaded:
        raise InputError(
            f"{beam.name}: there is no axial force, so a factor on it changes nothing; give "
            "axial_force, an axial acceleration or forces along the beam"
        )
    solver = choose(backend or for_one(_pieces(beam), EVALUATIONS))
    along = _followed if any(beam.following()) or beam.loads_turn else _counted
    found = along(beam, most, tolerance, solver)
    damped = damped_loss(beam, found) if dampers else None
    return replace(found, damped=damped, not_modelled=not_modelled(beam))


def _pieces(beam: Beam) -> int:
    """Return how many pieces chains are cut into: many where the stiffness in shear is used up."""
    factor = greatest_in_shear(beam)
    if not np.isfinite(factor):
        return len(beam.chain(BENDING).length)
    try:
        return len(split_long(loading(beam, 1, translates=False)(factor), 0.0).length)
    except FloatingPointError:
        return _MANY_PIECES


def _counted(beam: Beam, most: float | None, tolerance: float, solver: Backend) -> Stability:
    found = divergences(beam, most, tolerance, solver)
    warnings = (*_without(found.unstable), *found.warnings)
    force = _largest_force(beam)
    return Stability(beam.name, found.critical, (0.0, found.reach), force, "counts", 0, warnings)


def _largest(value: float) -> float:
    factor = float(numbers("largest", value))
    if not 0 < factor < 1e30:
        raise InputError(
            f"the largest factor is {factor:g}; it must be positive and finite: factors run from 0 "
            "upwards, and a negative one would turn all forces round (change their signs for that)"
        )
    return factor


def _without(unstable: int) -> tuple[str, ...]:
    if not unstable:
        return ()
    return (
        f"without any axial force {unstable} of the modes diverge already; that no change of "
        "stability is missing is not proven then",
    )


def _largest_force(beam: Beam) -> float:
    k = np.arange(len(beam.x) - 1)
    sides = [beam.axial_force_at(k, np.full(len(k), t)) for t in (0.0, 0.5, 1.0)]
    return float(np.max(np.abs(sides)))


def _unit(beam: Beam) -> float:
    """Return the factor at which abs(N) L^2/EI is one, where that is largest."""
    k = np.arange(len(beam.x) - 1)
    N = np.max(
        [np.abs(beam.axial_force_at(k, np.full(len(k), t))) for t in (0.0, 0.5, 1.0)], axis=0
    )
    soft = np.min(beam.bending_stiffness, axis=1)
    return 1.0 / (float(np.max(N / soft)) * beam.length**2)


def _followed(beam: Beam, most: float | None, tolerance: float, solver: Backend) -> Stability:
    """Watch more modes until twice as many tell nothing else."""
    elastic = _ELASTIC
    while True:
        watcher = Watcher(beam, solver, _REFINEMENT, elastic)
        found = _Walk(watcher, most, tolerance)
        found.run()
        if not found.misses_some() or elastic >= _MOST_ELASTIC:
            break
        elastic *= 2
    warnings = (*_without(found.unstable), *found.warnings())
    reach = (0.0, found.reach)
    return Stability(
        beam.name,
        tuple(found.critical),
        reach,
        _largest_force(beam),
        "followed",
        len(watcher.solved),
        warnings,
    )


class _Walk:
    """A walk along the factor, and what it met."""

    def __init__(self, watcher: Watcher, most: float | None, tolerance: float) -> None:
        self.watcher, self.most, self.tolerance = watcher, most, tolerance
        self.critical: list[CriticalLoad] = []
        self.told: list[str] = []
        self.reach = 0.0
        start = watcher.at(0.0)
        moved = len(watcher.rigid) > watcher.zeros
        self.turns = moved and start.status[0] > 0 and start.real[0] > -1e-200
        self.unstable = start.unstable - self.turns

    def run(self) -> None:
        """Walk until the first flutter, or as far as was asked for."""
        unit, beam = _unit(self.watcher.beam), self.watcher.beam
        limit = min(self.most or _UNITS * unit, greatest_in_shear(beam))
        for before, after in walk(self.watcher, unit, limit):
            if self.turns and not self.critical:
                self.critical.append(_at_once(after.factor, after.unstable))
            for change in changes(self.watcher, before, after):
                found, warnings = sharpen(self.watcher, change, self.tolerance)
                if found is None:
                    continue
                self.critical.append(found)
                self.told += warnings
                enough = self.most is None and found.certificate.unstable[1] >= _ENOUGH
                if found.kind == "flutter" or enough:
                    self.reach = found.bracket[1]
                    return
            self.reach = max(self.reach, after.factor)
            lost = [each.load_factor for each in self.critical if each.load_factor > 0]
            if self.most is None and lost and self.reach >= _FAR * lost[0]:
                return

    def misses_some(self) -> bool:
        """Tell whether twice as many modes show more that are unstable."""
        beam, solver = self.watcher.beam, self.watcher.backend
        more = Watcher(beam, solver, self.watcher.refinement, 2 * self.watcher.elastic)
        edge = self.critical[-1].bracket[0] if self.critical else self.reach
        return more.at(edge).unstable != self.watcher.at(edge).unstable

    def warnings(self) -> list[str]:
        """Return what is to be warned of."""
        unproven = [each for each in self.critical if not each.proven]
        names = "; ".join(" with ".join(each.modes) for each in unproven)
        said = [f"not proven: {names}; the bracket is as wide as was looked at"] if unproven else []
        open_ = sum(not s.proven for s in self.watcher.solved.values())
        if open_:
            said.append(
                f"at {open_} of {len(self.watcher.solved)} factors it is not proven that all "
                "eigenvalues were found"
            )
        return [*self.told, *said]


def _at_once(factor: float, unstable: int) -> CriticalLoad:
    """Return the rotation that any factor at all makes diverge."""
    return CriticalLoad(
        kind="divergence",
        load_factor=0.0,
        bracket=(0.0, factor),
        error=0.0,
        frequency_hz=0.0,
        frequency_error_hz=0.0,
        omega2=0.0,
        modes=("rigid rotation",),
        change="lost",
        certificate=Certificate("winding", (0, unstable)),
    )
