"""Transfer matrices, their Riccati form, certified eigenvalues and mode shapes of segment chains.

This package sees arrays only: it knows neither beams nor vehicles and imports nothing else of
antinode.
"""
