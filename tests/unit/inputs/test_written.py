"""Numbers, units, headings and texts as people write them: read, or refused with what helps."""

import pytest

import antinode as an
from antinode.inputs.units import to_si
from cli_run import refused, run

READ = {
    ("2,5 m", "m"): 2.5,
    ("2,5mm", "m"): 0.0025,
    ("0,125 m", "m"): 0.125,
    ("-0,125 m", "m"): -0.125,
    ("1.234,5 N", "N"): 1234.5,
    ("1,234.5 N", "N"): 1234.5,
    ("12,345,678 N", "N"): 12345678.0,
    ("1'000 N", "N"): 1000.0,
    ("5_000 N", "N"): 5000.0,
    ("\u22123 kN", "N"): -3e3,
    ("1,5e3 N", "N"): 1500.0,
    (".5 m", "m"): 0.5,
    ("3 kNm\u00b2", "N m^2"): 3e3,
    ("3 Nm^2", "N m^2"): 3.0,
    ("3 N*m**2", "N m^2"): 3.0,
    ("3 N\u00b7m\u00b2", "N m^2"): 3.0,
    ("7850 kg/m3", "kg/m^3"): 7850.0,
    ("5 kNm/rad", "N m/rad"): 5e3,
    ("5 KN", "N"): 5e3,
    ("210 Gpa", "Pa"): 210e9,
    ("12 N/mm\u00b2", "Pa"): 12e6,
    ("180\u00b0", "rad"): 3.141592653589793,
    ("3 t", "kg"): 3e3,
}


@pytest.mark.parametrize(("text", "unit"), READ)
def test_what_is_unambiguous_is_read(text, unit):
    assert to_si(text, unit) == pytest.approx(READ[text, unit], rel=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "words"),
    [
        ("1,000 m", "m", "1000 or 1.000"),
        ("-12,345 m", "m", "-12345 or -12.345"),
        ("3 ton", "kg", "write t"),
        ("5 kn", "N", "no unit"),
        ("1 000 N", "N", "no unit"),
        ("1 m2", "m", "no unit"),
        ("1,2,3 m", "m", "needs a number"),
        ("0'125 m", "m", "needs a number"),
    ],
)
def test_what_may_mean_two_things_is_refused(text, unit, words):
    with pytest.raises(ValueError, match=words):
        to_si(text, unit)


CSV = "x [m],mass_per_length [kg/m],bending_stiffness [N m^2]\n0,10.5,2000\n1,10.5,2000\n"
BEAM = '[beam]\nstations = "s.csv"\n'


@pytest.mark.parametrize(
    "text",
    [
        CSV,
        CSV.replace(",", ";"),
        CSV.replace(",", ";").replace("10.5", "10,5"),
        CSV.replace(",", "\t").replace("10.5", "10,5"),
        CSV.replace("[", "(").replace("]", ")"),
        CSV.replace("x [m]", "X (mm)").replace("\n1,", "\n1000,"),
        CSV.replace("bending_stiffness [N m^2]", "EI [kNm\u00b2]").replace("2000", "2"),
        CSV.replace("bending_stiffness", "Bending stiffness"),
        "# of the yard; 2026\n\n" + CSV,
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_tables_of_any_spreadsheet(tmp_path, text, encoding):
    (tmp_path / "s.csv").write_text(text, encoding=encoding)
    (tmp_path / "b.toml").write_text(BEAM, encoding=encoding)
    beam = an.load_beam(tmp_path / "b.toml").beam()
    assert beam.x.tolist() == [0.0, 1.0]
    assert beam.mass == pytest.approx(10.5, rel=1e-15)
    assert beam.bending_stiffness.ravel().tolist() == [2000.0, 2000.0]


def test_a_cell_that_may_be_two_numbers(tmp_path):
    (tmp_path / "s.csv").write_text(CSV.replace(",", ";").replace("2000", "2,000"))
    (tmp_path / "b.toml").write_text(BEAM)
    refused(run("beam", tmp_path / "b.toml"), "line 2", "2000 or 2.000")


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("name = \u201cmast\u201d", "straight quotes"),
        ('stations = "C:\\Users\\me\\s.csv"', "single quotes"),
        ("length = 2,5", "2.5"),
        ("speed = 80 m/s", "'80 m/s'"),
        ("name = mast", "in quotes"),
        ("name: 3", "follows '='"),
    ],
)
def test_what_is_no_toml_says_what_to_write(tmp_path, line, words):
    (tmp_path / "b.toml").write_text(f"[beam]\n{line}\n", encoding="utf-8")
    refused(run("beam", tmp_path / "b.toml"), "line 2", words)
