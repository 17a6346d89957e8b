"""Identification: the vehicle that measured frequencies belong to."""
