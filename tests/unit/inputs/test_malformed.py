"""A seeded part of validation/malformed.py: spoilt files end in a result or in one sentence."""

import warnings

from validation.malformed import run


def test_spoilt_files():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # absurd numbers may overflow; what counts is the end
        counts, wrong, _ = run(300, 7)
    assert wrong == []
    assert sum(counts.values()) == 300
