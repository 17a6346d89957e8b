"""Stability along any input of a case or a beam file, named as studies name them."""
