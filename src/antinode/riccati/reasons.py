"""Why a chain or a beam has no certified eigenvalues: numbers that compiled code can return."""

CERTIFIED, OUT_OF_REACH, NOT_BRACKETED, NOT_FINITE, INVALID, CLUSTERED = 0, 1, 2, 3, 4, 5
PAST_BUCKLING, FLUTTERS, BY_ITSELF, TOO_MANY_STEPS, NOT_CONVERGED = 6, 7, 8, 9, 10
"""In this order: it has; the stiffness, mass and force of a segment do not go together; the counts
did not bracket every root; the characteristic function is not finite; a number of the chain is
not; roots too close for determinants; omega^2 < 0; a pair of modes grows while it oscillates; left
by a batch to be solved by itself; a beam of too many steps; one whose representations did not
agree."""

TABLE_TOO_SMALL, CHAIN_TOO_SMALL = -1, -2
"""The caller must give more room, and call again."""
