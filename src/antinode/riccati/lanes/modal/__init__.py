"""Shapes of modes compiled: eight side by side."""
