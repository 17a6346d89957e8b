"""A part of validation/fresh_tries.py: what must be refused is, in one sentence."""

from validation.fresh_tries import run, tries


def test_a_fifth_of_the_tries():
    chosen = tries()
    assert len(chosen) > 300
    part = chosen[::5]
    assert run(part) == [wanted for wanted, _, _ in part]
