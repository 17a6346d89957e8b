"""A part of validation/fresh_tries.py: what must be refused is, in one sentence."""

from validation.fresh_tries import run, tries

LONG = "modes case.toml --set vehicle.cavitator.diameter=2"
"""Accepted, and longer at work than all others together: left to the script."""


def test_a_fifth_of_the_tries():
    chosen = tries()
    assert len(chosen) > 300
    part = [each for each in chosen[::5] if LONG not in each[2]]
    assert len(part) > 60
    assert run(part) == [wanted for wanted, _, _ in part]
