"""Cross-sections of PBARL and PBEAML against their outlines as the manuals draw them."""

import numpy as np
import pytest
from scipy.sparse import coo_array, eye_array
from scipy.sparse.linalg import spsolve

from antinode.exchange.nastran.cross_sections import DIMENSIONS, cross_section


def box(b, h, y=0.0, z=0.0):
    """The outline of a rectangle, (z, y)."""
    return [
        (z - b / 2, y - h / 2),
        (z + b / 2, y - h / 2),
        (z + b / 2, y + h / 2),
        (z - b / 2, y + h / 2),
    ]


def mirrored(half):
    """The outline of a section that is alike left and right, from its right half upwards."""
    return half + [(-z, y) for z, y in reversed(half)]


# Type: dimensions, outline, holes; z to the right, y up.
OUTLINES = {
    "BAR": ([4, 7], box(4, 7), []),
    "BOX": ([50, 80, 6, 4], box(50, 80), [box(42, 68)]),
    "BOX1": ([50, 80, 6, 7, 4, 5], box(50, 80), [box(41, 67, 0.5, -0.5)]),
    # web at 30: cells 0+5..28 and 32..80-6 wide, of walls 7, 8 and 9, 10
    "DBOX": (
        [80, 60, 30, 5, 4, 6, 7, 8, 9, 10],
        box(80, 60),
        [box(23, 45, 0.5, 5 + 11.5 - 40), box(42, 41, 0.5, 32 + 21 - 40)],
    ),
    "I": (
        [100, 50, 70, 5, 8, 6],
        mirrored([(25, 0), (25, 8), (2.5, 8), (2.5, 94), (35, 94), (35, 100)]),
        [],
    ),
    "I1": (
        [50, 6, 80, 100],
        mirrored([(28, 0), (28, 10), (3, 10), (3, 90), (28, 90), (28, 100)]),
        [],
    ),
    "CHAN": (
        [40, 90, 5, 7],
        [(0, 0), (40, 0), (40, 7), (5, 7), (5, 83), (40, 83), (40, 90), (0, 90)],
        [],
    ),
    "CHAN1": (
        [40, 6, 80, 100],
        [(0, 0), (46, 0), (46, 10), (6, 10), (6, 90), (46, 90), (46, 100), (0, 100)],
        [],
    ),
    "CHAN2": ([6, 8, 60, 90], mirrored([(45, 0), (45, 60), (39, 60), (39, 8)]), []),
    "T": ([60, 80, 7, 5], mirrored([(2.5, 0), (2.5, 73), (30, 73), (30, 80)]), []),
    "T1": (
        [60, 80, 7, 5],
        [(0, -30), (7, -30), (7, 30), (0, 30), (0, 2.5), (-80, 2.5), (-80, -2.5), (0, -2.5)],
        [],
    ),
    "T2": ([60, 80, 7, 5], mirrored([(30, 0), (30, 7), (2.5, 7), (2.5, 80)]), []),
    "CROSS": (
        [50, 8, 90, 10],
        mirrored([(4, -45), (4, -5), (29, -5), (29, 5), (4, 5), (4, 45)]),
        [],
    ),
    "H": (
        [50, 20, 90, 6],
        mirrored([(25, -3), (25, -45), (35, -45), (35, 45), (25, 45), (25, 3)]),
        [],
    ),
    "Z": (
        [40, 6, 80, 100],
        [(-3, -50), (43, -50), (43, -40), (3, -40), (3, 50), (-43, 50), (-43, 40), (-3, 40)],
        [],
    ),
    "L": ([60, 80, 5, 7], [(0, 0), (60, 0), (60, 5), (7, 5), (7, 80), (0, 80)], []),
    "HEXA": ([15, 60, 50], [(-30, 0), (-15, -25), (15, -25), (30, 0), (15, 25), (-15, 25)], []),
    "HAT": (
        [50, 4, 60, 20],
        mirrored([(26, 46), (26, 0), (50, 0), (50, 4), (30, 4), (30, 50)]),
        [],
    ),
    "HAT1": (
        [120, 60, 50, 4, 5],
        mirrored([(60, 0), (60, 9), (25, 9), (25, 60)]),
        [mirrored([(21, 5), (21, 56)])],
    ),
}


def moments(outline):
    """Area, first and second moments of a polygon about the origin, by Green's theorem."""
    z, y = np.array(outline, dtype=float).T
    z1, y1 = np.roll(z, -1), np.roll(y, -1)
    cross = z * y1 - z1 * y
    A = np.sum(cross) / 2
    first = np.sum((y + y1) * cross) / 6, np.sum((z + z1) * cross) / 6
    second = (
        np.sum((y**2 + y * y1 + y1**2) * cross) / 12,
        np.sum((z**2 + z * z1 + z1**2) * cross) / 12,
        np.sum((2 * z * y + z * y1 + z1 * y + 2 * z1 * y1) * cross) / 24,
    )
    return np.array([A, *first, *second]) * np.sign(A)


@pytest.mark.parametrize("kind", OUTLINES)
def test_sections_are_those_of_their_outlines(kind):
    dimensions, outline, holes = OUTLINES[kind]
    A, Sy, Sz, Iy, Iz, Iyz = moments(outline) - sum(moments(hole) for hole in holes)
    found = cross_section(kind, dimensions)
    wanted = A, Iy - Sy**2 / A, Iz - Sz**2 / A, abs(Iyz - Sy * Sz / A)
    assert found[:3] == pytest.approx(wanted[:3], rel=1e-12)
    assert abs(found.I12) == pytest.approx(wanted[3], rel=1e-9, abs=1e-9 * wanted[1])


def test_round_sections():
    # Cowper (1966) at nu = 0.3: a circle 0.886; a thin tube 2 (1 + nu)/(4 + 3 nu)
    rod = cross_section("ROD", [2.0])
    assert rod == pytest.approx((*[4 * np.pi] * 3, 0, 8 * np.pi, *[7.8 / 8.8] * 2))
    tube = np.pi * (0.1**2 - 0.09**2), np.pi / 4 * (0.1**4 - 0.09**4)
    for kind, dimensions in (("TUBE", [0.1, 0.09]), ("TUBE2", [0.1, 0.01])):
        found = cross_section(kind, dimensions)
        assert found[:5] == pytest.approx((*tube, tube[1], 0, 2 * tube[1]))
    thin = cross_section("TUBE", [1.0, 0.999], 0.25)
    assert thin.K1 == thin.K2 == pytest.approx(2.5 / 4.75, rel=1e-5)


def test_shear_factors_by_the_stresses_of_a_fine_grid():
    """K = I^2/(A sum S^2/b) over thin slices of the outline's own widths."""
    for kind, (dimensions, outline, holes) in OUTLINES.items():
        for axis, name in ((1, "K1"), (0, "K2")):
            t, b = slices(outline, holes, axis)
            dt, A = t[1] - t[0], np.sum(b) * (t[1] - t[0])
            t = t - np.sum(t * b) / np.sum(b)
            S = np.cumsum(b * t) * dt - b * t * dt / 2
            K = (np.sum(b * t**2) * dt) ** 2 / (A * np.sum(S**2 / b) * dt)
            assert getattr(cross_section(kind, dimensions), name) == pytest.approx(K, rel=3e-3), (
                kind
            )


def slices(outline, holes, axis, count=20_000):
    """Middles of slices across a direction, and the widths that an outline leaves of them."""
    corners = np.array(outline, dtype=float)[:, axis]
    edges = np.linspace(np.min(corners), np.max(corners), count + 1)
    t = (edges[1:] + edges[:-1]) / 2
    return t, width(outline, axis, t) - sum(width(hole, axis, t) for hole in holes)


def width(outline, axis, t):
    points = np.array(outline, dtype=float)
    a, b = points, np.roll(points, -1, axis=0)
    total = np.zeros_like(t)
    for p, q in zip(a, b, strict=True):
        if p[axis] == q[axis]:
            continue
        inside = (t > min(p[axis], q[axis])) & (t < max(p[axis], q[axis]))
        s = (t - p[axis]) / (q[axis] - p[axis])
        total += np.where(
            inside, np.sign(q[axis] - p[axis]) * (p + (q - p) * s[:, None])[:, 1 - axis], 0
        )
    return np.abs(total)


OPEN = ("BAR", "I", "I1", "CHAN", "CHAN1", "CHAN2", "T", "T1", "T2", "CROSS", "H", "Z", "L", "HAT")


@pytest.mark.parametrize("kind", OPEN)
def test_torsion_of_open_sections_by_the_membrane(kind):
    """J = 2 int phi of -laplace(phi) = 2: the sum of rectangles is below it, and not far."""
    dimensions, outline, _ = OUTLINES[kind]
    J, true = cross_section(kind, dimensions).J, membrane(outline)
    assert 0.8 * true < J < 1.03 * true


def membrane(outline, step=0.5):
    """Twice the volume under a membrane over an outline whose corners lie on the grid."""
    points = np.array(outline, dtype=float) - np.min(outline, axis=0)
    if np.max(points) < 20:
        points, step = points * 10, 0.5
        scale = 1e-4
    else:
        scale = 1.0
    n = np.round(np.max(points, axis=0) / step).astype(int)
    z, y = (np.arange(1, k) * step for k in n)
    inside = np.zeros((len(y), len(z)), dtype=bool)
    for j, level in enumerate(y):
        cuts = crossings(points, level)
        for left, right in zip(cuts[::2], cuts[1::2], strict=True):
            inside[j] |= (z > left + 1e-9) & (z < right - 1e-9)
    number = np.full(inside.shape, -1)
    number[inside] = np.arange(np.count_nonzero(inside))
    rows, columns = [], []
    for one, other in ((number[:, :-1], number[:, 1:]), (number[:-1], number[1:])):
        both = (one >= 0) & (other >= 0)
        rows += [one[both], other[both]]
        columns += [other[both], one[both]]
    rows, columns = np.concatenate(rows), np.concatenate(columns)
    size = np.count_nonzero(inside)
    A = 4 * eye_array(size) - coo_array((np.ones(len(rows)), (rows, columns)), shape=(size, size))
    phi = spsolve(A.tocsc(), np.full(size, 2 * step**2))
    return 2 * np.sum(phi) * step**2 * scale


def crossings(points, level):
    """Where a level cuts an outline of horizontal and vertical sides, in order; edges are out."""
    a, b = points, np.roll(points, -1, axis=0)
    low, high = np.minimum(a[:, 1], b[:, 1]), np.maximum(a[:, 1], b[:, 1])
    sides = [np.sort(a[(low < at) & (at < high), 0]) for at in (level - 1e-6, level + 1e-6)]
    if len(sides[0]) == len(sides[1]) and np.allclose(sides[0], sides[1]):
        return sides[0]
    grid = np.arange(0, np.max(points[:, 0]) + 0.25, 0.25) + 0.125
    both = [np.count_nonzero(side[:, None] < grid, axis=0) % 2 == 1 for side in sides]
    inside = np.concatenate([[False], both[0] & both[1], [False]])
    edges = np.flatnonzero(inside[1:] != inside[:-1])
    return edges * 0.25


def test_closed_cells_in_torsion():
    # a square tube of Bredt, a wall between equal cells that carries nothing, and half a cell
    box = cross_section("BOX", [10.0, 10.0, 0.1, 0.1]).J
    assert box == pytest.approx(9.9**3 * 0.1, rel=1e-12)
    assert pytest.approx(box) == cross_section("BOX1", [10.0, 10.0, 0.1, 0.1, 0.1, 0.1]).J
    two = cross_section("DBOX", [20.0, 10.0, 10.0, *[0.1] * 7]).J
    assert two == pytest.approx(cross_section("BOX", [20.0, 10.0, 0.1, 0.1]).J, rel=1e-9)
    hat = cross_section("HAT1", [10.001, 10.0, 10.0, 0.1, 0.1]).J
    assert hat == pytest.approx(box, rel=1e-6)


def test_the_rectangle_in_torsion():
    # square: Timoshenko and Goodier; 1:2 and 1:10 by their table of k1
    for b, h, k in ((1, 1, 0.140577014955), (0.5, 1, 0.229), (2, 0.2, 0.312)):
        J = cross_section("BAR", [b, h]).J
        assert pytest.approx(k * max(b, h) * min(b, h) ** 3, rel=1e-11 if b == h else 2e-3) == J


def test_every_type_is_held_to_something():
    assert set(DIMENSIONS) == {*OUTLINES, "ROD", "TUBE", "TUBE2"}


@pytest.mark.parametrize(
    ("kind", "dimensions"),
    [("TUBE", [1, 2]), ("BOX", [5, 8, 6, 4]), ("I", [10, 5, 5, 1, 6, 6]), ("HEXA", [4, 6, 5])],
)
def test_dimensions_that_do_not_fit(kind, dimensions):
    with pytest.raises(ValueError, match="do not fit"):
        cross_section(kind, dimensions)
