"""The backend in compiled code: arrays in and out, one call for each question.

As `riccati.readable` does, it answers the calls of a backend.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from antinode.riccati.arrays import Array
from antinode.riccati.chain import Chain, Evaluation
from antinode.riccati.chain import evaluate as evaluate_readable
from antinode.riccati.chains import BeamRoots, ChainRoots, Chains, Tables
from antinode.riccati.damped.chain import Form
from antinode.riccati.damped.compiled import Compiled
from antinode.riccati.laws import BENDING
from antinode.riccati.reasons import CERTIFIED, CHAIN_TOO_SMALL, TABLE_TOO_SMALL
from antinode.riccati.roots import Eigenvalue, FollowingRoots
from antinode.riccati.roots import find_eigenvalues as find_readable

from . import single
from .forced.states import DrivenChain
from .laws import FORMS
from .library import library
from .modal.states import cut, mode_energies, mode_states, normal_modes, normalise
from .scratch import Need, new_table, scratch
from .single import SingleChain, more_columns
from .structures import Kept
from .workspace import NO_POINTS, POINT, ROWS, Interior, Nodes, Task, Warmth, new_chain
from .workspace import Chain as Own

__all__ = [
    "certify_guesses",
    "complex_form",
    "cut",
    "driven",
    "evaluate",
    "find_eigenvalues",
    "find_following",
    "mode_energies",
    "mode_states",
    "name",
    "normal_modes",
    "normalise",
    "solve_beam",
    "solve_chains",
]

name = "numba"
driven = DrivenChain
complex_form: type[Form] = Compiled

_MANY = 64  # chains of a batch from which integrals over shapes are worth their time
_GUESSED = 1e-8  # relative width of brackets of the chain in the middle of a batch
_NO_MORE = np.empty((1, 0))
_NO_NODES = Nodes(np.empty(0, np.int64), NO_POINTS, NO_POINTS)


def evaluate(chain: Chain, omega2: npt.ArrayLike) -> Evaluation:
    """Count the eigenvalues below each `omega2`: `riccati.chain.evaluate`, compiled.

    Parameters
    ----------
    chain : Chain
        Supports at its two ends belong into `left` and `right`; one that needs frames gets them.
    omega2 : array_like, shape (k,)
        [rad^2/s^2], any sign.

    Returns
    -------
    Evaluation
        The characteristic function is scaled to the last minors of each omega^2: bounded by 1.
    """
    asked = np.atleast_1d(np.asarray(omega2, dtype=float))
    return SingleChain(chain)(asked) if _is_known(chain) else evaluate_readable(chain, asked)


def _is_known(chain: Chain) -> bool:
    """Tell whether the compiled form knows all columns of a chain, and its supports."""
    return not _needs_frames(chain)


def _needs_frames(chain: Chain) -> bool:
    """Tell whether supports stand where the compiled chain does not know them.

    Or pedestals on a chain whose ends follow: its minors know one scale alone.
    """
    known = range(1, len(chain.length)) if FORMS[chain.law].supports else ()
    return any(
        (point.holds and point.node not in known) or (point.pedestal and chain.follows)
        for point in chain.points
    )


def solve_chains(
    chains: Chains, below: int, number: int, width: float, *, proven: bool = True
) -> ChainRoots:
    """Solve chain after chain, each from the roots of the one before.

    The table is new in every call: its size decides where a row starts afresh, and a result must
    not depend on what was solved before.

    Parameters
    ----------
    chains : Chains
    below : int
        Eigenvalues below those wanted: the rigid ones.
    number : int
        Of eigenvalues wanted.
    width : float
        Relative width of the brackets in omega^2.
    proven : bool
        Or else every eigenvalue is only enclosed, and predicted to a tenth of the width.
    """
    given, ends, n = _whole(chains), _ends(chains), chains.length.shape[1]
    own, found = _own(chains), ChainRoots.empty(len(chains), number)
    warmth = Warmth(
        neighbour=np.array([-1]),
        omega2=np.zeros(number),
        slope=np.zeros(number),
        weights=_weights(chains, below, number),
        quotient=np.zeros((2, number)),
    )
    task, search, row = Task(below, width, proven), scratch.search(number), 0
    table = np.empty((ROWS, n + n // 2 + 8))
    while row < len(chains):
        row, columns, _ = library("roots").call(
            "solve_rows",
            (*given, ends),
            row,
            own,
            task,
            warmth,
            table,
            scratch.lanes,
            search,
            found,
        )
        if row < len(chains):
            warmth.neighbour[0], table = -1, new_table(columns)
    return found


_NO_ENDS = np.zeros((1, 2))


def _ends(chains: Chains) -> Array:
    """Return what turns with the ends of chains [N], one row for all where nothing does."""
    return _NO_ENDS if chains.following is None else np.ascontiguousarray(chains.following)


def _whole(chains: Chains) -> tuple[Array, ...]:
    """Return the arrays of chains, with a row for each but for the length, where one may do."""
    shape = chains.axial_force.shape

    def whole(values: Array) -> Array:
        if values.shape != shape:
            values = np.broadcast_to(values, shape)
        return values if values.flags.c_contiguous else np.ascontiguousarray(values)

    m, stiffness, N = (whole(values) for values in chains.arrays[1:])
    more = 5 * (_NO_MORE,) if chains.more is None else map(np.ascontiguousarray, _more(chains.more))
    return np.ascontiguousarray(chains.length), m, stiffness, N, *more


def _more(columns: Mapping[str, Array]) -> tuple[Array, ...]:
    """Return s, sN, sN^2, rotary inertia and foundation; sN and sN^2 without columns by default."""
    names = "shear", "shear_turn", "shear_work", "rotary_inertia", "foundation"
    return tuple(columns.get(name, _NO_MORE) for name in names)


def _own(chains: Chains) -> Kept[Own]:
    """Return room for one of them."""
    form = FORMS[chains.law]
    ends = form.ends[chains.left], form.ends[chains.right]
    n, plain = chains.length.shape[1], chains.more is None
    if plain:
        return scratch.chain(form.number, *ends, n)
    return Kept(new_chain(form.with_more, *ends, n, more=True))


def _weights(chains: Chains, below: int, roots: int) -> Array:
    """Return integrals of Y''^2, Y'^2 and Y^2 over the segments of the mean chain, (3, roots, n).

    They tell how a root moves with the chain: what starts a search, and never what it finds. None
    where they are not worth their time, or cannot be had: (3, 0, n). Where there is shear, those of
    Q^2 and of twice its mean energy follow, (5, roots, n): the energy falls as s rises.
    """
    none = np.empty((3, 0, chains.length.shape[1]))
    if (
        chains.following is not None
        or len(chains) < _MANY
        or len(chains.length) > 1
        or not FORMS[chains.law].shapes
    ):
        return none
    with np.errstate(all="ignore"):
        m, EI, N = (np.mean(values, axis=0) for values in chains.arrays[1:])
        if not np.all(np.isfinite(m + EI + N)):
            return none
        h, columns = chains.length[0], chains.law.named(m, EI, N)
        if chains.more is not None:
            columns |= {name: np.mean(values, axis=0) for name, values in chains.more.items()}
            s = columns["shear"]
            columns = {"shear_turn": s * N, "shear_work": s * N**2} | columns
        weights = _squares(Chain(chains.law, h, columns, chains.left, chains.right), below, roots)
    return none if weights is None or not np.all(np.isfinite(weights)) else weights


def _squares(chain: Chain, below: int, roots: int) -> Array | None:
    found = SingleChain(chain).roots(below, roots, _GUESSED)
    if found.reason != CERTIFIED:
        return None
    states = mode_states(chain, found.omega2, np.ones(roots, np.int64)).transpose(2, 1, 0)
    squares = (states[:, :, 1:] ** 2 + states[:, :, :-1] ** 2) * (chain.length / 2)
    weights = squares[2::-1] / (squares[0] @ chain.mass)[:, None]
    weights[0] /= chain.stiffness**2
    if chain.is_plain:
        return np.ascontiguousarray(weights)
    sheared = squares[3] / (squares[0] @ chain.mass)[:, None]
    twice = 2 * sheared * more_columns(chain)[0]
    return np.ascontiguousarray(np.concatenate([weights, [sheared, twice]]))


def certify_guesses(chains: Chains, guess: Array, below: int, width: float) -> ChainRoots:
    """Certify guesses for chains of one structure under many axial forces.

    Parameters
    ----------
    chains : Chains
        All with the structure of the first.
    guess : array, shape (chains, roots)
        [rad^2/s^2].
    below, width
        As for `solve_chains`.

    Returns
    -------
    ChainRoots
        With two evaluations a root where the guess held.
    """
    n, number = chains.axial_force.shape[1], guess.shape[1]
    found, kept = ChainRoots.empty(len(chains), number), _own(chains)
    own = kept.structure
    own.length[:], own.mass[:] = chains.length[0], chains.mass[0]
    own.stiffness[:] = chains.stiffness[0]
    library("roots").call(
        "certify_rows",
        *(np.ascontiguousarray(chains.axial_force), _ends(chains)),
        *(np.ascontiguousarray(guess), kept),
        *(np.zeros(n), Task(below, width, True), np.zeros(number), np.empty((ROWS, n + 64))),
        *(scratch.lanes, scratch.search(number), found),
    )
    return found


def solve_beam(
    beam: Tables, below: int, number: int, refinement: int, tolerance: float, width: float
) -> BeamRoots:
    """Bracket and certify eigenvalues below + 1 ... below + number of a beam.

    Steps are halved until two extrapolated results agree; the brackets are those of the last chain.

    Parameters
    ----------
    refinement : int
        Number by which the coarsest steps are divided in the first chain.
    tolerance : float
        Relative error of the frequencies.
    width : float
        Relative width of the brackets in omega^2.
    """
    form = FORMS[BENDING]
    ends = form.ends[beam.left], form.ends[beam.right]
    steepest, longest, halvings = beam.limits
    interior = Interior(
        *(*ends, float(beam.acceleration), *beam.following),
        *(beam.logarithmic, steepest, longest, halvings),
    )
    nodes, need = _nodes(beam), Need()
    while True:
        kept = scratch.levels(form.number, len(beam.mass), number, need)
        own = kept.structure
        own.x[:], own.mass[:], own.stiffness[:] = beam.x, beam.mass, beam.stiffness
        own.force[:] = beam.axial_force
        if beam.acceleration:
            own.mass_left[:] = beam.mass_left
        reason, size, evaluations = library("roots").call(
            "solve_levels", kept, interior, nodes, below, refinement, tolerance, width
        )
        if reason == TABLE_TOO_SMALL:
            need = need._replace(pieces=size)
        elif reason == CHAIN_TOO_SMALL:
            need = need._replace(segments=size)
        else:
            break
    omega2, error, bracket = own.omega2.copy(), own.error_omega2.copy(), own.bracket.copy()
    return BeamRoots(reason, omega2, error, bracket, own.roots.counts.copy(), evaluations, size)


def _nodes(beam: Tables) -> Nodes:
    """Return what stands at the breakpoints of a beam."""
    if not beam.points:
        return _NO_NODES
    at = np.array([point.node for point in beam.points], dtype=np.int64)
    rows = [FORMS[BENDING].point(point, 1.0, 1.0, 1.0) for point in beam.points]
    return Nodes(at, np.array(rows), np.empty((len(rows), POINT)))


def find_eigenvalues(
    chain: Chain,
    wanted: int,
    *,
    zeros: int = 0,
    width: float = 1e-10,
    expected: Array | None = None,
) -> list[Eigenvalue]:
    """Return the lowest eigenvalues of a chain as `riccati.roots.find_eigenvalues` does.

    Where determinants do not do - some supports, modes that nearly coincide - that function does.
    """
    if _is_known(chain) and not chain.follows:
        found = SingleChain(chain).lowest(wanted, zeros, width)
        if found:
            return found
    return find_readable(chain, wanted, zeros=zeros, width=width, expected=expected)


def find_following(
    chain: Chain, below: int, wanted: int, *, zeros: int, free: bool, width: float
) -> FollowingRoots | None:
    """Return the lowest eigenvalues where ends follow, proven; None where that is for Python."""
    if _needs_frames(chain):
        return None
    asked = below, wanted
    return single.find_following(chain, *asked, zeros=zeros, free=free, width=width)
