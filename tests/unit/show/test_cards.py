"""What stands in a notebook: one line, and HTML that suits a light page and a dark one."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

import antinode as an

BEAM = an.Beam(
    [0, 4, 10], [10, 9, 8], 3e6, interpolation="linear", axial_force=1e3,
    ends=an.Ends("clamped", "sliding"), name="<b>boom & jib</b>",
).with_attachments(
    an.PointMass(7, 20), an.Spring(4, 5e4), an.Joint(3, 1e-8), an.Spring(6, np.inf),
    an.Dashpot(5, 3),
)  # fmt: skip
DRIVEN = {
    "damping": {"loss_factor": 0.02},
    "outputs": [{"x": 7, "quantity": "displacement"}, {"x": 4, "quantity": "acceleration"}],
}


def harmonic():
    band = {"from": "1 Hz", "to": "60 Hz", "points": 60}
    return BEAM.response(frequency=band, forces=[{"x": 7, "amplitude": "1 N"}], **DRIVEN)


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cards")
    an.write_example("sweep", folder)
    case = an.load_case(folder / "case.toml")
    study = an.load_study(folder / "study.toml")
    few = an.load_study(folder / "samples.toml").sensitivity(8)
    return [
        BEAM,
        BEAM.modes(3),
        BEAM.stability(1e3, dampers=False),
        case,
        case.loads(),
        case.modes(2),
        harmonic(),
        study,
        few,
    ]


def test_each_object_is_one_line(objects):
    for item in objects:
        if isinstance(item, an.Stability):  # which prints all of its changes
            continue
        line = repr(item)
        assert line.startswith((f"<{type(item).__name__} '", "<Loads: "))
        assert "\n" not in line
        assert len(line) < 200
    assert repr(BEAM.modes(2).mode("bending", 2)).startswith("<Mode bending 2 (elastic): ")


def test_each_card_has_a_picture_and_a_table_and_the_colours_of_its_page(objects):
    for item in objects:
        text = item._repr_html_()
        assert text.count("<table>") == text.count("</table>") > 0
        (svg,) = re.findall(r"<svg.*?</svg>", text)
        tree = ElementTree.fromstring(svg.replace("&#160;", " "))
        numbers = re.findall(r'\b(?:points|cx|cy|x|y)="([^"a-z]+)"', svg)
        places = np.array([float(n) for n in re.split(r"[ ,]", " ".join(numbers))])
        assert np.isfinite(places).all()
        assert tree.find("title") is not None
        colours = set(re.findall(r"(?:fill|stroke|color|background)[=:]\"?([#\w]+)", text))
        fixed = {c for c in colours if c not in ("none", "currentColor", "inherit", "transparent")}
        for colour in fixed:  # visible on white and on black: 3 to 1
            luminance = relative_luminance(colour)
            assert 1.05 / (luminance + 0.05) >= 3, colour
            assert (luminance + 0.05) / 0.05 >= 3, colour


def relative_luminance(colour):
    """WCAG 2.1."""
    parts = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return float(linear @ [0.2126, 0.7152, 0.0722])


def test_names_cannot_write_into_the_page():
    assert "<b>boom" not in BEAM._repr_html_()
    assert "&lt;b&gt;boom &amp; jib" in BEAM.modes(1)._repr_html_()


def test_a_card_says_what_a_list_of_modes_warns_of():
    stubby = an.Beam([0, 1], 10.0, 1e6, axial_stiffness=1e8, name="stubby").modes(3)
    assert stubby.warnings
    assert all(an_escape(w) in stubby._repr_html_() for w in stubby.warnings)


def an_escape(text):
    from html import escape

    return escape(text)


def test_plots_give_axes(objects):
    import matplotlib.pyplot as plt
    from matplotlib.axes import Axes

    for item in objects:
        if hasattr(item, "plot") and not isinstance(item, an.Study):
            axes = item.plot()
            assert all(isinstance(one, Axes) for one in axes)
            assert axes[0].figure.axes[0] is axes[0]
            plt.close(axes[0].figure)
