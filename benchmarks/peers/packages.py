"""Peers that are packages of their own (the extra bench), as far as they are installed."""

from importlib.metadata import version


def installed(length, segments):
    """Solvers by name, (m, EI, N, modes) -> omega^2 each, and why any is missing."""
    found, missing = {}, {}
    for name, make in (("scikit-fem", _scikit_fem), ("OpenSeesPy", _opensees)):
        try:
            found[name] = make(length, segments)
        except (ImportError, RuntimeError) as error:  # OpenSeesPy raises the latter
            missing[name] = str(error)
    return found, missing


def versions():
    """Versions of those installed."""
    found, _ = installed(1.0, 2)
    return {name.lower(): version(name) for name in found}


def _scikit_fem(length, segments):
    from .scikit_fem import ScikitFem

    return ScikitFem(length, segments).omega2


def _opensees(length, segments):
    from .opensees import omega2

    def solve(m, EI, N, modes):
        return omega2(length / segments, m, EI, N, modes)

    return solve
