"""Tables of cases in a file, of any length: read by chunk, refused where they cannot be."""

import pickle

import numpy as np
import polars
import pytest

import antinode as an
from antinode.study.design import table as of_tables
from antinode.study.design.points import points_of
from antinode.study.sweep.contents import study_hash
from cli_run import refused, run

ROWS = 30_000


@pytest.fixture(scope="module")
def drawn():
    rng = np.random.default_rng(11)
    return rng.uniform(70, 100, ROWS), rng.uniform(40, 60, ROWS)


@pytest.fixture
def folder(tmp_path):
    run("init", tmp_path)
    (tmp_path / "study.toml").write_text(
        'case = "case.toml"\n[design]\nkind = "zip"\ntable = "cases.csv"\n[solve]\nmodes = 2\n'
    )
    return tmp_path


def write(folder, lines):
    (folder / "cases.csv").write_text("\n".join(lines) + "\n")


def lines_of(drawn, rows=ROWS):
    speed, thrust = drawn
    return [
        "# drawn by a neighbour",
        "speed [m/s], thrust [kN]",
        *(f"{a!r}, {b!r}" for a, b in zip(speed[:rows].tolist(), thrust.tolist(), strict=False)),
    ]


def load(folder, **settings):
    return an.load_study(folder / "study.toml", [f"{k}={v}" for k, v in settings.items()])


def test_every_chunk_holds_its_rows(folder, drawn):
    """Comments and empty lines between the rows, chunks that no block of the file begins with."""
    lines = lines_of(drawn)
    lines[5000:5000] = ["# a break", "", " , "]
    write(folder, lines)
    points = pickle.loads(pickle.dumps(points_of(load(folder, **{"run.chunk": 999}))))
    assert points.cases == ROWS
    for chunk in (0, 3, 4, 5, 17, points.chunks - 1):
        start, stop = points.bounds(chunk)
        values = points.values(chunk)
        assert np.array_equal(values[:, 0], drawn[0][start:stop])
        assert values[:, 1] == pytest.approx(1e3 * drawn[1][start:stop], rel=1e-15)


def test_a_chunk_is_all_that_is_read(folder, drawn, monkeypatch):
    write(folder, lines_of(drawn))
    points, seen = points_of(load(folder)), []
    rows = of_tables._rows
    monkeypatch.setattr(
        of_tables, "_rows", lambda *given: (seen.append(1) or row for row in rows(*given))
    )
    points.values(6)
    assert len(seen) <= 4096


def test_parquet_gives_the_same_cases(folder, drawn):
    write(folder, lines_of(drawn))
    speed, thrust = drawn
    polars.DataFrame({"speed [m/s]": speed, "thrust [kN]": thrust}).write_parquet(
        folder / "cases.parquet"
    )
    of_csv = points_of(load(folder))
    of_parquet = points_of(load(folder, **{"design.table": "cases.parquet"}))
    for chunk in (0, 7):
        assert np.array_equal(of_csv.values(chunk), of_parquet.values(chunk))


def test_a_sweep_of_it_is_that_of_the_same_values_in_the_study(folder, drawn):
    write(folder, lines_of(drawn, 12))
    found = an.sweep(load(folder))
    speed, thrust = drawn
    inline = (folder / "study.toml").read_text().replace('table = "cases.csv"\n', "")
    for key, values in (("speed", speed[:12]), ("thrust", 1e3 * thrust[:12])):
        inline += f'[[inputs]]\nkey = "{key}"\nvalues = {values.tolist()}\n'
    (folder / "inline.toml").write_text(inline)
    same = an.sweep(an.load_study(folder / "inline.toml"))
    assert found.frequency_hz.values == pytest.approx(same.frequency_hz.values, rel=1e-12)
    assert np.array_equal(found.speed.values, same.speed.values)


def test_another_file_is_another_study(folder, drawn):
    write(folder, lines_of(drawn, 9))
    before = study_hash(load(folder))
    assert study_hash(load(folder)) == before
    write(folder, [line.replace("# drawn", "# made") for line in lines_of(drawn, 9)])
    assert study_hash(load(folder)) != before


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("speed [m/s];thrust [kN]\n80,5;50\n81;51,25\n", "utf-8"),
        ("speed [m/s]\tthrust [kN]\n80.5\t50\n81\t51.25\n", "utf-16"),
        ("speed,thrust\n80.5 m/s,50 kN\n291.6 km/h,51.25 kN\n", "cp1252"),
        ('sep=,\n"speed [m/s]","thrust [kN]"\n80.5,50\n81,51.25\n', "utf-8-sig"),
    ],
)
def test_what_spreadsheets_write_is_read(folder, text, encoding):
    (folder / "cases.csv").write_bytes(text.encode(encoding))
    values = points_of(load(folder)).values(0)
    assert values == pytest.approx(np.array([[80.5, 50e3], [81.0, 51.25e3]]), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ((25_001, "fast, 50"), ["cases.csv, line 25002", "fast"]),
        ((25_001, "80, nan"), ["cases.csv, line 25002", "nan"]),
        ((25_001, "80, 50, 1"), ["cases.csv, line 25002: 3 cells, but 2"]),
        ((25_001, "80, 5 mm"), ["cases.csv, line 25002", "mm"]),
        ((1, "speed [m/s], rotor"), ["rotor", "leads nowhere"]),
        ((1, "speed [m/s, thrust"), ["'speed [m/s' is no column"]),
    ],
)
def test_a_wrong_row_is_told_before_anything_is_solved(folder, drawn, change, words):
    lines = lines_of(drawn)
    lines[change[0]] = change[1]
    write(folder, lines)
    refused(run("sweep", folder / "study.toml", "-o", folder / "out.zarr"), *words)
    assert not (folder / "out.zarr").exists()


def test_times_that_go_back_are_told_across_blocks(folder):
    write(folder, ["time, speed", *(f"{k if k != 4096 else 7}, 80" for k in range(4200))])
    refused(run("sweep", folder / "study.toml"), "7 s comes after 4095 s", "lines 4097 and 4098")


def test_no_rows_and_no_file(folder):
    write(folder, ["speed, thrust"])
    refused(run("sweep", folder / "study.toml"), "no rows")
    (folder / "cases.csv").unlink()
    refused(run("sweep", folder / "study.toml"), "cases.csv")
    (folder / "cases.parquet").write_bytes(b"speed\n80\n")
    told = run("sweep", folder / "study.toml", "--set", "design.table=cases.parquet")
    refused(told, "no Parquet file")
