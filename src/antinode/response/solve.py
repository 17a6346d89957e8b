"""`solve_response`: from a response file to its result."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from antinode.beam.attachments import PointFeedback
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES
from antinode.beam.loads.turning import refuse_turning
from antinode.errors import ComputationError
from antinode.modes.backends import BackendName, for_one
from antinode.modes.solve import HasBeam, beam_of

from .damping import Damping
from .file import Problem, ResponseFile, load_response, with_equipment
from .numbers import Headline, headlines
from .quantities import Drive

if TYPE_CHECKING:
    from antinode.modes.result import Damping as Way
    from antinode.modes.result import Mode

    from .harmonic import HarmonicResult
    from .random import RandomResult
    from .shock import ShockResult
    from .transient import TransientResult

    Result = HarmonicResult | RandomResult | TransientResult | ShockResult

Kind = Literal["harmonic", "random", "transient", "shock"]


_FEW, _MORE = 3, 6  # modes that are asked whether they grow
_PEAKS, _INTEGRALS = 300, 4000  # frequencies besides those of the file, about
_SUMMED = 50  # modes that histories take, about


def solve_response(problem: Problem | str | Path) -> Result:
    """Compute what a response file asks for.

    Parameters
    ----------
    problem : Problem or path
        As `load_response` returns it, or the name of a response file.

    Returns
    -------
    HarmonicResult, RandomResult, TransientResult or ShockResult
        By the file's `kind`.

    Raises
    ------
    InputError
        If anything in the file is wrong.
    ComputationError
        If no trustworthy answer could be computed.
    """
    own = problem if isinstance(problem, Problem) else load_response(problem)
    if any(FAMILIES[drive.family].law.has_axial_force for drive in own.file.drives):
        refuse_turning(own.beam, "responses")
    growing = unstable(own.beam, own.file.drives, own.damping, own.backend)
    names = ", ".join(f"{m.name} grows at {m.growth_rate_per_s:.4g} /s" for m in growing[:3])
    if own.file.equipment and any(mode.number for mode in growing):  # not the attitude alone
        raise ComputationError(
            f"{own.title}: the body is not stable under its axial force, dampers and feedback "
            f"({names}); no verdict on equipment can be given: 'antinode stability' tells the load "
            "at which it begins; leave [[equipment]] out to see the forced part alone"
        )
    result = _solved(own)
    if growing:
        over_time = own.file.response.kind in ("transient", "shock")
        told = f"the body is not stable under its axial force, dampers and feedback ({names}): " + (
            "it grows on from what is shown"
            if over_time
            else "what is shown is the forced part alone, which never comes by itself"
        )
        result = replace(result, warnings=(told, *result.warnings))
    return result


def beam_response(
    problem: Beam | HasBeam,
    kind: Kind = "harmonic",
    *,
    modes: int | None = None,
    folder: str | Path = ".",
    **tables: Any,
) -> Result:
    """Compute a response of a beam, or of a vehicle in a condition, without a response file.

    Parameters
    ----------
    problem : Beam or case
        A beam, or anything with a method ``beam()``.
    kind : {"harmonic", "random", "transient", "shock"}
    modes : int, optional
        That are summed where histories are (transient, shock); by default enough of them.
    folder : str or Path
        Where files that the tables name lie.
    **tables
        Those of a response file, as dicts and lists: `forces` or `base`, `outputs`, `equipment`,
        `frequency`, `time`, `damping`, `random`, `shock`, `coherence`. Values may carry units:
        ``outputs=[{"x": "1.2 m", "quantity": "acceleration"}]``.

    Returns
    -------
    HarmonicResult, RandomResult, TransientResult or ShockResult
        By `kind`.

    Raises
    ------
    InputError
        If a table is wrong or missing.
    ComputationError
        If no trustworthy answer could be computed.
    """
    from antinode.inputs.explain import validate

    beam = beam_of(problem)
    asked = {"of": beam.name, "kind": kind} | ({} if modes is None else {"modes": modes})
    where = "response(...)"
    file = validate(ResponseFile, {"response": asked, **tables}, where)
    return solve_response(Problem(file, with_equipment(beam, file), Path(folder), where))


class Numbers(NamedTuple):
    """What a response comes to, and what must be said beside it."""

    headlines: tuple[Headline, ...]
    warnings: tuple[str, ...]


def response_numbers(problem: Problem | str | Path, beam: Beam | None = None) -> Numbers:
    """Compute what a response file asks for, and return the few numbers that it comes to.

    Parameters
    ----------
    problem : Problem or path
        As `solve_response` takes it.
    beam : Beam, optional
        In place of that of the file, without the file's equipment: a design among many.

    Returns
    -------
    Numbers
        With their errors (`antinode.response.numbers.headlines`).
    """
    own = problem if isinstance(problem, Problem) else load_response(problem)
    if beam is not None:
        own = own._replace(beam=with_equipment(beam, own.file))
    result = solve_response(own)
    return Numbers(headlines(result), result.warnings)


def solve_one_response(problem: Problem) -> Result:
    """Compute what `solve_response` does, for a command that solves one problem and ends.

    A small one is solved by numpy, so that a fresh install answers before anything is compiled.
    """
    return solve_response(problem._replace(backend=for_one(*size_of(problem))))


def size_of(problem: Problem) -> tuple[int, int]:
    """Return how large a problem is: segments, and to how many modes its work comes about.

    An interval in which something varies counts as the segments of its first three
    representations, three driven frequencies as a mode.
    """
    file, beam = problem.file, problem.beam
    families = dict.fromkeys(drive.family for drive in file.drives)
    known = [family for family in families if family in beam.families]
    stations = len(beam.x) - 1 + len(file.outputs_table) + len(file.equipment) + len(file.forces)
    varying = max((int(np.sum(beam.varies(f))) for f in known), default=0)
    asked = 0 if file.frequency is None else len(file.frequency.hertz())
    frequencies = {"harmonic": asked + _PEAKS, "random": asked + _INTEGRALS}
    modes = frequencies.get(file.response.kind, 3 * _SUMMED) // 3
    return stations + 13 * varying, modes


def unstable(
    beam: Beam, drives: tuple[Drive, ...], damping: Damping, backend: BackendName = "auto"
) -> list[Mode]:
    """Return the modes of the driven families that grow by themselves.

    Dampers to the ground and losses only calm a self-adjoint problem. Where ends follow or
    something feeds back they may make it grow (Ziegler, 1952), and complex modes are asked.
    """
    from antinode.modes.solve import solve_modes

    feeds = any(isinstance(item, PointFeedback) for item in beam.attachments)
    if not np.any(beam.axial_force) and not beam.axial_acceleration and not feeds:
        return []
    follows = any(beam.ends.follow)
    own = _lossy(beam, damping.loss_factor) if follows else beam
    lossy = follows and own.loss_factor is not None and bool(np.any(own.loss_factor))
    way: Way = "complex" if lossy else "auto" if feeds or follows else "none"
    number = _FEW if way == "none" else _MORE
    return [
        mode
        for family in dict.fromkeys(drive.family for drive in drives)
        for mode in solve_modes(
            own, number, families=[family], damping=way, backend=backend
        ).family(family)
        if mode.kind in ("divergent", "flutter")
    ]


def _lossy(beam: Beam, loss_factor: float) -> Beam:
    """Return a beam whose own loss factors are larger by that of a response."""
    if not loss_factor:
        return beam
    own = np.zeros((len(beam.x) - 1, 2)) if beam.loss_factor is None else beam.loss_factor
    return replace(beam, loss_factor=own + loss_factor)


def _solved(own: Problem) -> Result:
    kind = own.file.response.kind
    if kind == "harmonic":
        from .harmonic import solve_harmonic

        return solve_harmonic(own)
    if kind == "random":
        from .random import solve_random

        return solve_random(own)
    if kind == "transient":
        from .transient import solve_transient

        return solve_transient(own)
    from .shock import solve_shock

    return solve_shock(own)
