"""Uniform beams: the roots beta L that the handbooks print."""

import numpy as np
import pytest

from literature.published import check_printed, omegas, unit_beam

BLEVINS = {
    ("free", "free"): "4.73004074 7.85320462 10.9956079 14.1371655 17.2787597",
    ("free", "sliding"): "2.36502037 5.49780392 8.63937983 11.78097245 14.92256510",
    ("clamped", "free"): "1.87510407 4.69409113 7.85475744 10.99554073 14.13716839",
    ("free", "pinned"): "3.92660231 7.06858275 10.21017612 13.35176878 16.49336143",
    ("clamped", "pinned"): "3.92660231 7.06858275 10.21017612 13.35176878 16.49336143",
    ("clamped", "clamped"): "4.73004074 7.85320462 10.9956079 14.1371655 17.2787597",
    ("clamped", "sliding"): "2.36502037 5.49780392 8.63937983 11.78097245 14.92256510",
}


@pytest.mark.parametrize("ends", BLEVINS)
def test_blevins_1979_table_8_1(ends):
    """R. D. Blevins, Formulas for Natural Frequency and Mode Shape (1979), Table 8-1, lambda_i."""
    check_printed(np.sqrt(omegas(unit_beam(*ends), 5)), BLEVINS[ends])
