"""Responses: what a beam does under forces and moving supports, and what that means for equipment."""
