"""The backend in numpy: the form that is read, one chain at a time."""

from __future__ import annotations

from .arrays import Array
from .chain import Chain, evaluate
from .chains import BeamRoots, ChainRoots, Chains, Tables
from .damped.chain import Form
from .forced import DrivenChain
from .normalised import normal_modes, normalise
from .reasons import BY_ITSELF
from .roots import FollowingRoots, find_eigenvalues
from .shapes import cut, mode_energies, mode_states

__all__ = [
    "certify_guesses",
    "complex_form",
    "cut",
    "driven",
    "evaluate",
    "find_eigenvalues",
    "find_following",
    "mode_energies",
    "mode_states",
    "name",
    "normal_modes",
    "normalise",
    "solve_beam",
    "solve_chains",
]

name = "numpy"
driven = DrivenChain
complex_form: type[Form] = Form


def solve_chains(
    chains: Chains, below: int, number: int, width: float, *, proven: bool = True
) -> ChainRoots:
    """Leave every chain to be solved by itself: there is nothing to gain from neighbours here."""
    return ChainRoots.empty(len(chains), number, BY_ITSELF)


def certify_guesses(chains: Chains, guess: Array, below: int, width: float) -> ChainRoots:
    """Leave every chain to be solved by itself."""
    return solve_chains(chains, below, guess.shape[1], width)


def find_following(
    chain: Chain, below: int, wanted: int, *, zeros: int, free: bool, width: float
) -> FollowingRoots | None:
    """Return None: the winding number proves it (`riccati.following.roots`)."""
    return None


def solve_beam(
    beam: Tables,
    below: int,
    number: int,
    refinement: int,
    tolerance: float,
    width: float,
) -> BeamRoots | None:
    """Return None: chain after chain of a beam is for its caller to refine and solve."""
    return None
