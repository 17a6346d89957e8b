"""Cross-sections of PBARL and PBEAML against their outlines as the manuals draw them."""

import numpy as np
import pytest

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
    assert cross_section("ROD", [2.0]) == pytest.approx((*[4 * np.pi] * 3, 0, 8 * np.pi))
    tube = np.pi * (0.1**2 - 0.09**2), np.pi / 4 * (0.1**4 - 0.09**4)
    for kind, dimensions in (("TUBE", [0.1, 0.09]), ("TUBE2", [0.1, 0.01])):
        assert cross_section(kind, dimensions) == pytest.approx((*tube, tube[1], 0, 2 * tube[1]))


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
