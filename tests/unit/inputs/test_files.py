"""Reading files: what a table of stations may look like, overrides, limits, and where a key is."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from antinode import InputError, load_beam, load_case
from antinode.beam.attachments import PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.file import BeamFile
from antinode.beam.limits import check_limits
from antinode.examples import EXAMPLES, write_example
from antinode.inputs.explain import key_text, validate
from antinode.inputs.override import override
from antinode.inputs.reading import MOST_ROWS, read_csv, read_toml
from antinode.inputs.units import Frozen
from antinode.text import nearest, one_line, short
from antinode.vehicle.case import Case
from antinode.vehicle.vehicle import Vehicle
from cli_run import refused, run

COLUMNS = ("x", "mass_per_length", "bending_stiffness")
TABLE = "x [mm],mass_per_length [kg/m],bending_stiffness [kN m^2]\n0,1,2\n500,3,4\n"
WANTED = {"x": [0.0, 0.5], "mass_per_length": [1.0, 3.0], "bending_stiffness": [2e3, 4e3]}


def csv_file(folder, content, name="stations.csv"):
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
    return path


class TestCsv:
    @pytest.mark.parametrize(
        "content",
        [
            TABLE,
            TABLE.replace("\n", "\r\n"),
            TABLE.replace("\n", "\r"),
            TABLE.rstrip("\n"),
            b"\xef\xbb\xbf" + TABLE.encode(),  # a byte order mark
            "# a comment\n\n" + TABLE + "\n\n# another\n",
            TABLE.replace("0,1,2\n", "0,1,2\n,,\n  \n , ,\n"),  # empty rows of a spreadsheet
            TABLE.replace(",", " , "),
            'x [mm],"mass_per_length [kg/m]","bending_stiffness [kN m^2]"\n"0",1,2\n500,3,"4"\n',
            TABLE.replace("kN m^2", "kN·m²"),
            "x,mass_per_length,bending_stiffness\n0,1,2000\n0.5,3,4e3\n",
        ],
    )
    def test_one_table_in_many_dresses(self, tmp_path, content):
        assert read_csv(csv_file(tmp_path, content), COLUMNS) == WANTED

    def test_a_last_row_with_x_alone_closes_the_table(self, tmp_path):
        table = read_csv(csv_file(tmp_path, TABLE + "750,,\n"), COLUMNS)
        assert table["x"] == [0.0, 0.5, 0.75]
        assert table["mass_per_length"] == [1.0, 3.0, 3.0]

    @pytest.mark.parametrize(
        ("content", "words"),
        [
            ("", ["the table is empty", "header such as"]),
            ("# nothing\n\n", ["the table is empty"]),
            ("x [mm]\n", ["less than two rows"]),
            ("x [mm]\n0\n", ["less than two rows"]),
            (TABLE.replace("x [mm]", ""), ["header", "no name"]),
            (TABLE.replace("x [mm]", "y [mm]"), ["header", "unknown column 'y'"]),
            (TABLE.replace("mass", "mas"), ["'mas_per_length'", "did you mean mass_per_length?"]),
            (TABLE.replace("mass_per_length", "x"), ["column x stands there twice"]),
            (TABLE.replace("kg/m", "kg"), ["column mass_per_length", "'kg' is no unit of kg/m"]),
            (TABLE.replace("kg/m", "9^9^9^9"), ["no unit of kg/m"]),
            (TABLE.replace("[mm]", "[mm"), ["column x", "not closed"]),
            (TABLE.replace("x [mm]", "x:full [mm]"), ["unknown column 'x:full'"]),
            (TABLE.replace("0,1,2", "0,1"), ["line 2", "2 cells, but 3 in the header"]),
            (TABLE.replace("0,1,2", "0,1,2,3"), ["line 2", "4 cells, but 3 in the header"]),
            ("\n# c\n" + TABLE.replace("0,1,2", "0,,2"), ["line 4", "mass_per_length", "''"]),
            (TABLE.replace("500,3,4", "500,3,"), ["line 3", "bending_stiffness"]),
            (TABLE.replace("0,1,2", "0,heavy,2"), ["'heavy'", "give a number"]),
            (TABLE.replace("0,1,2", "0,1 kg/m,2"), ["'1 kg/m'", "unit stands in the header"]),
            (TABLE.replace("0,1,2", "0,nan,2"), ["'nan'", "finite"]),
            (TABLE.replace("0,1,2", "0,-inf,2"), ["'-inf'", "finite"]),
            (TABLE.replace("0,1,2", "0,1e400,2"), ["'1e400'", "finite"]),
            (TABLE.replace("0,1,2", "0," + "9" * 5000 + ",2"), ["9...9", "finite"]),
            (TABLE.replace("0,1,2", '"0,1,2'), ["line 2", "1 cells"]),
            (b"\xff\xfe" + b"a", ["UTF-8"]),
            (bytes(range(256)), ["UTF-8"]),
            (b"\0" * 1000, ["header"]),
            (b"x" * 200_000, ["line 1", "no CSV table"]),
            ("x\n" + "1\n" * (MOST_ROWS + 1), [f"more than {MOST_ROWS} rows"]),
            (b"1," * 500_000, ["header"]),
            (b"ab,cd\n" * 1_700_000, ["rows"]),
            (b"#" * 20_000_001, ["20.0 MB", "20 MB allowed"]),
        ],
    )
    def test_a_bad_table_is_refused_in_one_sentence(self, tmp_path, content, words):
        path = csv_file(tmp_path, content)
        with pytest.raises(InputError) as refusal:
            read_csv(path, COLUMNS)
        for word in [str(path), *words]:
            assert word in str(refusal.value)
        assert len(str(refusal.value)) < 500 + len(str(path))


class TestToml:
    @pytest.mark.parametrize(
        ("content", "words"),
        [
            (b"hello world", "Expected '=' after a key"),
            (b'{"a": 1}', "not valid TOML"),
            (b"a = 1\na = 2", "Cannot overwrite"),
            (b"a = " + b"[" * 5000, "nested too deeply"),
            (b"a = " + b"{a=" * 3000 + b"1" + b"}" * 3000, "nested too deeply"),
            (b"a = 1" + b"0" * 5000, "thousands of digits"),
            (b"a = 1 \xe9", "UTF-8"),
            (bytes(range(256)), "UTF-8"),
            (b"\0" * 100, "not valid TOML"),
            (b"a = 1\n" * 400_000, "2.4 MB is more than the 2 MB"),
            (b"# \n" * 3_500_000, "10.5 MB"),
        ],
    )
    def test_garbage(self, tmp_path, content, words):
        path = csv_file(tmp_path, content, "case.toml")
        with pytest.raises(InputError) as refusal:
            read_toml(path)
        assert words in str(refusal.value)
        assert str(path) in str(refusal.value)

    def test_places_that_are_no_file(self, tmp_path):
        (tmp_path / "case.toml").write_text("a = 1\n")
        for path, words in (
            (tmp_path, "this is a folder"),
            (tmp_path / "no.toml", "antinode init"),
            (tmp_path / "cas.toml", f"did you mean {tmp_path / 'case.toml'}?"),
            (tmp_path / "no" / "case.toml", "does not exist either"),
            (tmp_path / "case.toml" / "x", "no such file"),
            (tmp_path / ("x" * 300), "File name too long"),
            (Path("/dev/zero"), "no regular file"),
            (Path("a\0b"), "no such file"),
        ):
            with pytest.raises(InputError) as refusal:
                read_toml(path)
            assert words in str(refusal.value)

    def test_a_byte_order_mark_and_foreign_line_ends(self, tmp_path):
        path = csv_file(tmp_path, b"\xef\xbb\xbfa = 1\r\nb = 2\r\n", "x.toml")
        assert read_toml(path) == {"a": 1, "b": 2}


class TestOverride:
    def changed(self, *assignments):
        tables = {"a": {"b": 1}, "fins": [{"t": 1}, {"t": 2}], "name": "x", "empty": []}
        override(tables, assignments)
        return tables

    @pytest.mark.parametrize(
        ("assignment", "keys", "value"),
        [
            ("a.b=2", ("a", "b"), 2),
            ("a.b = 2.5", ("a", "b"), 2.5),
            ("a.b=100m/s", ("a", "b"), "100m/s"),
            ('a.b="100 m/s"', ("a", "b"), "100 m/s"),
            ("a.b=a=b", ("a", "b"), "a=b"),
            ("a.b=", ("a", "b"), ""),
            ("a.b=true", ("a", "b"), True),
            ("a.b=[1, 2]", ("a", "b"), [1, 2]),
            ("a.b={c = 1}", ("a", "b"), {"c": 1}),
            ("a.b=1\n[x]", ("a", "b"), "1\n[x]"),
            ("a.b=" + "[" * 5000, ("a", "b"), "[" * 5000),
            ("a.b=" + "9" * 5000, ("a", "b"), "9" * 5000),
            ("fins.1.t=7", ("fins", 1, "t"), 7),
            ("fins[1].t=7", ("fins", 1, "t"), 7),
            ("new.table.key=1", ("new", "table", "key"), 1),
        ],
    )
    def test_sets(self, assignment, keys, value):
        here = self.changed(assignment)
        for key in keys:
            here = here[key]
        assert here == value

    def test_the_last_one_wins(self):
        assert self.changed("a.b=2", "a.b=3")["a"]["b"] == 3

    @pytest.mark.parametrize(
        ("assignment", "words"),
        [
            ("x", "table.key=value"),
            ("", "table.key=value"),
            ("=1", "table.key=value"),
            ("a..b=1", "table.key=value"),
            ("a." * 3000 + "a=1", "table.key=value"),
            ("fins.2.t=1", "from 0 to 1"),
            ("fins.-1.t=1", "from 0 to 1"),
            ("fins.².t=1", "from 0 to 1"),
            ("fins.t=1", "from 0 to 1"),
            ("fins." + "9" * 50 + ".t=1", "from 0 to 1"),
            ("empty.0.t=1", "list of 0"),
            ("name.x=1", "name holds a value"),
        ],
    )
    def test_refuses(self, assignment, words):
        with pytest.raises(InputError, match=r"^--set") as refusal:
            self.changed(assignment)
        assert words in str(refusal.value)
        assert len(str(refusal.value)) < 300


class TestKeys:
    def test_locations_are_written_as_set_takes_them(self):
        for location, key in (
            (("vehicle", "fins", 0, "thickness"), "vehicle.fins.0.thickness"),
            (("vehicle", "fins", 0, "roll_angles", 1), "vehicle.fins.0.roll_angles.1"),
            (
                ("vehicle", "stations", "mass_per_length", "initial"),
                "vehicle.stations.mass_per_length",
            ),
            (
                ("vehicle", "stations", "mass_per_length", "burnt"),
                "vehicle.stations.mass_per_length:burnt",
            ),
            (("condition", "speed", "function-wrap[check()]"), "condition.speed"),
            (("condition", "float", "speed"), "condition.speed"),
            ((), ""),
        ):
            assert key_text(Case, location) == key
        assert key_text(Case, ("vehicle", "fins", 0, "x[0]"), unknown=True) == "vehicle.fins.0.x[0]"

    def test_tags_of_unions_are_no_keys(self):
        class A(Frozen):
            kind: Literal["a"]
            size: int

        class B(Frozen):
            kind: Literal["b"]
            width: float

        class File(Frozen):
            parts: tuple[A | B, ...]

        with pytest.raises(InputError) as refusal:
            validate(File, {"parts": [{"kind": "a", "size": "x", "width": 1.0}]}, "f.toml")
        assert "parts.0" in str(refusal.value)
        assert ".A" not in str(refusal.value)
        assert ".B" not in str(refusal.value)

    def test_words(self):
        assert short(True) == "true"
        assert short("a\n\x1b[31m b") == "'a [31m b'"
        assert short([[[[[1]]]]]) == "[[[[...]]]]"
        assert len(short("x" * 10_000)) == 62
        assert len(short({str(k): "x" * 1000 for k in range(1000)})) <= 60
        assert "thousands of digits" in short(10**6000)
        assert one_line("a" * 50 + "end", 20).endswith("end")
        assert nearest("sped", ["speed", "depth"]) == "did you mean speed?"
        assert nearest("zzz", ["speed", "depth"]) == "allowed are speed, depth"
        assert nearest("wall_thickness", ["axial_stiffness", "wall"]) == "did you mean wall?"


def uniform(length=2.0, m=1.0, EI=1.0, N=0.0, EA=None):
    one = np.ones(3)
    x = np.array([0.0, length / 2, length])
    return Beam.from_stations(x, m * one, EI * one, None if EA is None else EA * one, N * one)


PINNED = replace(uniform(), ends=Ends("pinned", "free"))


class TestLimits:
    def test_a_support_beside_an_end_that_is_held(self):
        with pytest.raises(InputError, match="x = 0 m and x = 1e-09 m"):
            PINNED.with_attachments(Spring(1e-9, math.inf))

    @pytest.mark.parametrize(
        "beam",
        [
            uniform(),
            uniform(length=1e-6),
            uniform(length=1e6),
            uniform(m=1e-20, EI=1e20),
            uniform(N=-1e5),
            uniform(N=100.0),
            PINNED.with_attachments(Spring(0.0, math.inf), Spring(3e-8, math.inf)),
        ],
    )
    def test_large_and_small_are_allowed(self, beam):
        check_limits(beam)

    @pytest.mark.parametrize(
        ("beam", "words"),
        [
            (uniform(length=1e-12), "check the unit of x"),
            (uniform(length=1e12), "check the unit of x"),
            (uniform(m=1e-300), "mass_per_length runs from 1e-300"),
            (uniform(EI=1e300), "bending_stiffness"),
            (uniform(EA=1e-31), "axial_stiffness"),
            (uniform(EI=np.array([1e-7, 1e6, 1.0])), "a ratio of at most 1e+12"),
            (uniform(N=1e6), "modes diverge"),
            (uniform(N=1e300), "modes diverge"),
            (uniform(N=-1e10), "tension"),
            (uniform().with_attachments(PointMass(0.5, 1e20)), "hold the beam there by a support"),
        ],
    )
    def test_beyond_all_reason(self, beam, words):
        with pytest.raises(InputError) as refusal:
            check_limits(beam)
        assert words in str(refusal.value)


def test_supports_that_all_but_coincide(tmp_path):
    run("init", "--beam", tmp_path)
    text = (tmp_path / "beam.toml").read_text()
    for x in (0.1, 0.10000000001):
        text += f"[[beam.springs]]\nx = {x}\ntranslational = inf\n"
    (tmp_path / "beam.toml").write_text(text)
    words = ("beam.toml", "x = 0.1 m and x = 0.10000000001 m", "at least", "the same x")
    refused(run("beam", tmp_path / "beam.toml"), *words)


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_load(name, tmp_path):
    files, _ = write_example(name, tmp_path)
    load = load_case if (tmp_path / "case.toml").exists() else load_beam
    names = ("case.toml", "beam.toml")
    assert load(next(f for f in files if f.name in names)).beam().mass > 0


def test_stations_may_lie_in_another_folder(tmp_path):
    (tmp_path / "tables").mkdir()
    csv_file(tmp_path / "tables", TABLE)
    file = csv_file(tmp_path, '[beam]\nstations = "tables/stations.csv"\n', "beam.toml")
    beam = load_beam(file).beam()
    assert beam.length == 0.5
    assert np.array_equal(beam.bending_stiffness, [[2e3, 2e3]])


def test_inline_columns_take_units(tmp_path):
    text = (
        "[beam]\nstations = { x = [0, '50 cm'], mass_per_length = ['1 g/mm', 1], "
        "bending_stiffness = [1, inf] }\n"
    )
    file = csv_file(tmp_path, text, "beam.toml")
    with pytest.raises(InputError, match="bending_stiffness, row 2, is inf"):
        load_beam(file)
    beam = load_beam(file, ["beam.stations.bending_stiffness=[1, 1]"]).beam()
    assert math.isclose(beam.mass, 0.5)


def test_too_many_inline_rows(tmp_path):
    rows = ", ".join(map(str, range(MOST_ROWS + 1)))
    file = csv_file(tmp_path, f"[beam]\nstations = {{ x = [{rows}] }}\n", "beam.toml")
    with pytest.raises(InputError, match=f"beam.stations.x has {MOST_ROWS + 1} rows"):
        load_beam(file)


STEPPED = {"x": [0, 1, 3], "mass_per_length": [5, "7 kg/m"], "bending_stiffness": ["1 kN m^2", 9]}


class TestStepsWithoutTheClosingRow:
    def test_the_last_row_is_repeated(self):
        file = validate(BeamFile, {"beam": {"stations": STEPPED}}, "here")
        assert file.table.stations.mass_per_length.tolist() == [5, 7, 7]
        assert file.beam().mass == 5 + 2 * 7
        assert len(STEPPED["mass_per_length"]) == 2

    @pytest.mark.parametrize(
        "change",
        [
            {"interpolation": "linear"},
            {"stations": {**STEPPED, "mass_per_length": [5, 7, 7]}},
            {"stations": {**STEPPED, "x": [0, 1, 3, 4]}},
        ],
    )
    def test_all_columns_leave_it_out_or_none(self, change):
        with pytest.raises(InputError, match="2 rows, but x has"):
            validate(BeamFile, {"beam": {"stations": STEPPED, **change}}, "here")

    def test_a_vehicle_too(self):
        columns = ("mass_per_length", "mass_per_length:burnt", "bending_stiffness",
                   "axial_stiffness", "radius")  # fmt: skip
        table = {"stations": {"x": [0, 2], **{name: [0.1] for name in columns}}}
        vehicle = Vehicle.model_validate({**table, "cavitator": {"diameter": 0.1}})
        assert [len(column) for _, column, _ in vehicle.stations.columns()] == [2] * 5
