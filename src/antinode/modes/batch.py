"""Certified frequencies of many beams at once, in bending or another family of modes.

    result = solve_many(BeamBatch(length, mass_per_length, bending_stiffness, axial_force))
    result.frequencies_hz
    shafts = BeamBatch(length, family="torsion", torsional_stiffness=GJ, polar_inertia_per_length=J)

Every beam is a chain of uniform segments, exact as it stands; rigid modes are set aside by their
index. Each beam starts from the roots of the one before, so that a sweep is best kept in order.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from antinode.arguments import ByValue, choice, owned, wanted, whole, within
from antinode.arrays import Array, Integers
from antinode.beam.checks import ShearForm
from antinode.beam.ends import FREE, Ends
from antinode.beam.families import BENDING, FAMILIES, Family, FamilyName
from antinode.errors import InputError
from antinode.riccati.chain import Chain
from antinode.riccati.chains import ChainRoots, Chains
from antinode.riccati.reasons import (
    BY_ITSELF,
    CLUSTERED,
    FLUTTERS,
    INVALID,
    NOT_BRACKETED,
    NOT_FINITE,
    OUT_OF_REACH,
    PAST_BUCKLING,
)
from antinode.riccati.roots import CountingError, Eigenvalue, check_certificate
from antinode.riccati.shapes import split_for

from .backends import Backend, BackendName, choose
from .brackets import ROUNDING, cancelling, share_brackets
from .following import eigenvalues_alone, two_sided_energies
from .guesses import guess_omega2
from .hertz import error_hz, growth_rate, hertz, settled
from .rigid import rigid_modes_of, translates, zeros_of
from .rotation import elastic

REASONS = (
    "",
    "out of reach: stiffness, mass and axial force of one segment do not go together",
    "not certified: the counts did not bracket every mode",
    "not certified: the characteristic function is not finite",
    "invalid: length, mass and stiffness must be positive, everything finite, and the axial force "
    "less than the stiffness in shear can bear",
    "not certified: modes too close to each other for the counts between them",
    "past buckling: omega^2 of the first mode is negative",
    "flutter: a pair of modes grows while it oscillates",
)
"""What the codes in `BatchResult.reason` mean; 0 is success."""

NARROW = 1e-10
"""Relative width of brackets in omega^2."""
_BEFORE_ROUNDING = 0.98  # share of a bracket
Growing = dict[int, Array]
"""Re s of the modes of some beams, by their row; 0 where it does not come of a pair."""
_ALONE = NOT_BRACKETED, CLUSTERED, BY_ITSELF


@dataclass(frozen=True, eq=False)
class BeamBatch(ByValue):
    """Beams of as many uniform segments each, one a row.

    Parameters
    ----------
    length : array, shape (n,) or (beams, n)
        Of the segments, from left to right [m].
    mass_per_length, bending_stiffness : array, shape (n,) or (beams, n)
        m [kg/m] and EI [N m^2].
    axial_force : array, shape (n,) or (beams, n), optional
        N [N], compression positive; zero by default.
    ends : Ends
        The same for all beams; each family reads its own of them.
    modes : int
        Elastic modes 1 ... `modes` are computed.
    family : {"bending", "longitudinal", "torsion"}
        Of modes. Each has its arrays, no others: bending those above, longitudinal modes
        `mass_per_length` and `axial_stiffness`, torsion the last two.
    axial_stiffness, torsional_stiffness, polar_inertia_per_length : array, (n,) or (beams, n)
        EA [N], GJ [N m^2] and rho I_p [kg m].
    following : array, shape (2,) or (beams, 2), optional
        The part of the forces at both ends that turns with them [N]; by default the shares of
        `ends` times N of the first and the last segment.
    shear_stiffness, rotary_inertia_per_length, foundation_stiffness, added_mass_per_length : array
        Of bending, as the others, optional: kGA [N], or inf; rho I [kg m]; [N/m^2]; [kg/m]. A
        foundation holds every beam of a batch, or none.
    shear_form : {"haringx", "engesser"}
        How the axial force and shear meet.
    force_over_shear, force_squared_over_shear : array, (n,) or (beams, n), optional
        Averages of N/kGA [-] and N^2/kGA [N] over segments inside which these vary, beside
        `shear_stiffness`, both or neither; by default of the segments' own, as for uniform ones.

    Raises
    ------
    InputError
        If an array of the family is missing or one of another family is given, the shapes do not
        go together, or a value is masked. Values are checked beam by beam when they are solved.

    Notes
    -----
    Immutable: it owns its arrays, which are copied unless they are read-only, compares by value,
    and has a hash.
    """

    length: Array
    mass_per_length: Array | None = None
    bending_stiffness: Array | None = None
    axial_force: Array | None = None
    ends: Ends = FREE
    modes: int = 6
    family: FamilyName = BENDING
    axial_stiffness: Array | None = None
    torsional_stiffness: Array | None = None
    polar_inertia_per_length: Array | None = None
    following: Array | None = None
    shear_stiffness: Array | None = None
    rotary_inertia_per_length: Array | None = None
    foundation_stiffness: Array | None = None
    added_mass_per_length: Array | None = None
    shear_form: ShearForm = "haringx"
    force_over_shear: Array | None = None
    force_squared_over_shear: Array | None = None
    _one_structure: bool = field(default=False, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        choice("family", self.family, FamilyName)
        choice("shear_form", self.shear_form, ShearForm)
        object.__setattr__(self, "modes", whole("modes", self.modes, 500))
        tables = self._given()
        rows, n = _common_shape(tables)
        object.__setattr__(self, "_one_structure", self._varies_by_force(tables))
        for name, values in tables.items():
            shape = (_rows(values) if name in _BY_ITSELF else rows, n)
            if values.shape != shape:
                same = values.size == shape[0] * n
                values = values.reshape(shape) if same else np.broadcast_to(values, shape)
            if not values.flags.c_contiguous:
                values = np.ascontiguousarray(values)
                values.flags.writeable = False
            object.__setattr__(self, name, values)

    def _given(self) -> dict[str, Array]:
        """Return the length and the family's tables, with no axial force where none is given."""
        family, own = FAMILIES[self.family], vars(self)
        tables, force = family.tables, family.columns.get("axial_force")
        for name in _TABLES:
            if (own[name] is None) == (name in tables) and name != force:
                self._refuse(family)
        more = [name for name in _MORE if own[name] is not None]
        if any(name not in family.more for name in more):
            self._refuse(family)
        averages = [name for name in _AVERAGES if own[name] is not None]
        if averages and (len(averages) == 1 or self.shear_stiffness is None):
            raise InputError(
                f"a batch has {averages[0]}: give {' and '.join(_AVERAGES)} beside "
                "shear_stiffness, or neither"
            )
        given = {name: own[name] for name in ("length", *tables, *more, *averages)}
        if force and given[force] is None:
            given[force] = np.zeros(1)
        return {name: owned(name, values) for name, values in given.items()}

    def _refuse(self, family: Family) -> None:
        """Say which arrays are missing, and which are of another family."""
        force = family.columns.get("axial_force")
        given = [name for name in (*_TABLES, *_MORE) if getattr(self, name) is not None]
        missing = [name for name in family.tables if name not in given and name != force]
        foreign = [name for name in given if name not in (*family.tables, *family.more)]
        wrong = [f"{name} is missing" for name in missing]
        wrong += [f"{name} is given, of another family: leave it out" for name in foreign]
        allowed = ", ".join(f"{t} (optional)" if t == force else t for t in family.tables)
        raise InputError(
            f"a batch of family {self.family!r}: {'; '.join(wrong)}; "
            f"its arrays are length, {allowed}"
        )

    def _varies_by_force(self, tables: dict[str, Array]) -> bool:
        """Tell whether all beams are of one structure, and only an axial force tells them apart."""
        force = FAMILIES[self.family].columns.get("axial_force")
        return bool(force) and all(_rows(v) == 1 for name, v in tables.items() if name != force)

    def __len__(self) -> int:
        return len(getattr(self, FAMILIES[self.family].stiffness))


_TABLES = tuple(dict.fromkeys(name for family in FAMILIES.values() for name in family.tables))


_AVERAGES = "force_over_shear", "force_squared_over_shear"
_MORE = (
    "shear_stiffness",
    "rotary_inertia_per_length",
    "foundation_stiffness",
    "added_mass_per_length",
)
_BY_ITSELF = "length", *_MORE, *_AVERAGES
"""Arrays that may have a single row beside others with one for each beam."""


def _rows(values: Array) -> int:
    return len(values) if values.ndim > 1 else 1


def _common_shape(tables: dict[str, Array]) -> tuple[int, int]:
    """Return how many beams and segments the arrays of a batch describe."""
    sizes = [(_rows(values), values.shape[-1] if values.ndim else 1) for values in tables.values()]
    rows, n = map(max, zip(*sizes, strict=True))
    for (name, values), (own, columns) in zip(tables.items(), sizes, strict=True):
        apart = columns not in (1, n) or (name == "length" and values.ndim and columns != n)
        if values.ndim > 2 or own not in (1, rows) or apart or not n:
            told = ", ".join(f"{key} {v.shape}" for key, v in tables.items())
            raise InputError(
                "the arrays of a batch have shapes (segments,) or (beams, segments); "
                f"received {told}"
            )
    return rows, n


@dataclass(frozen=True, eq=False)
class BatchResult(ByValue):
    """Elastic modes of one family of every beam of a batch, each with its certificate.

    Attributes
    ----------
    omega2 : array, shape (beams, modes)
        [rad^2/s^2]; NaN where a beam could not be solved.
    bracket_omega2 : array, shape (beams, modes, 2)
        Encloses the eigenvalue, rounding included [rad^2/s^2].
    counts : array of int, shape (beams, modes, 2)
        Number of eigenvalues, rigid ones included, below either end of the bracket.
    error_omega2 : array, shape (beams, modes)
        Distance to the farther end of the bracket [rad^2/s^2].
    reason : array of int, shape (beams,)
        0, or an index of `REASONS`: why a beam has no omega^2, or what becomes of its motion. Past
        buckling omega^2 is negative, and its frequency NaN. Past flutter a beam has its numbers:
        omega^2 of a pair is the square of its frequency, stated twice, the member that decays
        before the one that grows.
    evaluations : array of int, shape (beams,)
        How often the chain was evaluated.
    growth_rate_per_s : array, shape (beams, modes)
        Re s [1/s] of divergent modes and of pairs that flutter; NaN of all others.
    """

    omega2: Array
    bracket_omega2: Array
    counts: Integers
    error_omega2: Array
    reason: Integers
    evaluations: Integers
    growth_rate_per_s: Array

    @property
    def frequencies_hz(self) -> Array:
        """Natural frequencies [Hz], shape (beams, modes); NaN where omega^2 < 0 or unknown."""
        return hertz(self.omega2)

    @property
    def error_hz(self) -> Array:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        return error_hz(self.omega2, self.error_omega2)

    def why(self, beam: int) -> str:
        """Return the words of its `reason`; empty where all its modes oscillate steadily."""
        return REASONS[self.reason[beam]]

    def __len__(self) -> int:
        return len(self.omega2)


def solve_many(
    batch: BeamBatch, *, backend: BackendName = "auto", width: float = NARROW
) -> BatchResult:
    """Compute the natural frequencies of every beam of a batch, with brackets and counts.

    Parameters
    ----------
    batch : BeamBatch
    backend : {"auto", "numpy", "numba"}
        What solves: compiled code, or numpy, which takes some milliseconds a beam. "auto" is numba.
    width : float
        Relative width of the brackets in omega^2 at most, 1e-10 to 1e-6. Wide ones take a tenth
        to a third fewer evaluations; omega^2 itself, the secant of its bracket, is mostly as near.

    Returns
    -------
    BatchResult
        A beam that fails has NaN and a reason; the others are not touched by it.
    """
    wanted("the batch", batch, BeamBatch, "BeamBatch([1.0], [1.0], [1.0], [0.0])")
    solver = choose(backend)
    width = _BEFORE_ROUNDING * within("width", width, 1e-10, 1e-6, " (relative, of brackets)")
    found = _solve(solver, batch, width)
    omega2, low, high, counts, rounding, reason, evaluations = found
    pairs: Growing = {}
    steady = not np.count_nonzero(reason) and omega2.min() >= 0.0 and np.isfinite(high).all()
    if not steady:
        pairs = _settle(solver, batch, width, found)
    bracket = np.empty((*omega2.shape, 2))
    low = np.subtract(low, rounding, out=bracket[..., 0])
    high = np.add(high, rounding, out=bracket[..., 1])
    if np.count_nonzero(low[:, 1:] <= high[:, :-1]):
        for row in np.flatnonzero(np.any(low[:, 1:] <= high[:, :-1], axis=1)):
            share_brackets(low[row], high[row], counts[row])
    error = np.maximum(high - omega2, omega2 - low)
    if steady:
        growth = np.full(omega2.shape, np.nan)
        return BatchResult(omega2, bracket, counts, error, reason, evaluations, growth)
    omega2, error = settled(omega2, error)
    reason[(reason == PAST_BUCKLING) & (omega2[:, 0] >= 0)] = 0
    growth = growth_rate(omega2)
    for beam, rates in pairs.items():
        growth[beam] = np.where(rates == 0.0, growth[beam], rates)
    return BatchResult(omega2, bracket, counts, error, reason, evaluations, growth)


def predict_many(batch: BeamBatch, width: float) -> Array:
    """Return omega^2 of every beam, for numbers that are only compared with them.

    Each is enclosed by counts, or by signs where ends follow, and predicted to a tenth of `width`:
    no certificate is made. NaN where `solve_many` is to be asked.
    """
    found = _solve(choose("numba"), batch, width, proven=False)
    return np.where(found.reason[:, None] == 0, found.omega2, np.nan)


def _settle(solver: Backend, batch: BeamBatch, width: float, found: ChainRoots) -> Growing:
    """Solve again, by itself, what failed and may not; set the reasons, NaN where one stays.

    Returns how fast modes grow where they flutter.
    """
    pairs: Growing = {}
    omega2, low, high, counts, _, reason, _ = found
    if translates(
        batch.ends, batch.family
    ):  # past buckling its omega^2 = 0 lies above an elastic mode
        reason[(reason == 0) & (omega2[:, 0] < 0)] = NOT_BRACKETED
    reason[(reason == 0) & ~np.isfinite(high).all(axis=1)] = NOT_FINITE
    for row in np.flatnonzero(np.isin(reason, _ALONE)):
        reason[row] = _alone(solver, batch, int(row), width, found, pairs)
    failed = (reason != 0) & (reason != FLUTTERS)
    omega2[failed], low[failed], high[failed], counts[failed] = np.nan, np.nan, np.nan, -1
    reason[(omega2[:, 0] < 0) & (reason != FLUTTERS)] = PAST_BUCKLING
    return pairs


def _solve(solver: Backend, batch: BeamBatch, width: float, *, proven: bool = True) -> ChainRoots:
    """Solve chain after chain; where loads alone vary, by guesses from a few of them."""
    below, chains = _rigid(batch), _chains(batch)
    guess = None
    if batch._one_structure and chains.more is None and solver.name != "numpy":
        guess = guess_omega2(_forces(chains), lambda forces: _exact(batch, chains, forces))
    if guess is None:
        return solver.solve_chains(chains, below, batch.modes, width, proven=proven)
    found = solver.certify_guesses(chains, guess, below, width)
    again = np.flatnonzero(found.reason)
    if len(again):
        part = solver.solve_chains(chains.some(again), below, batch.modes, width)
        part.evaluations[:] += found.evaluations[again]
        for values, others in zip(found, part, strict=True):
            values[again] = others
    return found


def _rigid(batch: BeamBatch) -> int:
    """Return how many rigid modes every beam of the batch has: a foundation leaves none."""
    bed = batch.foundation_stiffness
    return 0 if bed is not None and np.any(bed) else rigid_modes_of(batch.ends, batch.family)


def _chains(batch: BeamBatch) -> Chains:
    """Return the beams as chains; where a law has no axial force, it is zero."""
    family = FAMILIES[batch.family]
    columns = {name: getattr(batch, table) for name, table in family.columns.items()}
    m, stiffness = columns["mass"], columns["stiffness"]
    N = columns["axial_force"] if family.law.has_axial_force else np.zeros(m.shape)
    ends = batch.ends.of(batch.family)
    more = _more(batch, N)
    if batch.added_mass_per_length is not None:
        m = m + batch.added_mass_per_length
    return Chains(family.law, batch.length, m, stiffness, N, *ends, _following(batch, N), more)


def _following(batch: BeamBatch, N: Array) -> Array | None:
    """Return what turns with the ends of every beam [N], None where nothing does."""
    shares = batch.ends.follow
    if not FAMILIES[batch.family].law.has_axial_force:
        return None
    if batch.following is None:
        return np.ascontiguousarray(np.array(shares) * N[:, [0, -1]]) if any(shares) else None
    return np.ascontiguousarray(np.broadcast_to(batch.following, (len(N), 2)), dtype=float)


def _more(batch: BeamBatch, N: Array) -> dict[str, Array] | None:
    """Return what segments have besides, a single row where it is the same for all beams."""
    kGA, columns = batch.shear_stiffness, dict[str, Array]()
    if kGA is not None:
        with np.errstate(divide="ignore", invalid="ignore"):
            columns["shear"] = 1.0 / (kGA - N if batch.shear_form == "engesser" else kGA)
    if batch.rotary_inertia_per_length is not None:
        columns["rotary_inertia"] = batch.rotary_inertia_per_length
    if batch.foundation_stiffness is not None:
        columns["foundation"] = batch.foundation_stiffness
    if not columns:
        return None
    if batch.force_over_shear is not None and batch.force_squared_over_shear is not None:
        columns["shear_turn"] = batch.force_over_shear
        columns["shear_work"] = batch.force_squared_over_shear
    none = np.zeros((1, N.shape[1]))
    return {"shear": none, "rotary_inertia": none, "foundation": none} | columns


def _forces(chains: Chains) -> Array:
    """Return N of every segment, and what turns with the ends beside it, shape (chains, ...)."""
    if chains.following is None:
        return chains.axial_force
    return np.concatenate([chains.axial_force, chains.following], axis=1)


def _exact(batch: BeamBatch, chains: Chains, forces: Array) -> Array:
    """Return omega^2 of the batch's structure under other forces, NaN where it is not certain."""
    family, n = FAMILIES[batch.family], chains.axial_force.shape[1]
    force, following = forces[:, :n], forces[:, n:] if chains.following is not None else None
    structure = {name: getattr(batch, name)[0] for name in ("length", *family.tables)}
    told = structure | {family.columns["axial_force"]: force, "following": following}
    some = replace(batch, **told)
    object.__setattr__(some, "_one_structure", False)
    return solve_many(some).omega2


def _alone(
    solver: Backend,
    batch: BeamBatch,
    row: int,
    width: float,
    results: ChainRoots,
    pairs: Growing,
) -> int:
    """Solve a beam by itself; return the reason if it cannot be solved.

    Modes that nearly coincide are parted by frames; past buckling an elastic mode lies below the
    translation, whose omega^2 = 0 is set aside.
    """
    below, chain = _rigid(batch), _chains(batch)[row]
    if not _is_valid(chain):
        return INVALID
    zeros = zeros_of(batch.ends, chain) if below else 0
    try:
        found = eigenvalues_alone(solver, chain, below + batch.modes, zeros, width, below)
        if not check_certificate(found):
            return NOT_BRACKETED
        wanted = elastic(found, below, chain)[: batch.modes]
        rounding = rounding_by_shapes(solver, chain, wanted)
    except FloatingPointError:
        return OUT_OF_REACH
    except (CountingError, ArithmeticError):
        return NOT_BRACKETED
    moved = np.array([v.order - v.omega2 for v in wanted])
    results.omega2[row] = [v.order for v in wanted]
    results.low[row], results.high[row] = np.transpose([v.bracket for v in wanted]) + moved
    results.counts[row], results.rounding[row] = [v.counts for v in wanted], rounding
    if not moved.any():
        return 0
    pairs[row] = np.array([-v.imaginary / (2 * np.sqrt(abs(v.order))) for v in wanted])
    return FLUTTERS


def _is_valid(chain: Chain) -> bool:
    """Tell whether lengths, masses and stiffnesses are positive, and all is finite."""
    structure = np.concatenate([chain.length, chain.mass, chain.stiffness])
    if "shear_turn" in chain.columns:
        c = chain.columns
        structure = np.append(structure, [np.min(1 + c["shear_turn"]), np.min(c["shear"] + 1e-300)])
    finite = all(np.all(np.isfinite(values)) for values in (structure, *chain.columns.values()))
    return bool(finite and np.all(structure > 0))


def rounding_by_shapes(solver: Backend, chain: Chain, found: list[Eigenvalue]) -> Array:
    """Return the rounding of omega^2 [rad^2/s^2]: small against the energies that make it."""
    omega2 = np.array([value.value for value in found])
    fine = split_for(chain, np.abs(omega2))
    if chain.follows:
        one = np.ones(len(found), np.int64)
        both = two_sided_energies(solver, fine, solver.mode_states(fine, omega2, one), omega2)
        return np.asarray(ROUNDING * cancelling(both.size.real, np.abs(both.mass), omega2))
    together = np.array([sum(other.bracket == v.bracket for other in found) for v in found])
    energies = solver.mode_energies(fine, solver.mode_states(fine, omega2, together), omega2)
    return ROUNDING * cancelling(energies.size, energies.mass, omega2)
