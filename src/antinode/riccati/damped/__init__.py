"""Chains with dashpots, feedback and loss: complex s in place of omega^2."""
