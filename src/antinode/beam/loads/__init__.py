"""Loads along a beam, and what holds it against them."""
