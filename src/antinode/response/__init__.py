"""Responses: what a beam does under forces and moving supports, and what equipment then feels."""
