"""Spectra that drive a beam, and what outputs come to under them."""
