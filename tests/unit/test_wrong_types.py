"""Arguments of a wrong type are one sentence, not an error from within."""

import pytest

import antinode as an


def one():
    return an.Beam.from_stations([0, 1], 1, 1)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: an.sweep("study.toml"), "a Study is wanted, such as load_study"),
        (lambda: an.sensitivity(None), "a Study is wanted, such as load_study"),
        (lambda: an.drawn_beam([0, 1], "steel", outer_diameter=0.1), "a Material is wanted"),
        (lambda: an.solve_many(one()), "a BeamBatch is wanted"),
        (lambda: an.Damping("2 %"), "damping.loss_factor"),
        (lambda: an.Damping(modal=("2 %",)), "damping.modal"),
    ],
)
def test_what_is_wanted_is_said(call, words):
    with pytest.raises(an.InputError) as caught:
        call()
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_one_force_and_one_output_need_no_list():
    force, output = an.Force(0.0), an.Output(1.0, "displacement")
    alone = an.frequency_response(one(), [1.0], force, output)
    listed = an.frequency_response(one(), [1.0], [force], [output])
    assert alone.values == listed.values
