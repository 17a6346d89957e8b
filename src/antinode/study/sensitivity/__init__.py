"""Sensitivity: what moves each frequency, and by how much."""
