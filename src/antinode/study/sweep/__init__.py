"""Sweeps: many cases over any inputs of one, into a store."""
