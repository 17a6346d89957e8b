"""Chains of each law from their columns, for tests."""

from antinode.riccati.chain import Chain
from antinode.riccati.laws import BAR, BENDING, SHAFT


def bending_chain(length, mass, stiffness, force, left="free", right="free", points=()):
    columns = BENDING.named(mass, stiffness, force)
    return Chain(BENDING, length, columns, left, right, points)


def bar_chain(length, mass, stiffness, left="free", right="free", points=()):
    return Chain(BAR, length, BAR.named(mass, stiffness), left, right, points)


def shaft_chain(length, inertia, stiffness, left="free", right="free", points=()):
    return Chain(SHAFT, length, SHAFT.named(inertia, stiffness), left, right, points)
