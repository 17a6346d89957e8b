"""Reports: complete, the same in HTML and PDF, self-contained; what their numbers say is true."""

import json
import math
import re
import sys
from dataclasses import replace

import numpy as np
import pytest

from antinode import load_beam, load_case, solve_modes
from antinode.errors import InputError
from antinode.examples import write_example
from antinode.report.blocks import Figure, Table, runs, table
from antinode.report.command import make_report, run_report
from antinode.report.html import to_html
from antinode.report.inputs import beam_inputs, case_inputs
from antinode.report.numbers import apart, number, percent, small
from antinode.report.provenance import hash_of
from antinode.response.solve import solve_response
from antinode.show.water import water_dict
from antinode.study.sensitivity.influence import beam_influences, case_influences
from antinode.vehicle.numbers import replaced
from cli_run import run

TITLES = [
    "Assumptions and conventions",
    "Inputs",
    "Loads",
    "Ranges of the correlations",
    "Frequencies",
    "Effect of the axial force",
    "What the end forces do",
    "Mode shapes",
    "Sensitivities",
    "Warnings",
    "Provenance",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    where = tmp_path_factory.mktemp("report")
    for name in ("starter", "tower"):
        write_example(name, where / name)
    path = where / "starter" / "case.toml"
    path.write_text(path.read_text().replace('"follows_body"', '"fixed_direction"'))
    return where


@pytest.fixture(scope="module")
def starter(folder):
    return make_report(folder / "starter" / "case.toml")


def texts(block):
    """All cells of a table as plain texts."""
    return [["".join(r.text + r.index for r in cell) for cell in row] for row in block.rows]


def section(document, title):
    return next(s for s in document.sections if s.title == title)


def first_table(document, title):
    return next(b for b in section(document, title).blocks if isinstance(b, Table))


def test_a_vehicle_has_all_sections_with_assumptions_first(starter):
    document, _ = starter
    assert [s.title for s in document.sections if s.level == 1] == TITLES


def test_frequencies_with_errors_brackets_and_counts(starter, folder):
    rows = texts(first_table(starter[0], "Frequencies"))
    row = next(r for r in rows if r[0] == "bending 1")
    assert row[1:3] == ["elastic", "3.2191787"]
    low, high = (float(v) for v in row[4].split("\u00a0…\u00a0"))
    mode = solve_modes(load_case(folder / "starter" / "case.toml")).mode("bending", 1)
    assert low <= mode.bracket_hz[0] < mode.bracket_hz[1] <= high
    assert high - low < 1e-8
    assert row[5:] == ["2, 3", "−0.909\u00a0%"]


def test_the_two_checks_close_and_every_range_is_listed(starter, folder):
    blocks = section(starter[0], "Loads").blocks
    checks = next(b for b in blocks if isinstance(b, Table) and "checks" in b.caption[0].text)
    assert [row[2] for row in texts(checks)] == ["closes", "closes"]
    rows = texts(first_table(starter[0], "Ranges of the correlations"))
    case = load_case(folder / "starter" / "case.toml")
    assert len(rows) == len(case.loads.validity)
    assert all(row[5] for row in rows)


def test_a_range_that_is_left_is_marked(folder):
    document, told = make_report(
        folder / "starter" / "case.toml", ("condition.cavitator_angle=55deg",)
    )
    ranges = first_table(document, "Ranges of the correlations")
    marked = [row for row, mark in zip(texts(ranges), ranges.marked, strict=True) if mark]
    assert marked
    assert all(row[4] == "OUTSIDE" for row in marked)
    assert len(section(document, "Warnings").blocks[0].items) == len(told)
    assert "condition.cavitator_angle=55deg" in to_html(document)


def test_sensitivities_of_a_vehicle_are_those_of_solving_anew(folder):
    case = load_case(folder / "starter" / "case.toml")
    found = {i.name: i for i in case_influences(case, solve_modes(case, 3, unloaded=True), 3)}

    def moved(assignment):
        text = [] if assignment is None else [assignment]
        anew = load_case(folder / "starter" / "case.toml", text)
        return solve_modes(anew, 3, families=["bending"]).frequencies_hz()

    f = moved(None)
    for name, up, down in (
        ("thrust", "thrust=50.05kN", "thrust=49.95kN"),
        ("speed V", "speed=80.08m/s", "speed=79.92m/s"),
        ("cavitation number σ", "cavitation_number=0.02002", "cavitation_number=0.01998"),
    ):
        change = (moved(f"condition.{up}") - moved(f"condition.{down}")) / f / 0.002
        np.testing.assert_allclose(found[name].percent, change, rtol=2e-3, atol=2e-5)
    np.testing.assert_allclose(found["mass of the body"].percent, -0.5, atol=1e-9)


def test_sensitivities_of_a_beam_add_up(folder):
    file = load_beam(folder / "tower" / "beam.toml")
    found = {i.name: i.percent for i in beam_influences(file, 2, 1e-8)}
    stiffness = found["bending stiffness EI"] + found["axial force N"]
    np.testing.assert_allclose(stiffness, 0.5, atol=1e-5)
    # more mass everywhere, and its weight with it: f falls by 1/2, N acts besides
    mass = found["mass per length"] + found["point masses"]
    np.testing.assert_allclose(mass, -0.5 + found["axial force N"], atol=1e-4)


def test_forces_that_turn_have_no_factor_of_buckling(folder):
    case = folder / "starter" / "case.toml"
    effect = []
    for end_force in ("fixed_direction", "follows_body"):
        document, _ = make_report(case, [f"model.end_force={end_force}"])
        first = section(document, "Effect of the axial force").blocks[0]
        effect.append("".join(run.text for run in first.text))
    assert "times this axial force" in effect[0]
    assert "No load factor" in effect[1]


def test_every_choice_of_the_end_forces_stands_side_by_side(folder, starter):
    """Each row against a case that states the choice, solved by itself."""
    blocks = section(starter[0], "What the end forces do").blocks
    found = {row[0]: row for row in texts(next(b for b in blocks if isinstance(b, Table)))}
    choices = {
        "fixed directions (this file)": "model.end_force=fixed_direction",
        "thrust follows": "model.thrust_follows=1",
        "thrust and cavitator follow": "model.end_force=follows_body",
    }
    assert list(found) == list(choices)
    f1 = {}
    for name, assignment in choices.items():
        case = load_case(folder / "starter" / "case.toml", [assignment])
        exact = solve_modes(case, families=["bending"], tolerance=1e-9).frequencies_hz()
        shown = [float(cell) for cell in found[name][1:-2]]
        np.testing.assert_allclose(shown, exact, rtol=1e-7, atol=5e-6)  # seven digits
        f1[name] = exact[0]
        assert re.fullmatch(r"\d\.\d × 10⁻[⁴-⁹]", found[name][-2].replace("\u00a0", " "))
        told = found[name][-1].replace("\u2212", "-").replace("\u00a0%", "")
        change = 100 * (exact[0] / f1["fixed directions (this file)"] - 1)
        assert told == "–" if not change else abs(float(told) - change) < 0.05
    assert f1["thrust and cavitator follow"] > 1.15 * f1["fixed directions (this file)"]
    assert any(isinstance(b, Figure) for b in blocks)


def test_water_that_pushes_back_has_a_chapter(folder):
    path, wet = folder / "starter" / "case.toml", ["model.hydrodynamic_stiffness=tangent"]
    document, _ = make_report(path, wet)
    tables = [
        texts(b)
        for b in section(document, "What the water does as the body vibrates").blocks
        if isinstance(b, Table)
    ]
    devices, beside, ends = tables
    assert [row[0] for row in devices] == ["cavitator", "fin set 1", "planing"]
    case = load_case(path, wet)
    result = solve_modes(case, 3, unloaded=True)
    told = water_dict(case, result)
    for row, name in ((1, "contact_off"), (2, "without")):
        shown = [float(cell) for cell in beside[row][1:]]
        hz = [f for f in told[name]["frequencies_hz"] if f]
        np.testing.assert_allclose(shown[:3], hz[:3], rtol=1e-5)
    for row, end in zip(ends, told["contact_ends"], strict=False):
        assert row[0] == end["mode"]
        assert float(row[2]) == pytest.approx(1e3 * end["amplitude_m"], rel=5e-3)
        assert float(row[3]) == pytest.approx(end["acceleration_g"], rel=5e-3)
    frequencies = texts(first_table(document, "Frequencies"))
    assert [row[1] for row in frequencies[:3]] == ["overdamped", "divergent", "elastic"]
    assert float(frequencies[2][3]) == pytest.approx(result.modes[2].damping_ratio, rel=1e-3)
    sensitivities = texts(first_table(document, "Sensitivities"))
    (stiffness,) = (row for row in sensitivities if row[0] == "bending stiffness EI")
    assert stiffness[2:4] == ["–", "–"]
    column = np.asarray(case.vehicle.stations.bending_stiffness)
    hz = [
        solve_modes(
            replaced(case, ("vehicle", "stations", "bending_stiffness"), column * factor),
            1,
            families=["bending"],
        )
        .mode("bending", 3)
        .frequency_hz
        for factor in (0.999, 1.001)
    ]
    change = (hz[1] - hz[0]) / (hz[1] + hz[0]) * 1e3
    assert float(stiffness[4]) == pytest.approx(change, abs=1e-3)


def test_added_mass_is_told_with_its_size_and_counts_in_the_sensitivities(folder):
    path, both = folder / "starter" / "case.toml", ["model.fin_added_mass=plate"]
    document, _ = make_report(path, both)
    tables = [b for b in section(document, "Loads").blocks if isinstance(b, Table)]
    (rows,) = [texts(t) for t in tables if t.caption[0].text.startswith("Added mass")]
    assert [row[0] for row in rows] == ["fin set 1"]
    assert rows[0][-1] == "4.442"
    case = load_case(path, both)
    found = {i.name: i for i in case_influences(case, solve_modes(case, 2, unloaded=True), 2)}
    f = [
        solve_modes(load_case(path, [*both, f"condition.thrust={t}kN"]), 2).frequencies_hz()
        for t in (50.05, 49.95)
    ]
    change = 100 * (f[0] - f[1]) / (f[0] + f[1]) * 10
    np.testing.assert_allclose(found["thrust"].percent, change[:2], rtol=2e-3)


def test_html_is_one_file_that_loads_nothing(folder):
    for name, figures in (("starter/case.toml", 3), ("tower/beam.toml", 2)):
        page = to_html(make_report(folder / name)[0])
        assert "http" not in page
        assert not re.search(r"<(script|link|img|iframe)\b|@import|url\((?!#)", page)
        assert "bending 1" in page
        assert page.count("<svg") == figures


def test_a_study_without_shear_says_what_it_leaves_out(folder):
    write_example("sweep", folder / "plain")
    case = folder / "plain" / "case.toml"
    case.write_text(case.read_text().replace('"timoshenko"  ', '"euler_bernoulli"  '))
    few = ("inputs.0.number=4", "solve.modes=2")
    _, told = make_report(folder / "plain" / "study.toml", few)
    assert [text.partition(":")[0] for text in told] == ["some modes"]
    assert told[0].endswith("(every case)")


def test_a_study_with_tracked_frequencies_and_one_with_indices(folder):
    write_example("sweep", folder / "sweep")
    few = ("inputs.0.number=4", "solve.modes=2")
    document, told = make_report(folder / "sweep" / "study.toml", few)
    blocks = section(document, "Frequencies").blocks
    tracked = next(b for b in blocks if isinstance(b, Table) and "Tracked" in b.caption[0].text)
    assert len(tracked.rows) == 8
    assert told == []
    ranges = next(b for b in blocks if isinstance(b, Table) and "Ranges" in b.caption[0].text)
    assert all(row[-1].endswith(" %") and row[-2] for row in texts(ranges))
    document, _ = make_report(folder / "sweep" / "samples.toml", ("design.number=16",), 1)
    causes = section(document, "Uncertainty and its causes").blocks
    assert next(row[1] for row in texts(causes[2])) == "thrust"
    assert "http" not in to_html(document)


def test_author_revision_and_checker_stand_under_the_title(folder, tmp_path):
    people = ("--author", "A. <Smith>", "--revision", "B")
    code, _, err = run("report", folder / "tower" / "beam.toml", "-o", tmp_path / "r.html", *people)
    assert code == 0, err
    under = (
        (tmp_path / "r.html").read_text("utf-8").split("</dl>")[0].split('<dl class="facts">')[1]
    )
    told = re.findall(r"<dt>(.*?)</dt>\s*<dd>(.*?)</dd>", under, re.S)
    assert dict(told)["Author"] == "A. &lt;Smith&gt;"
    assert dict(told)["Revision"] == "B"
    assert set(dict(told)["Checked by"]) == {".", " "}


def test_html_escapes_what_a_file_says(folder):
    name = ("beam.name='<script>alert(1)</script>'",)
    page = to_html(make_report(folder / "tower" / "beam.toml", name)[0])
    assert "<script" not in page
    assert "&lt;script&gt;" in page


def test_pdf_has_pages_and_its_text_is_data(folder, tmp_path):
    out = tmp_path / "report.pdf"
    beam = folder / "tower" / "beam.toml"
    run_report(beam, ('beam.name="#panic() $x$ *a*"',), out)
    assert out.read_bytes().startswith(b"%PDF-")
    from antinode.report.pdf import to_pictures

    pages = to_pictures(make_report(beam)[0], 40)
    assert len(pages) > 2
    assert all(page.startswith(b"\x89PNG") for page in pages)


def test_command_line(folder, tmp_path):
    case = folder / "starter" / "case.toml"
    done = run("report", case, "-o", tmp_path / "r.html", "--modes", "2", "--json")
    said = json.loads(done.out)
    assert said["schema_version"] == 1
    assert (tmp_path / "r.html").exists()
    assert said["hash"] == hash_of(load_case(case))[:16]
    for arguments, words in (
        (("report", case, "-o", tmp_path / "r.odt"), ".html, .pdf"),
        (("report", case, "-o", tmp_path / "none" / "r.pdf"), "no folder"),
        (("report", folder / "starter" / "stations.csv", "-o", tmp_path / "r.pdf"), ":burnt"),
    ):
        refused = run(*arguments)
        assert refused.code == 2
        assert words in refused.err


@pytest.mark.parametrize(("ending", "library"), [(".pdf", "typst"), (".html", "jinja2")])
def test_a_missing_library_says_how_to_install_it(folder, tmp_path, monkeypatch, ending, library):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(InputError, match=r"pip install 'antinode\[report\]'"):
        run_report(folder / "starter" / "case.toml", (), tmp_path / f"r{ending}")


def test_the_hash_is_that_of_the_numbers(folder):
    path = folder / "starter" / "case.toml"
    same = load_case(path, ["condition.speed=80", "condition.thrust=50000"])
    other = load_case(path, ["condition.speed=80.1m/s"])
    assert hash_of(load_case(path)) == hash_of(same) != hash_of(other)


def test_symbols_powers_and_code():
    kinds = [(r.kind, r.text, r.index) for r in runs("F_CX in m^2, sigma of `fin_position`")]
    assert kinds == [
        ("symbol", "F", "CX"),
        ("text", " in m², σ of ", ""),
        ("code", "fin_position", ""),
    ]
    assert [r.index for r in runs("Re_w and C_D0, cavitation_number")] == ["w", "", "D0", ""]


def test_numbers():
    assert number(-1.85e9) == "−1.85\u00a0×\u00a010⁹"
    assert number(math.inf) == "∞"
    assert number(math.nan) == "–"
    assert number(1e-6) == "10⁻⁶"
    assert [number(v) for v in (5e4, 1e5, 3.5e6, 1e9)] == [
        "50000", "100000", "3500000", "1\u00a0×\u00a010⁹"
    ]  # fmt: skip
    assert small(3.14e-9) == "3.1\u00a0×\u00a010⁻⁹"
    assert percent(-0.0123) == "−1.23\u00a0%"
    low, high = apart(3.24870857948, 3.24870857962)
    assert float(low) <= 3.24870857948
    assert float(high) >= 3.24870857962
    assert len(table("", ("a",), [("1",)]).rows) == 1


def test_parts_stand_with_their_masses(folder, tmp_path):
    """Of a vehicle and of a beam: a part of 40 kg/m over 0.5 m, one that tapers to nothing."""
    part = "{name='tank', x=[1.0, 1.5], mass_per_length=[40, 40]}"
    cone = "{name='cone', interpolation='linear', x=[2.0, 4.0], mass_per_length=[10, 0]}"
    for file, name in ((folder / "starter" / "case.toml", "vehicle"),
                        (folder / "tower" / "beam.toml", "beam")):  # fmt: skip
        assign = [f"{name}.masses=[{part}, {cone}]"]
        if name == "beam":
            assign.append("beam.interpolation=linear")
        loaded = (load_case if name == "vehicle" else load_beam)(file, assign)
        source = case_inputs(loaded) if name == "vehicle" else beam_inputs(loaded, loaded.beam())
        blocks = [b for s in source for b in s.blocks if isinstance(b, Table)]
        rows = next(texts(b) for b in blocks if "Parts" in str(b.caption))
        assert [row[2] for row in rows] == ["20", "10"]


def test_a_study_says_in_brief_what_is_past_buckling(folder, tmp_path):
    path = folder / "starter" / "pushed.toml"
    path.write_text(
        'case = "case.toml"\ninputs = [{ key = "thrust", values = [0, 6e5] }]\nsolve.modes = 1\n'
    )
    document, _ = make_report(path)
    brief = " ".join("".join(r.text for r in line) for line in document.brief)
    assert "0 failed, 1 past buckling" in brief


@pytest.fixture(scope="module")
def flight(tmp_path_factory):
    where = tmp_path_factory.mktemp("flight")
    write_example("response", where)
    return where


def test_a_response_has_a_chapter(flight):
    """What the chapter says is what the solver says; equipment that fails is marked."""
    own = flight / "response.toml"
    document, told = make_report(flight / "beam.toml", responses=(own,))
    titles = [s.title for s in document.sections]
    chapter = next(s for s in document.sections if s.title.startswith("Response: "))
    assert titles.index(chapter.title) == titles.index("Sensitivities") - 1
    outputs, equipment = (b for b in chapter.blocks if isinstance(b, Table))
    result = solve_response(own)
    rms = result.statistics[0].rms / 9.80665
    assert float(texts(outputs)[0][1]) == pytest.approx(rms, rel=1e-4)
    for row, verdict in zip(texts(equipment), result.verdicts, strict=True):
        assert row[0] == verdict.name
        assert float(row[2].replace("\u2212", "-")) == pytest.approx(verdict.margin_db, abs=0.006)
        assert float(row[3]) == pytest.approx(verdict.error_db, rel=0.06)
        assert row[4] == "yes"
    assert list(equipment.marked) == [False] * len(result.verdicts)
    assert set(result.warnings) <= set(told)
    page = to_html(document)
    assert "Not in these numbers" in page
    drawings = [b for b in chapter.blocks if isinstance(b, Figure)]
    rest = replace(document, sections=tuple(s for s in document.sections if s is not chapter))
    assert page.count("<svg") == len(drawings) + to_html(rest).count("<svg")
    for drawing in drawings:  # at the width of the text each fits on a page, caption and all
        sizes = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', drawing.svg)
        assert float(sizes[2]) < 1.3 * float(sizes[1])


def test_a_response_of_another_file_is_refused(flight, folder):
    own = flight / "response.toml"
    with pytest.raises(InputError, match=r"it is a response of 'beam\.toml', not of"):
        make_report(folder / "tower" / "beam.toml", responses=(own,))
