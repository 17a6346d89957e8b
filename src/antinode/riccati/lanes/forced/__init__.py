"""Lateral motion that is driven, compiled: eight frequencies side by side."""
