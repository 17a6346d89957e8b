"""One lateral law: uniform beams with shear, rotary inertia, foundation and added mass.

Figures of the tables: own computations in 25 to 40 digits by two independent codes (omega in
sqrt(EI/(m L^4)), r^2 = rho I/(m L^2) = 0.0025, s^2 = EI/(kGA L^2) = 0.0075; foundations k = 1000 on
the first half).
"""

import numpy as np
import pytest

from antinode import (
    Beam,
    BeamBatch,
    Ends,
    InputError,
    natural_frequencies,
    solve_many,
    solve_modes,
)
from antinode.modes.buckling import buckling

ROTARY, SHEAR = 0.0025, 0.0075

SHORT = {  # ends, N: Engesser, Haringx
    ("free", "free", 0.0): 2 * ((20.36561254, 49.12229703, 83.68202280),),
    ("free", "free", 2.0): (
        (18.07715024, 47.30111171, 81.97682612),
        (18.08859255, 47.37670926, 82.17961524),
    ),
    ("clamped", "free", 0.0): 2 * ((3.437549184, 19.17339427, 46.89457404),),
    ("clamped", "free", 2.0): (
        (1.492273104, 17.64348669, 45.55330432),
        (1.493435278, 17.67035197, 45.66512933),
    ),
    ("pinned", "pinned", 0.0): 2 * ((9.423023236, 33.68558612, 66.09056883),),
    ("pinned", "pinned", 2.0): (
        (8.334786169, 32.56190679, 64.84384843),
        (8.340038294, 32.61476844, 65.01422031),
    ),
}
EULER_BERNOULLI = {
    ("free", "free", 2.0): (20.02859286, 59.87806177, 119.3472020),
    ("clamped", "free", 2.0): (1.580913207, 20.50484370, 60.43131297),
    ("pinned", "pinned", 2.0): (8.813051811, 38.46542111, 87.82074638),
}
FOUNDATION = {
    ("pinned", "pinned", 0.0): (21.94015433, 46.50755398, 91.61040130),
    ("pinned", "pinned", 5.0): (20.51763227, 44.45390778, 89.15487895),
    ("free", "free", 0.0): (5.804364607, 27.74632780, 33.83883608, 65.94005122),
    ("clamped", "free", 0.0): (6.198175627, 29.99801466, 66.01343786, 122.9621862),
    ("clamped", "free", 2.0): (4.774440227, 28.79495580, 64.89567840, 121.7980199),
}


def beam(left, right, N=0.0, *, x=(0.0, 1.0), **more):
    return Beam.from_stations(x, 1.0, 1.0, axial_force=N, ends=Ends(left, right), **more)


def timoshenko(left, right, N=0.0, form="haringx", **more):
    columns = {"shear_stiffness": 1 / SHEAR, "rotary_inertia_per_length": ROTARY, **more}
    return beam(left, right, N, shear_form=form, **columns)


def elastic(result):
    return np.sqrt([mode.omega2 for mode in result.modes if mode.number])


@pytest.mark.parametrize("backend", ["numpy", "numba"])
@pytest.mark.parametrize("held", SHORT, ids=str)
def test_table_of_short_beams(held, backend):
    for form, exact in zip(("engesser", "haringx"), SHORT[held], strict=True):
        result = solve_modes(timoshenko(*held, form=form), 3, backend=backend)
        np.testing.assert_allclose(elastic(result), exact, rtol=6e-10)
        assert max(mode.residual for mode in result.modes) < 1e-11


@pytest.mark.parametrize("held", EULER_BERNOULLI, ids=str)
def test_euler_bernoulli_leaves_shear_out(held):
    exact = EULER_BERNOULLI[held]
    left_out = timoshenko(*held, theory="euler_bernoulli")
    rigid = timoshenko(*held, shear_stiffness=np.inf, rotary_inertia_per_length=0.0)
    for short in (left_out, rigid):
        found = natural_frequencies(short, 3).omega2
        np.testing.assert_allclose(np.sqrt(found), exact, rtol=6e-10)
        plain = natural_frequencies(beam(*held), 3).omega2
        np.testing.assert_allclose(found, plain, rtol=1e-12)


@pytest.mark.parametrize("backend", ["numpy", "numba"])
@pytest.mark.parametrize("held", FOUNDATION, ids=str)
def test_table_of_foundations(held, backend):
    exact = FOUNDATION[held]
    half = beam(*held, x=(0.0, 0.5, 1.0), foundation_stiffness=[1000.0, 0.0, 0.0])
    result = solve_modes(half, len(exact), backend=backend)
    np.testing.assert_allclose(elastic(result), exact, rtol=6e-10)
    assert all(mode.kind != "rigid" for mode in result.modes)


@pytest.mark.parametrize("ends", ["free free", "clamped free", "pinned sliding"])
def test_full_foundation_adds_its_own_square(ends):
    plain, k = beam(*ends.split(), N=3.0), 700.0
    full = natural_frequencies(beam(*ends.split(), N=3.0, foundation_stiffness=k), 5).omega2
    rigid = [mode.omega2 for mode in solve_modes(plain, 5).modes]
    np.testing.assert_allclose(full, np.sort(rigid)[:5] + k, rtol=1e-10)


def test_added_mass_lowers_all_frequencies_alike():
    dry = natural_frequencies(beam("clamped", "free"), 5).omega2
    wet = natural_frequencies(beam("clamped", "free", added_mass_per_length=0.7), 5).omega2
    np.testing.assert_allclose(wet, dry / 1.7, rtol=1e-11)


def test_added_mass_has_no_weight_and_no_inertia_along_the_axis():
    dry = beam("clamped", "free")
    wet = beam("clamped", "free", added_mass_per_length=0.7)
    assert wet.mass == dry.mass == 1.0
    assert wet.moment_of_inertia == dry.moment_of_inertia


@pytest.mark.parametrize("N", [-20.0, 0.0, 6.0])
@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_pinned_closed_form(N, form):
    """(S b^2 - N b^2 - m w^2)(EI b^2 + S - rho I w^2) = S^2 b^2, b = n pi: both spectra, mixed.

    The second starts at the cut-off w^2 = S/(rho I), where the sections turn all alike.
    """
    S, b2 = 1 / SHEAR + (N if form == "haringx" else 0.0), (np.arange(41) * np.pi) ** 2
    p, q = S * b2 - N * b2, b2 + S
    half, product = (p * ROTARY + q) / (2 * ROTARY), (p * q - S * S * b2) / ROTARY
    upper = half + np.sqrt(half**2 - product)
    exact = np.sort(np.concatenate([(product / upper)[1:], upper]))[:25]
    assert np.count_nonzero(exact > S / ROTARY) > 10
    for cut in ((0.0, 1.0), (0.0, 0.3, 1.0)):
        found = natural_frequencies(timoshenko("pinned", "pinned", N, form, x=cut), 25)
        np.testing.assert_allclose(found.omega2, exact, rtol=1e-10)


@pytest.mark.parametrize("S", [10.0, 20.0, 50.0, 100.0, 1000.0])
def test_buckling_of_a_pinned_column(S):
    euler = np.pi**2
    exact = {
        "engesser": euler / (1 + euler / S),
        "haringx": S / 2 * (np.sqrt(1 + 4 * euler / S) - 1),
    }
    for form, load in exact.items():
        column = beam("pinned", "pinned", 1.0, shear_stiffness=S, shear_form=form)
        found = buckling(column)
        assert abs(found.load_factor - load) <= max(found.error, 1e-14)
        assert found.error < 1e-10


def test_engesser_is_haringx_with_a_stiffness_smaller_by_the_force():
    one = timoshenko("clamped", "sliding", 4.0, "engesser")
    other = timoshenko("clamped", "sliding", 4.0, "haringx", shear_stiffness=1 / SHEAR - 4.0)
    a, b = (natural_frequencies(item, 6).omega2 for item in (one, other))
    np.testing.assert_allclose(a, b, rtol=1e-12)


@pytest.mark.parametrize("form", ["haringx", "engesser"])
def test_batch_solves_as_single_beams_do(form):
    rng, n, beams = np.random.default_rng(16), 12, 70
    m, EI, kGA = rng.uniform(0.5, 2.0, (3, beams, n)) * np.array([1.0, 1.0, 100.0])[:, None, None]
    N, rotary = rng.uniform(-5.0, 5.0, (beams, n)), rng.uniform(0.0, 0.003, n)
    added, bed = rng.uniform(0.0, 1.0, (beams, n)), rng.uniform(0.0, 300.0, n)
    more = {
        "shear_stiffness": kGA,
        "rotary_inertia_per_length": rotary,
        "foundation_stiffness": bed,
        "added_mass_per_length": added,
    }
    ends = Ends("free", "clamped")
    batch = BeamBatch(np.full(n, 1 / n), m, EI, N, ends, shear_form=form, **more)
    found = solve_many(batch)
    assert not found.reason.any()
    for row in (0, 33, 69):
        own = {name: values[row] if values.ndim > 1 else values for name, values in more.items()}
        one = Beam.from_stations(
            np.linspace(0, 1, n + 1), m[row], EI[row], axial_force=N[row], ends=ends,
            shear_form=form, **own,
        )  # fmt: skip
        exact = solve_modes(one, 6, backend="numpy", families="bending")
        np.testing.assert_allclose(np.sqrt(found.omega2[row]), elastic(exact), rtol=1e-10)


def test_batch_refuses_row_by_row():
    more = {
        "shear_stiffness": np.array([[100.0], [2.0], [-1.0], [100.0]]),
        "rotary_inertia_per_length": np.array([[0.0], [0.0], [0.0], [-1.0]]),
    }
    wrong = {"engesser": [False, True, True, True], "haringx": [False, False, True, True]}
    N, ends = np.full((4, 1), 3.0), Ends("clamped")
    for form, bad in wrong.items():
        batch = BeamBatch([1.0], [1.0], [1.0], N, ends, shear_form=form, **more)
        assert np.array_equal(np.isnan(solve_many(batch).omega2[:, 0]), bad)
    with pytest.raises(InputError, match="of another family"):
        BeamBatch([1.0], [1.0], family="longitudinal", axial_stiffness=[1.0], shear_stiffness=[1.0])
