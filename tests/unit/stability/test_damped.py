"""Stability with dampers: no mode grows at one end of the bracket, and one does at the other."""

import antinode as an
from antinode.modes.loading import under

TAPERED = an.Beam(
    x=[0, 3, 6],
    mass_per_length=[10, 9, 8],
    bending_stiffness=[1e5, 9e4, 8e4],
    axial_force=[-1e3, 2e3, 5e3],
    interpolation="linear",
    ends=an.Ends("clamped", "free", right_follower=1.0),
)


def test_growth_changes_its_sign_inside_the_bracket():
    beam = TAPERED.with_attachments(an.Dashpot(5.0, translational=30.0))
    found = an.stability(beam).damped
    assert found.proven
    low, high = found.bracket
    assert low < found.load_factor < high
    assert high - low < 1e-5 * high
    growth = [
        max(
            mode.growth_rate_per_s
            for mode in an.solve_modes(under(beam, factor), 4, tolerance=1e-10).modes
        )
        for factor in (low, high)
    ]
    assert growth[0] < 0 < growth[1]
    assert found.frequency_hz > 0


def test_where_rounding_hides_a_growth_its_bracket_ends_where_it_is_told():
    """A huge mass at the tip all but pins it: what the dashpot does to bending 2 is 1e-13 of it."""
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0, None, 2.0, ends=TAPERED.ends)
    heavy = beam.with_attachments(an.PointMass(1.0, 1e6), an.Dashpot(1.0, translational=0.1))
    found, plain = an.stability(heavy).damped, an.stability(heavy).critical[0].load_factor
    assert (found.kind, found.mode) == ("flutter", "bending 2")
    assert not found.proven  # that nothing grows below
    growing = an.solve_modes(under(heavy, found.bracket[1]), 4, families=["bending"])
    mode = max(growing.modes, key=lambda m: m.growth_rate_per_s)
    assert mode.growth_rate_per_s > mode.error_growth_rate_per_s
    assert found.bracket[1] < plain < 1.02 * found.bracket[1]
