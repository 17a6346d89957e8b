"""The reference by itself: closed forms, its own convergence, and its two routes side by side."""

import itertools

import mpmath
import pytest
from gmpy2 import mpfr

import reference
from chains import draw_case
from reference import (
    BarChain,
    BeamChain,
    UnsettledError,
    bracketed_root,
    certain_count,
    chain_root,
    count_above,
    count_below,
    eigenvalue,
    enclose,
    parity_below,
    pinned_axial_omega2,
    rigid_modes,
    uniform_axial_root,
    uniform_bar_roots,
    uniform_beam_roots,
)

ENDS = ("free", "clamped", "pinned", "sliding")
PAIRS = list(itertools.product(ENDS, ENDS))
BAR_PAIRS = list(itertools.product(("free", "fixed"), repeat=2))
STEPPED = BeamChain(
    h=(0.3, 0.5, 0.2, 0.7, 0.4),
    EI=(1.0, 1e6, 3.0, 1e5, 0.5),
    m=(1.0, 20.0, 5.0, 1.0, 100.0),
    N=(1.0, 4.0, 2.0, -3.0, 0.5),
)


def unit_beam(left, right, N=0.0, cuts=(1.0,)):
    n = len(cuts)
    return BeamChain(cuts, (1.0,) * n, (1.0,) * n, (N,) * n, left, right)


def relative(value, root, power=1):
    with mpmath.workdps(45):
        return float(abs(value / root**power - 1))


def around(value, width=1e-6):
    return sorted((value * (1 - width), value * (1 + width)))


@pytest.mark.parametrize(
    ("ends", "roots"),
    [  # tabulated in every text on vibration
        (("free", "free"), (0, 0, 4.730040744862704, 7.853204624095838)),
        (("clamped", "free"), (1.875104068711961, 4.694091132974175)),
        (("clamped", "pinned"), (3.926602312047919, 7.068582745628732)),
        (("sliding", "free"), (0, 2.365020372431352, 5.497803919000836)),
        (("pinned", "sliding"), (1.570796326794897, 4.712388980384690)),
    ],
)
def test_closed_forms_give_the_tabulated_roots(ends, roots):
    found = uniform_beam_roots(*ends, len(roots))
    assert [float(root) for root in found] == pytest.approx(roots, rel=1e-15)


def test_static_element_is_the_textbook_matrix():
    with reference._arithmetic(60):
        element = reference._element((0.5, 3.0, 7.0, 0.0), 1, 9, mpfr(0), 2, 60, False)
    k = 3.0 / 0.5**3
    assert [[float(x) for x in row] for row in element.near] == [[12 * k, 3 * k], [k]]
    assert [[float(x) for x in row] for row in element.across] == [
        [-12 * k, 3 * k],
        [-3 * k, k / 2],
    ]
    assert [[float(x) for x in row] for row in element.far] == [[12 * k, -3 * k], [k]]


@pytest.mark.parametrize("ends", PAIRS, ids="-".join)
def test_uniform_beam_to_25_digits(ends):
    chain = unit_beam(*ends)
    for k, root in enumerate(uniform_beam_roots(*ends, 6), 1):
        value = eigenvalue(chain, k, digits=25)
        assert value == 0 if k <= rigid_modes(*ends) else relative(value, root, 4) < 1e-25


@pytest.mark.parametrize("k", [1, 4, 20])
def test_ritz_values_fall_to_the_eigenvalue_as_the_degree_grows(k):
    with mpmath.workdps(50):
        exact = uniform_beam_roots("clamped", "free", k)[-1] ** 4
        errors = [10.0 ** -ritz_error(exact, k, degree) for degree in range(7, 20, 2)]
        for degree in range(7, 20, 2):
            assert count_below(unit_beam("clamped", "free"), exact * (1 - 1e-30), degree=degree) < k
    assert all(late < early / 50 for early, late in itertools.pairwise(errors))
    assert errors[-1] < 1e-20


def ritz_error(exact, k, degree):
    """Digits e, in quarters, with the k-th Ritz value below exact (1 + 10^-e)."""
    chain, quarters = unit_beam("clamped", "free"), 0
    while quarters < 160:
        lifted = exact * (1 + mpmath.mpf(10) ** (-(quarters + 1) / 4))
        if count_below(chain, lifted, degree=degree) < k:
            break
        quarters += 1
    return quarters / 4


@pytest.mark.parametrize("degree", [7, 9, 11, 13, 15])
def test_upper_count_bounds_the_eigenvalue_from_below_as_closely(degree):
    with mpmath.workdps(50):
        exact = uniform_beam_roots("clamped", "free", 4)[-1] ** 4
        error = mpmath.mpf(10) ** -ritz_error(exact, 4, degree)
        chain = unit_beam("clamped", "free")
        assert count_above(chain, exact * (1 + 1e-30), degree=degree) == 4
        assert count_above(chain, exact * (1 - error), degree=degree) == 3


@pytest.mark.parametrize("ends", PAIRS, ids="-".join)
def test_certain_count_between_closed_form_roots(ends):
    chain, rigid = unit_beam(*ends), rigid_modes(*ends)
    roots = [float(root) ** 4 for root in uniform_beam_roots(*ends, 22)]
    assert certain_count(chain, -1e-6).count == 0
    assert certain_count(chain, 1e-6).count == rigid
    for k in range(rigid + 1, 22):
        assert certain_count(chain, (roots[k - 1] * roots[k]) ** 0.5) == (k, 1e-9)


def test_count_at_an_eigenvalue_is_not_settled():
    root = uniform_beam_roots("clamped", "free", 3)[-1]
    with mpmath.workdps(40):
        omega2 = root**4
    with pytest.raises(UnsettledError):
        certain_count(unit_beam("clamped", "free"), omega2)
    with pytest.raises(UnsettledError):
        count_below(unit_beam("free", "free"), 0.0)


@pytest.mark.parametrize("load", [-4.0, 0.3, 1.02])
@pytest.mark.parametrize("ends", [("free", "free"), ("clamped", "free"), ("pinned", "sliding")])
def test_stepped_chain_agrees_with_its_exact_solution(ends, load):
    chain = BeamChain(*(getattr(STEPPED, name) for name in ("h", "EI", "m", "N")), *ends)
    chain = chain.scaled(load)
    for k in (1, 2, 3, 8):
        found = enclose(chain, k, digits=24)
        if found.value:
            root = chain_root(chain, *around(found.value, 1e-9), digits=40)
            assert found.lo < root < found.hi
            assert relative(found.value, root) < 1e-24


@pytest.mark.parametrize("N", [-50.0, 5.0, 45.0])
@pytest.mark.parametrize("ends", [("free", "free"), ("clamped", "free"), ("clamped", "pinned")])
def test_axial_force_agrees_with_the_characteristic_determinant(ends, N):
    chain = unit_beam(*ends, N=N, cuts=(0.25, 0.5, 0.25))
    for k in (1, 2, 4):
        value = eigenvalue(chain, k, digits=24)
        if value:
            assert relative(value, uniform_axial_root(*ends, N, around(value))) < 1e-24


def test_pinned_beam_past_buckling():
    exact = sorted(pinned_axial_omega2(n, 45.0) for n in range(1, 7))
    chain = unit_beam("pinned", "pinned", N=45.0, cuts=(0.25, 0.5, 0.25))
    assert exact[1] < 0 < exact[2]
    assert all(relative(eigenvalue(chain, k), exact[k - 1]) < 1e-20 for k in range(1, 7))
    root = uniform_axial_root("pinned", "pinned", 45.0, around(exact[0]))
    assert relative(root, exact[0]) < 1e-38


@pytest.mark.parametrize("ends", BAR_PAIRS, ids="-".join)
def test_uniform_bar(ends):
    chain = BarChain((0.5, 0.25, 0.25), (1.0,) * 3, (1.0,) * 3, *ends)
    for k, root in enumerate(uniform_bar_roots(*ends, 6), 1):
        value = eigenvalue(chain, k)
        assert value == 0 if root == 0 else relative(value, root, 2) < 1e-20


def test_stepped_bar():
    """Fixed-free, EA and m four times larger in the left half: tan^2(k L / 2) = 4."""
    chain = BarChain((1.0, 1.0), (4.0, 1.0), (4.0, 1.0), "fixed", "free")
    with mpmath.workdps(40):
        exact = mpmath.atan(2) ** 2
    assert relative(eigenvalue(chain, 1, digits=24), exact) < 1e-24


@pytest.mark.parametrize("index", [0, 1, 6, 16, 36])
def test_count_does_not_depend_on_precision_or_degree(index):
    case = draw_case(1, index)
    count = certain_count(case.chain, case.omega2).count
    assert count_below(case.chain, case.omega2, digits=40, tolerance=1e-12) == count
    assert count_below(case.chain, case.omega2, digits=120, tolerance=1e-24) == count
    assert count_above(case.chain, case.omega2, digits=120, tolerance=1e-24) == count
    assert parity_below(case.chain, case.omega2) == count % 2


def test_cases_repeat_and_keep_what_their_index_promises():
    cases = [draw_case(3, index) for index in range(18)]
    assert draw_case(3, 7) == cases[7]
    assert sum(case.step_EI >= 1e5 for case in cases) >= 9
    assert sum(case.near_buckling for case in cases) == 6
    assert sum(case.segments >= 100 for case in cases) == 6


def test_bracketed_root_refuses_a_bracket_without_sign_change():
    with pytest.raises(ValueError, match="no sign change"):
        bracketed_root(lambda x: x * x + 1, mpmath.mpf(0), mpmath.mpf(1), 1e-10)
