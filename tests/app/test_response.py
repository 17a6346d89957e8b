"""The response panel: the curve beside the solver's own, in a browser and without one."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import antinode as an

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from antinode.app.compute import full_answer, quick_answer
from antinode.app.panels.response import response_data
from antinode.app.source import read_example
from antinode.app.state import State
from antinode.errors import InputError
from antinode.response.damping import Rayleigh
from app_browser import Tab


def state(name, **asked):
    return State(read_example(name)).viewed(panel="response", response=asked)


@pytest.mark.parametrize("name", ["starter", "drawing", "rocket"])
def test_the_curve_is_the_solvers(name):
    own = state(name, loss_factor=0.03, amplitude=50.0)
    quick = response_data(own, quick_answer(own), full=False)
    full = response_data(own, full_answer(own), full=True)
    beam = own.beam
    at, seen = (
        float(f"{beam.x[0] + share * beam.length:.3g}") for share in (0.8, 0.3)
    )  # where the page puts what it is not told
    hertz = [peak["hz"] for peak in full["peaks"]]
    assert len(hertz) >= 3
    damping = an.Damping(0.03)
    exact = an.frequency_response(
        beam, hertz, [an.Force(at)], [an.Output(seen, "acceleration")], damping=damping
    )
    sizes = 50.0 * np.abs(exact.values[0, 0])
    np.testing.assert_allclose([p["size"] for p in full["peaks"]], sizes, rtol=6e-5)
    np.testing.assert_allclose([p["size"] for p in quick["peaks"]], sizes, rtol=2e-4)
    assert all(float(p["error"]) < 1e-5 * max(sizes) for p in full["peaks"])
    assert full["peaks"][0]["mode"] == "bending 1"
    assert quick["quick"]
    assert not full["quick"]


@pytest.mark.parametrize(
    ("name", "asked"),
    [
        ("starter", {}),
        ("starter", {"damping": "rayleigh", "ratio": 0.004}),
        ("drawing", {"drive": "base", "amplitude": 2.0}),
        ("drawing", {"drive": "base", "damping": "modal", "ratio": 0.02}),
        ("rocket", {"damping": "modal"}),
        ("rocket", {"loss_factor": 2e-4}),
    ],
)
def test_every_peak_has_an_error_while_something_moves(name, asked):
    own = state(name, **asked)
    quick = response_data(own, quick_answer(own), full=False)
    full = response_data(own, full_answer(own), full=True)
    assert len(quick["peaks"]) == len(full["peaks"]) >= 3
    for one, other in zip(quick["peaks"], full["peaks"], strict=True):
        shown = 1e-5 * other["size"]  # five digits
        away = abs(one["size"] - other["size"])
        assert away <= float(one["error"]) + float(other["error"]) + shown
        assert float(one["error"]) < 5e-2 * max(p["size"] for p in quick["peaks"])
    assert ("supports" in quick["title"]) == ("drive" in asked)


def test_damping_of_the_page_is_that_of_the_solver():
    own = state("drawing", drive="base", damping="rayleigh", ratio=0.03, low=0.3, high=12.0)
    full = response_data(own, full_answer(own), full=True)
    damping = an.Damping(rayleigh=Rayleigh.fitted((0.03, 0.03), (0.3, 12.0)))
    exact = an.frequency_response(
        own.beam,
        [peak["hz"] for peak in full["peaks"]],
        [an.Base()],
        [an.Output(24.0, "acceleration")],
        damping=damping,
    )
    sizes = np.abs(exact.values[0, 0])
    np.testing.assert_allclose([p["size"] for p in full["peaks"]], sizes, rtol=6e-5)


def test_units_and_words():
    own = state("drawing", force_x="80 m", output_x="40 m", quantity="bending_moment")
    data = response_data(own, quick_answer(own), full=False)
    assert data["title"] == "1 N lateral force at 80 m: bending moment at 40 m"
    assert data["unit"] == "kN m"
    other = own.viewed(units="mm-t-s")
    shown = response_data(other, quick_answer(other), full=False)
    assert "80000 mm" in shown["title"]
    np.testing.assert_allclose(shown["points"][0][1], 1e6 * data["points"][0][1], rtol=1e-3)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"force_x": 81.0}, "81 m is off the beam"),
        ({"direction": "torsional", "quantity": "displacement"}, "no torsional_stiffness"),
        ({"direction": "axial", "quantity": "bending_moment"}, "makes no bending moment"),
        ({"low": 50.0, "high": 5.0}, "is empty"),
        ({"drive": "base", "direction": "torsional"}, "no torsional_stiffness"),
    ],
)
def test_what_cannot_be_is_said(asked, words):
    own = state("rocket" if "direction" in asked else "drawing", **asked)
    with pytest.raises(InputError, match=words):
        response_data(own, quick_answer(own), full=False)


def test_it_moves_with_a_slider_while_full_answers_are_on_their_way(context, address):
    tab = Tab(context, address + '?panel="response"')
    tab.page.wait_for_selector(".an-peaks:not(.an-quick) td")
    first = tab.page.locator(".an-peaks tbody tr").first.inner_text().split("\t")
    assert float(first[0]) == pytest.approx(3.766, abs=1e-3)
    assert first[3] == "bending 1"
    script = """async (code) => {
        const slider = document.querySelector(".an-slider[aria-label^='thrust']")
            .querySelector('.q-slider__track-container');
        slider.focus();
        const view = window.antinode.views.response, show = view.show;
        const before = window.antinode.data.response.peaks[0].hz;
        const seen = new Promise((done) => {
            setTimeout(() => done("too late"), 100_000);
            view.show = (data) => {
                show.call(view, data);
                if (data.peaks[0].hz !== before)
                    done([data.quick, window.antinode.data.frequencies.quick]);
            };
        });
        slider.dispatchEvent(new KeyboardEvent('keydown', {keyCode: code, bubbles: true}));
        const found = await seen;
        view.show = show;
        return found;
    }"""
    codes = (39, 39, 37, 39, 37, 39, 37, 39, 39)
    moved = [tab.page.evaluate(script, code) for code in codes]  # times are in benchmarks/app.md
    assert moved == [[True, True]] * len(codes)  # first the quick ones, beside a quick table
    tab.settle()
    tab.page.wait_for_selector(".an-peaks:not(.an-quick) td")
    assert tab.errors == []
    tab.page.close()


def test_another_output_by_the_menu(context, address):
    tab = Tab(context, address + f'?panel="response"&case={read_example("drawing").packed()}')
    tab.page.get_by_label("Force, output, damping and band").click()
    field = tab.page.get_by_label("response: force at")
    field.fill("90 m")
    field.press("Enter")
    tab.page.get_by_text("90 m is off the beam").first.wait_for()
    field.fill("0.08 km")
    field.press("Enter")
    tab.page.get_by_label("response: amplitude").fill("2 kN")
    tab.page.get_by_label("response: amplitude").press("Enter")
    title = "window.antinode.views.response.instance.getOption().title[0].text"
    tab.page.wait_for_function(f"{title}.startsWith('2 kN lateral force at 80 m')")
    tab.settle()
    tab.page.wait_for_selector(".an-peaks:not(.an-quick) td")
    shown = tab.page.evaluate("window.antinode.views.response.text()").splitlines()[1].split("\t")
    drawing = read_example("drawing").checked[1]
    drives, outputs = [an.Force(80.0)], [an.Output(24.0, "acceleration")]
    exact = an.frequency_response(
        drawing, [float(shown[0])], drives, outputs, damping=an.Damping(0.02)
    )
    assert float(shown[1]) == pytest.approx(2000.0 * abs(exact.values[0, 0, 0]), rel=1e-4)
    assert tab.page.get_by_label("response: damping ratio").is_hidden()
    tab.page.get_by_label("response: amplitude").fill("20 m/s^2")
    tab.page.get_by_label("response: drive").click()
    tab.page.get_by_role("option", name="supports").click()
    tab.page.wait_for_function(f"{title}.startsWith('supports by 20 m/s², lateral')")
    assert tab.page.get_by_label("response: force at").is_hidden()
    tab.page.get_by_label("response: damping", exact=True).click()
    tab.page.get_by_role("option", name="ratio of modes").click()
    tab.page.get_by_label("response: damping ratio").fill("0.05")
    tab.page.get_by_label("response: damping ratio").press("Enter")
    tab.settle()
    tab.page.wait_for_selector(".an-peaks:not(.an-quick) td")
    assert tab.errors == []
    tab.page.close()


@pytest.mark.parametrize("title", ["Vehicle in its cavity", "Mode shapes", "chosen panel", "Body"])
def test_a_panel_is_saved_as_a_picture(context, address, title):
    tab = Tab(context, address + '?panel="response"')
    tab.page.wait_for_selector(".an-peaks:not(.an-quick) td")
    tab.page.get_by_label(f"Enlarge: {title}").click()
    large = tab.page.locator(".an-large")
    with tab.page.expect_download() as waiting:
        large.get_by_role("button", name="Save as PNG").click()
    content = Path(waiting.value.path()).read_bytes()
    assert content.startswith(b"\x89PNG")
    assert len(content) > 3000  # something is on it
    vector = large.get_by_role("button", name="Save as SVG")
    assert vector.is_visible() == (title != "Body")
    if title != "Body":
        with tab.page.expect_download() as waiting:
            vector.click()
        text = Path(waiting.value.path()).read_text(encoding="utf-8")
        ElementTree.fromstring(text)  # it is whole
        wanted = {"Vehicle in its cavity": "thrust 50", "chosen panel": "lateral force at 4.8 m"}
        assert wanted.get(title, "from the nose") in text
    numbers = tab.page.evaluate("window.antinode.views.modes.instance.getOption().series.length")
    assert numbers == 3
    assert tab.errors == []
    tab.page.close()


def test_a_snapshot_lies_beside_shapes_and_response(context, address):
    tab = Tab(context, address + '?panel="compare"')
    tab.page.get_by_role("button", name="Keep").click()
    before = tab.frequency(1)
    tab.page.get_by_role("button", name="Euler-Bernoulli").click()
    tab.changed(before)
    tab.page.get_by_label("What this panel shows").click()
    tab.page.get_by_role("option", name="Response").click()
    series = "window.antinode.views.{}.instance.getOption()?.series"
    tab.page.wait_for_function(
        f"{series.format('response')}?.find((s) => s.id === 'kept')?.data.length > 100"
    )
    tab.settle()
    shapes = tab.page.evaluate(series.format("modes") + ".map((s) => [s.id, s.data])")
    now, kept = (np.array(dict(shapes)[f"{what} 3"]) for what in ("mode", "kept"))
    exact = [quick_answer(own).quick for own in (State(read_example("starter")),)]
    shown = np.interp(exact[0].x, kept[:, 0], kept[:, 1])
    np.testing.assert_allclose(shown, exact[0].states[:, 2, 0], atol=2e-3)
    assert np.max(np.abs(np.interp(now[:, 0], kept[:, 0], kept[:, 1]) - now[:, 1])) > 0.005
    assert tab.errors == []
    tab.page.close()
