"""The two ways in which antinode says no: the input was wrong, or the computation failed."""


class AntinodeError(Exception):
    """Base of antinode's own errors; `str(error)` is one sentence for the user."""

    exit_code = 1


class InputError(AntinodeError, ValueError):
    """The input was wrong: the sentence says what, where, what was received and what is allowed."""

    exit_code = 2


class ComputationError(AntinodeError, ArithmeticError):
    """The input was acceptable, but no trustworthy result could be computed from it."""
