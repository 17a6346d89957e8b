"""Figures: one style read from one file, text as text, names and units, marks of attachments."""

import math
import re

import numpy as np
import pytest

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring, attachment_dict
from antinode.show.figures import plot_case, plot_loads, plot_modes, save
from antinode.show.style import FILE, PALETTE, STYLE, styled
from antinode.show.svg import for_page


@pytest.fixture(scope="module")
def column():
    beam = Beam.from_stations(
        np.linspace(0, 4, 5), 10.0, 1e5, 1e8, 500.0, ends=Ends("clamped", "free"), name="column"
    )
    things = (PointMass(4.0, 5.0), Spring(2.0, 1e4), Spring(3.0, math.inf), Joint(1.0, 1e-7))
    return solve_modes(beam.with_attachments(*things), 2)


def legend(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_the_style_file_is_one_that_matplotlib_reads():
    from matplotlib import rc_params_from_file, rcParams

    parsed = rc_params_from_file(FILE, use_default_template=False)
    assert set(STYLE) == set(parsed)
    assert parsed["axes.prop_cycle"].by_key()["color"] == list(PALETTE)
    with styled():
        assert rcParams["svg.fonttype"] == "none"
        assert {key: rcParams[key] for key in parsed} == parsed


def test_everything_that_is_attached_is_marked_and_named(column):
    figure = plot_modes(column)
    sketch, shapes = figure.axes[:2]
    assert legend(sketch) == ["point mass", "spring", "support", "joint"]
    marks = {line.get_label(): list(line.get_xdata()) for line in sketch.lines}
    assert marks["joint"] == [1.0]
    assert marks["support"] == [3.0]
    assert {float(line.get_xdata()[0]) for line in shapes.lines[-4:]} == {1.0, 2.0, 3.0, 4.0}


def test_modes_are_named_as_in_the_tables_and_axes_have_units(column, starter):
    for figure in (plot_modes(column), plot_case(*starter), plot_loads(starter[0])):
        for axes in figure.axes:
            label = axes.get_ylabel()
            assert re.search(r"\[.+\]$", label) or not len(axes.get_yticks())
        assert re.search(r"\[m\]$", figure.axes[-1].get_xlabel())
    names = [text.partition(":")[0] for text in legend(plot_modes(column).axes[1])]
    assert names == ["bending 1", "bending 2"]


@pytest.fixture(scope="module")
def starter(tmp_path_factory):
    from antinode import load_case
    from antinode.examples import write_example

    folder = tmp_path_factory.mktemp("starter")
    write_example("starter", folder)
    case = load_case(folder / "case.toml")
    return case, solve_modes(case, 2)


def test_text_is_text_in_svg_and_a_page_gets_no_reference(column, tmp_path):
    save(plot_modes(column), tmp_path / "modes.svg")
    svg = (tmp_path / "modes.svg").read_text(encoding="utf-8")
    assert "bending 1" in svg
    inside = for_page(svg, "one")
    assert "http" not in inside
    assert 'id="one-figure_1"' in inside
    assert set(re.findall(r"url\(#(\w+)-", inside)) == {"one"}


def test_attachments_as_numbers():
    assert attachment_dict(PointMass(4.0, 5.0, offset=0.5)) == {
        "kind": "point mass", "x_m": 4.0, "mass_kg": 5.0, "rotary_inertia_kg_m2": 0.0,
        "offset_m": 0.5, "polar_inertia_kg_m2": 0.0,
    }  # fmt: skip
    support = attachment_dict(Spring(3.0, math.inf, 7.0))
    assert support["kind"] == "support"
    assert support["translational_N_per_m"] is None
    assert (support["rotational_N_m_per_rad"], support["holds"]) == (7.0, ["translational"])
    assert attachment_dict(Joint(1.0, 1e-7))["rotational_rad_per_N_m"] == 1e-7
