"""The beam: what every vibration problem of antinode becomes, and all that the solver needs.

Properties are given on intervals between breakpoints by their values at both ends of the interval
and vary between them linearly or logarithmically (the axial force always linearly), or are
polynomials by their control values (`beam.curves`): what follows from a drawing is. N > 0 is
compression; x runs from the left end (the nose) to the right.

A chain of uniform segments represents an interval exactly when nothing varies in it. Elsewhere each
step is two uniform half-segments whose 1/EI, m and N are averages of the values at the two Gauss
points with weights 1/2 +- sqrt(3)/3, the larger for the nearer point: fourth order in the step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import ByValue, owned
from antinode.arrays import Array, Integers, Interpolation, distinct
from antinode.errors import InputError
from antinode.methods import BeamMethods
from antinode.riccati.chain import Chain
from antinode.riccati.points import Point

from . import curves
from .attachments import (
    Attachment,
    PointMass,
    check_attachments,
    check_kinds,
    gather,
    on_beam,
    springs_hold,
)
from .checks import LOGARITHMIC, TABLES, ShearForm, Theory, check, varying
from .ends import FREE, Ends, lateral_freedoms
from .families import BENDING, FAMILIES, FamilyName, tells
from .loads.turning import with_their_force
from .mass import moments_of_part, shifted
from .profile import AT_START, interpolated
from .representation import make_chain
from .reversal import reversed_beam
from .stations import as_column, tables_at_stations, tables_of

if TYPE_CHECKING:
    from .rotation import Rotation
    from .sections.drawing import Drawing


@dataclass(frozen=True, eq=False, repr=False)
class Beam(BeamMethods, ByValue):
    """A straight non-uniform beam under static axial force: Euler-Bernoulli's or Timoshenko's.

    Parameters
    ----------
    x : array_like, shape (n + 1,)
        Stations from left to right [m]; they are the breakpoints. Two rows at one x are a jump.
    mass_per_length, bending_stiffness : array_like
        m [kg/m] and EI [N m^2], positive. One number for the whole beam; one for each station,
        shape (n + 1,); with "step" also one for each interval, (n,); or a table of the intervals:
        values at their left and right ends, (n, 2), or control values of polynomials, (n, p + 1).
        All other columns likewise. Texts carry their units, ``["3 kg/m", "2.5 kg/m"]``, as do
        columns of pandas and xarray (``attrs["units"]``) and quantities of pint.
    axial_stiffness : array, shape (n, 2), optional
        EA [N]; without it there are no longitudinal modes.
    axial_force : array, shape (n, 2), optional
        N [N], compression positive, linear in each interval; zero by default.
    axial_acceleration : float
        a [m/s^2] adds ``a * (mass left of x)`` to N: the inertia of a body that accelerates
        towards -x, or weight that acts towards +x.
    interpolation : {"step", "linear", "log"}
        How m, EI, EA, kGA and GJ vary between the two values of an interval ("step": they are
        equal); the others vary linearly.
    ends : Ends
    radius_of_gyration : array, shape (n, 2), optional
        Of the cross-section [m], for rotary inertia; where only the effect of that is estimated,
        by default sqrt(EI/EA).
    torsional_stiffness, polar_inertia_per_length : array, shape (n, 2), optional
        GJ [N m^2] and rho I_p [kg m], both or neither; without them there are no torsion modes.
    shear_stiffness : array, shape (n, 2), optional
        kGA [N], positive or inf; rigid in shear by default.
    rotary_inertia_per_length : array, shape (n, 2), optional
        rho I [kg m], of the section about its lateral axis; by default m times the square of
        `radius_of_gyration`, if that is given and the theory is Timoshenko's, else none.
    foundation_stiffness : array, shape (n, 2), optional
        Of an elastic foundation, lateral [N/m^2].
    added_mass_per_length : array, shape (n, 2), optional
        Of water that moves with Y [kg/m]: no weight, no inertia along the axis.
    tangential_load : array, shape (n, 2), optional
        The part of dN/dx by loads along the beam that turn with its section [N/m], along +x; N
        holds what they leave. `from_stations` works N out of it and of what holds the ends along
        the axis where no `axial_force` is given.
    loss_factor : array, shape (n, 2), optional
        Of EI, kGA, EA and GJ: for responses and complex modes.
    theory : {"euler_bernoulli", "timoshenko"}, optional
        Default: Timoshenko's where `shear_stiffness` or `rotary_inertia_per_length` is given.
        Euler-Bernoulli's leaves both out.
    shear_form : {"haringx", "engesser"}
        How the axial force and shear meet.
    attachments : tuple of PointMass, Spring and Joint
        At breakpoints; `with_attachments` makes the breakpoints.
    offset_weight : bool
        Whether the part of N that the axial acceleration makes of an offset point mass acts
        through its own centre, and so bends the beam when it turns.
    end_force : tuple of float, optional
        The forces at the left and right end of which `ends` lets a share turn [N], compression
        positive; by default N there, outside what is attached to the end.
    name : str
    drawing : Drawing, optional
        What mass and stiffness follow from (`beam.sections`), for those who show or write the beam;
        the solver reads the tables alone.
    rotation : Rotation, optional
        Whose centrifugal force and softening stand in the tables (`beam.rotation`): those of a beam
        that bends in the plane of rotation may be softer than nothing.
    left_out : tuple of str
        What acts on it in truth and the model leaves out, for those who show its modes.

    Raises
    ------
    InputError
        If shapes disagree, stations do not increase, the last row of a stepped column would be
        lost, a property is not positive and finite, an attachment is not at a breakpoint, a value
        is masked, a text is no number of that unit, or a word is not one of those allowed.

    Notes
    -----
    Immutable: it owns its arrays, compares by value, and has a hash. However a column was given,
    the beam keeps it as a table of the intervals, (n, 2) or (n, p + 1).
    """

    x: Array
    mass_per_length: Array
    bending_stiffness: Array
    axial_stiffness: Array | None = None
    axial_force: Array = field(default_factory=lambda: np.zeros(0))
    axial_acceleration: float = 0.0
    interpolation: Interpolation = "step"
    ends: Ends = FREE
    radius_of_gyration: Array | None = None
    torsional_stiffness: Array | None = None
    polar_inertia_per_length: Array | None = None
    shear_stiffness: Array | None = None
    rotary_inertia_per_length: Array | None = None
    foundation_stiffness: Array | None = None
    added_mass_per_length: Array | None = None
    loss_factor: Array | None = None
    tangential_load: Array | None = None
    theory: Theory | None = None
    shear_form: ShearForm = "haringx"
    attachments: tuple[Attachment, ...] = ()
    offset_weight: bool = True
    end_force: tuple[float, float] | None = None
    name: str = "beam"
    drawing: Drawing | None = None
    rotation: Rotation | None = None
    left_out: tuple[str, ...] = ()

    if TYPE_CHECKING:  # what the fields are made of

        def __init__(
            self,
            x: npt.ArrayLike,
            mass_per_length: npt.ArrayLike,
            bending_stiffness: npt.ArrayLike,
            axial_stiffness: npt.ArrayLike | None = None,
            axial_force: npt.ArrayLike = (),
            axial_acceleration: float = 0.0,
            interpolation: Interpolation = "step",
            ends: Ends = FREE,
            radius_of_gyration: npt.ArrayLike | None = None,
            torsional_stiffness: npt.ArrayLike | None = None,
            polar_inertia_per_length: npt.ArrayLike | None = None,
            shear_stiffness: npt.ArrayLike | None = None,
            rotary_inertia_per_length: npt.ArrayLike | None = None,
            foundation_stiffness: npt.ArrayLike | None = None,
            added_mass_per_length: npt.ArrayLike | None = None,
            loss_factor: npt.ArrayLike | None = None,
            tangential_load: npt.ArrayLike | None = None,
            theory: Theory | None = None,
            shear_form: ShearForm = "haringx",
            attachments: Sequence[Attachment] = (),
            offset_weight: bool = True,
            end_force: tuple[float, float] | None = None,
            name: str = "beam",
            drawing: Drawing | None = None,
            rotation: Rotation | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        columns = {n: v for n in TABLES if (v := getattr(self, n)) is not None}
        if not np.size(self.axial_force):
            del columns["axial_force"]
        x, tables = tables_of(self.x, columns, self.interpolation)
        tables.setdefault("axial_force", np.zeros((len(x) - 1, 2)))
        for name, values in {"x": x, **tables}.items():
            object.__setattr__(self, name, owned(name, values))
        check(self)

    @classmethod
    def from_stations(
        cls,
        x: npt.ArrayLike,
        mass_per_length: npt.ArrayLike,
        bending_stiffness: npt.ArrayLike,
        axial_stiffness: npt.ArrayLike | None = None,
        axial_force: npt.ArrayLike | None = None,
        *,
        interpolation: Interpolation = "step",
        ends: Ends | None = None,
        theory: Theory | None = None,
        shear_form: ShearForm = "haringx",
        name: str = "beam",
        **columns: npt.ArrayLike | None,
    ) -> Beam:
        """Build a beam from values at stations.

        Parameters
        ----------
        x : array_like, shape (n + 1,)
            Stations [m]; two rows at one x are a jump, unless "step".
        mass_per_length, bending_stiffness, axial_stiffness, axial_force
            Values at the stations, shape (n + 1,) [kg/m, N m^2, N, N]. With "step" row k holds
            from x_k to x_k+1 and the last row only closes the table (shape (n,) is accepted too).
        interpolation, ends, theory, shear_form, name
            As they are of the beam.
        **columns
            The beam's other tables in the same way: `radius_of_gyration`, `torsional_stiffness`
            and `polar_inertia_per_length`, `shear_stiffness`, `rotary_inertia_per_length`,
            `foundation_stiffness`, `added_mass_per_length`, `loss_factor`, `tangential_load`.
        """
        if unknown := [name for name in columns if name not in TABLES]:
            raise TypeError(f"a beam has no column {unknown[0]!r}; it may have {', '.join(TABLES)}")
        columns |= {"axial_stiffness": axial_stiffness, "axial_force": axial_force}
        columns |= {"mass_per_length": mass_per_length, "bending_stiffness": bending_stiffness}
        given = {column: values for column, values in columns.items() if values is not None}
        if not {"mass_per_length", "bending_stiffness"} <= given.keys():
            raise InputError("mass_per_length and bending_stiffness are needed at every station")
        stations, tables = tables_at_stations(as_column("x", x), given, interpolation)
        made = cls(
            stations,
            **tables,
            interpolation=interpolation,
            ends=ends or FREE,
            theory=theory,
            shear_form=shear_form,
            name=name,
        )
        return with_their_force(made) if made.loads_turn and axial_force is None else made

    @property
    def length(self) -> float:
        """Length [m]."""
        return float(self.x[-1] - self.x[0])

    @cached_property
    def mass(self) -> float:
        """Total mass [kg], point masses included."""
        return float(self.mass_left[-1])

    @cached_property
    def mass_left(self) -> Array:
        """Mass left of every breakpoint and at it [kg], shape (n + 1,)."""
        n = len(self.x) - 1
        whole = self._mass_of_part(np.arange(n), np.ones(n))
        points = np.zeros(len(self.x))
        for item in self.attachments:
            if isinstance(item, PointMass):
                points[self._breakpoint(item.x)] += item.mass
        return np.concatenate([[0.0], np.cumsum(whole)]) + np.cumsum(points)

    def mass_left_of(self, interval: Integers | slice, fraction: Array) -> Array:
        """Return the mass left of places inside intervals [kg]."""
        return np.asarray(self.mass_left[interval] + self._mass_of_part(interval, fraction))

    def _mass_of_part(self, interval: Integers | slice, fraction: Array) -> Array:
        m, length = self.mass_per_length[interval], np.diff(self.x)[interval]
        return moments_of_part(m, length, fraction, self.interpolation, most=0)[0]

    def _breakpoint(self, x: float) -> int:
        return int(np.argmin(np.abs(self.x - x)))

    def with_breakpoints(self, positions: Sequence[float]) -> Beam:
        """Return the same beam with breakpoints at the given positions [m] as well."""
        inside = [p for p in positions if np.min(np.abs(self.x - p)) > 1e-12 * self.length]
        return self.cut_at(inside) if inside else self

    def cut_at(self, inside: Sequence[float]) -> Beam:
        """Return the same beam with breakpoints at places inside intervals [m] as well."""
        x = distinct(np.append(self.x, inside))
        k = np.clip(np.searchsorted(self.x, (x[1:] + x[:-1]) / 2) - 1, 0, len(self.x) - 2)
        size = np.diff(self.x)[k]
        start, end = (x[:-1] - self.x[k]) / size, (x[1:] - self.x[k]) / size
        tables: dict[str, Any] = {}
        for name in TABLES:
            values = getattr(self, name)
            if values is not None and values.shape[1] > 2:
                tables[name] = curves.part(values[k], start, end)
            elif values is not None:
                sides = (self.column_at(name, k, start), self.column_at(name, k, end))
                tables[name] = np.stack(sides, axis=1)
        return replace(self, x=x, **tables)

    def with_attachments(self, *attachments: Attachment) -> Beam:
        """Return the beam with point masses, springs and joints added, and breakpoints for them."""
        check_kinds(attachments)
        attachments = tuple(replace(item, x=on_beam(item.x, self.x)) for item in attachments)
        check_attachments(attachments, self.x)
        beam = self.with_breakpoints([item.x for item in attachments])
        return replace(beam, attachments=(*self.attachments, *attachments))

    @cached_property
    def moment_of_inertia(self) -> float:
        """Moment of inertia about the centre of mass [kg m^2], point masses included."""
        x, h = (self.x - self.x[0])[:-1], np.diff(self.x)
        parts = moments_of_part(self.mass_per_length, h, np.ones(len(h)), self.interpolation)
        J0, J1, J2 = (float(np.sum(part)) for part in shifted(x, *parts))
        masses = [item for item in self.attachments if isinstance(item, PointMass)]
        dm = np.array([J0, *(item.mass for item in masses)])
        at = np.array([J1 / J0, *(item.x + item.offset - self.x[0] for item in masses)])
        centre = np.sum(dm * at) / np.sum(dm)
        own = J2 - J1 * J1 / J0 + sum(item.rotary_inertia for item in masses)
        return float(own + np.sum(dm * (at - centre) ** 2))

    def column_at(self, name: str, interval: Integers | slice, fraction: Array) -> Array:
        """Return a table's values inside intervals, at fractions 0 ... 1 of their lengths.

        What no logarithm is for runs straight, or by its control values.
        """
        values: Array = getattr(self, name)
        if fraction is AT_START:
            return values[interval, 0]
        if values.shape[1] > 2:
            return curves.value(values[interval], fraction)
        a, b = values[interval, 0], values[interval, 1]
        how = self.interpolation if name in LOGARITHMIC else "linear"
        if name != "shear_stiffness":
            return np.asarray(interpolated(a, b, fraction, how))
        rigid = np.isinf(a)
        a, b = np.where(rigid, 1.0, a), np.where(rigid, 1.0, b)
        return np.where(rigid, np.inf, interpolated(a, b, fraction, how))

    @property
    def is_timoshenko(self) -> bool:
        """Whether shear and rotary inertia count, as far as they are given."""
        given = self.shear_stiffness is not None or self.rotary_inertia_per_length is not None
        return given if self.theory is None else self.theory == "timoshenko"

    @property
    def has_shear(self) -> bool:
        """Whether a flexibility in shear counts."""
        return self.is_timoshenko and self.shear_stiffness is not None

    def axial_force_at(self, interval: Integers | slice, fraction: Array) -> Array:
        """Return N [N] inside intervals, at fractions 0 ... 1 of their lengths."""
        N = self.column_at("axial_force", interval, fraction)
        if self.axial_acceleration == 0.0:
            return np.asarray(N)
        return np.asarray(N + self.axial_acceleration * self.mass_left_of(interval, fraction))

    @cached_property
    def is_curved(self) -> bool:
        """Whether a table holds control values of polynomials."""
        tables = (getattr(self, name) for name in TABLES)
        return any(table is not None and table.shape[1] > 2 for table in tables)

    @cached_property
    def is_unloaded(self) -> bool:
        """Whether no axial force acts anywhere."""
        forces = np.any(self.axial_force) or self.loads_turn
        return self.axial_acceleration == 0.0 and not forces

    @property
    def loads_turn(self) -> bool:
        """Whether loads along the beam turn with its section."""
        return self.tangential_load is not None and bool(np.any(self.tangential_load))

    def without_axial_force(self) -> Beam:
        """Return the same beam with N = 0 everywhere."""
        none = np.zeros_like(self.axial_force)
        no_load = {"axial_acceleration": 0.0, "end_force": None, "tangential_load": None}
        return replace(self, axial_force=none, **no_load)  # type: ignore[arg-type]

    def reversed(self) -> Beam:
        """Return the beam read from the other end.

        What stands at a joint moves with the joint's left side. Where that matters it stands, read
        from the other end, on a breakpoint of its own a few roundings to the right of the joint.

        Raises
        ------
        InputError
            If it accelerates.
        """
        return reversed_beam(self)

    @property
    def families(self) -> tuple[FamilyName, ...]:
        """The families of modes for which the beam has all columns."""
        return tuple(name for name in FAMILIES if tells(self, name))

    def varies(self, family: FamilyName) -> npt.NDArray[np.bool_]:
        """Tell for each interval whether anything that the family sees varies inside it."""
        if family not in self._known_varying:
            self._known_varying[family] = varying(self, family)
        return self._known_varying[family]

    @cached_property
    def _known_varying(self) -> dict[FamilyName, npt.NDArray[np.bool_]]:
        return {}

    def chain(self, family: FamilyName, refinement: int = 1) -> Chain:
        """Represent the beam by uniform segments for one family of modes.

        Parameters
        ----------
        family : {"bending", "longitudinal", "torsion"}
        refinement : int
            Number by which the steps of the coarsest representation are divided; intervals in
            which nothing varies stay whole: they are exact.

        Returns
        -------
        Chain
        """
        return make_chain(self, family, refinement)

    def following(self, family: FamilyName = BENDING) -> tuple[float, float]:
        """Return the part of the force at either end that turns with it [N].

        It is a share of N outside what is attached to the end.
        """
        shares = self.ends.follow
        if not FAMILIES[family].law.has_axial_force or not any(shares):
            return 0.0, 0.0
        outside = self.end_forces
        return shares[0] * outside[0], shares[1] * outside[1]

    @property
    def end_forces(self) -> tuple[float, float]:
        """The forces at both ends [N], outside what is attached there."""
        if self.end_force is not None:
            return self.end_force
        table, a = self.axial_force, self.axial_acceleration
        return float(table[0, 0]), float(table[-1, -1]) + a * self.mass

    def points(
        self, family: FamilyName, first: Integers | None = None
    ) -> tuple[str, str, tuple[Point, ...]]:
        """Return the ends with their supports, and the points at nodes of a chain.

        `first` is the node of every breakpoint: its number, unless given.
        """
        if first is None:
            first = np.arange(len(self.x))
        acceleration = self.axial_acceleration if self.offset_weight else 0.0
        points = gather(self.attachments, self.x, family, acceleration)
        ends, law = list(self.ends.of(family)), FAMILIES[family].law
        for side, k in ((0, 0), (1, len(self.x) - 1)):
            if k in points:
                ends[side] = law.end_holding(ends[side], points[k].holds)
                points[k] = replace(points[k], holds=())
        kept = tuple(replace(p, node=int(first[k])) for k, p in points.items())
        return ends[0], ends[1], kept

    def freedoms(self, family: FamilyName) -> Array:
        """Return the rigid motions that nothing holds.

        Returns
        -------
        array, shape (freedoms, 2)
            Rows [a, b] of motions ``a + b (x - x[0])``; with one freedom only [1, 0] can occur.
        """
        if family not in self._known_freedoms:
            self._known_freedoms[family] = self._find_freedoms(family)
        return self._known_freedoms[family]

    @cached_property
    def _known_freedoms(self) -> dict[FamilyName, Array]:
        return {}

    def _find_freedoms(self, family: FamilyName) -> Array:
        if any(np.any(getattr(self, name)) for name in FAMILIES[family].holding(self)):
            return np.zeros((0, 2))
        left, right, points = self.points(family)
        law = FAMILIES[family].law
        held = [(0.0, law.ends[left]), (self.length, law.ends[right])]
        for point in points:
            place, holds = springs_hold(point)
            held.append((float(self.x[point.node] - self.x[0]) + place, holds))
        if law.size == 2:
            return np.zeros((0, 2)) if any(rows for _, rows in held) else np.array([[1.0, 0.0]])
        places = {x for x, components in held if 0 in components}
        return lateral_freedoms(places, any(1 in components for _, components in held))
