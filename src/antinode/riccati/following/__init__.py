"""Ends whose force follows: eigenvalues beside those under forces of fixed direction."""
