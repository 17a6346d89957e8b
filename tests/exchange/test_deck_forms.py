"""Forms in which decks are written: repetition, marks, long lines, included files, lists."""

import numpy as np
import pytest

from antinode import InputError, solve_modes
from antinode.exchange.nastran.deck import read_deck
from antinode.exchange.nastran.lines import MOST_BYTES
from exchange.test_decks_of_others import (
    BARS,
    CLAMP,
    FIRST,
    GRIDS,
    HEAD,
    MAT1,
    PBAR,
    first,
    read,
)

REST = PBAR + MAT1 + CLAMP
SAME = {
    "grids by =n": (GRIDS, "GRID,1,,0.,0.,0.\n=,*(1),,*(1.),==\n=(1)\n"),
    "by =(n) with its steps": (GRIDS, "GRID,1,,0.,0.,0.\n=(2),*(1),=,*(1.),==\n"),
    "by =n in small fields": (
        GRIDS,
        "GRID           1              0.      0.      0.\n"
        "=       *(1)    =       *(1.)   ==\n=1\n",
    ),
    "elements": (BARS, "CBAR,1,1,1,2,0.,1.,0.\n=,*(1),=,*(1),*(1),==\n"),
    "the name, and = further on": (BARS, "CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,=,2,3,==\n"),
    "a step that is real": (
        GRIDS,
        "GRID,1,,0.\nGRID,2,,1.\n=,3,=,*(1.),==\n",
    ),
    "marks with two signs": (
        PBAR,
        "PBAR    1       1       1.-3    2.-6    3.-6            .5              +000001\n"
        "++000001 .1\n",
    ),
    "a mark below another card": (
        PBAR,
        "PBAR,1,1,1.-3,2.-6,3.-6,,0.5,,+B\nPBAR,2,1,1.-3,2.-6,3.-6,,0.5,,+C\n+C,.1\n+B,.1\n",
    ),
    "a mark above its card": (PBAR, "+B,.1\nPBAR,1,1,1.-3,2.-6,3.-6,,0.5,,+B\n"),
    "a mark with blanks": (
        PBAR,
        "PBAR    1       1       1.-3    2.-6    3.-6            .5              +      A\n"
        "+      A.1\n",
    ),
    "more than ten fields": (PBAR, "PBAR,1,1,1.-3,2.-6,3.-6,,0.5,,.1,.1,.1,.1,,,,,,,0.\n"),
    "a blank before the star": (
        MAT1,
        "MAT1   *               1          2.1+11                              .3\n"
        "*                  7850.\n",
    ),
    "a blank before the exponent": (MAT1, "MAT1,1,2.1 +11,,.3,7.85 +3\n"),
    "BEGIN_BULK": (HEAD, HEAD.replace("BEGIN BULK", "BEGIN_BULK")),
    "matrices that nothing chooses": (MAT1, MAT1 + "DMIG,STIF,0,6,1\nDMIG,STIF,2,2,,2,2,1.+9\n"),
    "a list with THRU and BY": (CLAMP, "SPC1,7,123456,1\nSPC1,6,2,2,THRU,9,BY,3\n"),
}


@pytest.mark.parametrize("what", SAME)
def test_the_same_bar_written_in_other_ways(what, tmp_path):
    old, new = SAME[what]
    text = HEAD + GRIDS + BARS + REST
    assert old in text
    beam, _ = read(tmp_path, text.replace(old, new, 1), head="")
    np.testing.assert_allclose(beam.x, [0, 1, 2], atol=1e-12)
    assert first(beam) == pytest.approx(FIRST, rel=1e-8)


WRONG = {
    "nothing before": ("=,1,,0.\n" + GRIDS, "none is before it"),
    "another card": (GRIDS + "CBAR,1,=\n", "fields of another card, GRID"),
    "a word": ("GRID,A\n=,*(1)\n", "cannot be added to 'A'"),
    "no step": ("GRID,1\n=,*(x)\n", "cannot be added"),
    "too many": ("GRID,1\n=(999999),*(1)\n", "more than 100000 cards"),
    "a continuation": (PBAR + "+,=\n", "a continuation that repeats"),
    "a mark twice": ("PBAR,1,,,,,,,,+A\nGRID,1\n+A,1\n+A,2\n", "another line continues as 'A'"),
    "no such mark": ("PBAR,1,,,,,,,,+A\n+B,1\n", "no card continues as 'B'"),
    "a quote that stays open": ("INCLUDE 'a\n", "not closed"),
    "a part": ("BEGIN SUPER=2\n", "superelement"),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_cannot_be_read_is_said_with_its_line(what, tmp_path):
    text, words = WRONG[what]
    path = tmp_path / "deck.bdf"
    path.write_text("BEGIN BULK\n" + text + "ENDDATA\n")
    with pytest.raises(InputError, match=words) as error:
        read_deck(path)
    assert "line " in str(error.value)


class TestIncludes:
    def bulk(self, tmp_path, line, name="parts/more.inc", text=REST):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return read(tmp_path, GRIDS, BARS, line)

    @pytest.mark.parametrize(
        "line",
        [
            "INCLUDE 'parts\\more.inc'\n",
            'include "parts/more.inc"\n',
            "INCLUDE 'parts/\nmore.inc'\n",
        ],
    )
    def test_their_paths(self, line, tmp_path):
        beam, _ = self.bulk(tmp_path, line)
        assert first(beam) == pytest.approx(FIRST, rel=1e-8)

    def test_from_a_folder_back_to_that_of_the_deck(self, tmp_path):
        (tmp_path / "last.inc").write_text(CLAMP)
        text = PBAR + MAT1 + "INCLUDE 'last.inc'\n"
        beam, _ = self.bulk(tmp_path, "INCLUDE 'parts/more.inc'\n", text=text)
        assert beam.ends.left == "clamped"

    def test_what_only_directs_a_solver_may_be_missing(self, tmp_path):
        beam, notes = read(
            tmp_path, GRIDS, BARS, REST, head=HEAD.replace("CEND", "INCLUDE 'alter.v9'\nCEND")
        )
        assert first(beam) == pytest.approx(FIRST, rel=1e-8)
        assert any("alter.v9" in note for note in notes)
        with pytest.raises(InputError, match="line 12: INCLUDE: there is no file 'gone'"):
            read(tmp_path, GRIDS, BARS, "INCLUDE 'gone'\n")

    def test_files_that_double_themselves_are_bounded(self, tmp_path):
        for k in range(30):
            (tmp_path / f"{k}.inc").write_text(f"INCLUDE '{k + 1}.inc'\n" * 2)
        (tmp_path / "30.inc").write_text("")
        with pytest.raises(InputError, match="500 files"):
            read(tmp_path, GRIDS, "INCLUDE '0.inc'\n")
        assert MOST_BYTES < 1e8


def test_rigid_elements_by_lists(tmp_path):
    grids = GRIDS + "GRID,9,,2.4\nGRID,11,,2.4\nGRID,13,,2.4\n"
    mass = "CONM2,21,11,,5.\nCONM2,22,13,,2.\n"
    for tie in (
        "RBE2,20,3,123456,9,THRU,13\n",
        "RBE2,20,3,123456,11,13,1.-5\n",
        "CRIGD1,20,3,9,THRU,13\n",
    ):
        beam, _ = read(tmp_path, grids, BARS, REST, tie, mass)
        assert [(m.x, m.mass, round(m.offset, 12)) for m in beam.attachments] == [
            (2.0, 5.0, 0.4),
            (2.0, 2.0, 0.4),
        ]


def test_bars_without_mass_carry_those_at_the_grids(tmp_path):
    light = REST.replace(",,0.5", "").replace("7850.", "")
    beam, notes = read(tmp_path, GRIDS, BARS, light, "CONM2,9,3,,4.\n")
    assert any("bars without mass" in note for note in notes)
    # a mass on a spring of 3 EI/L^3
    wanted = np.sqrt(3 * 4.2e5 / 8 / 4.0) / (2 * np.pi)
    assert first(beam) == pytest.approx(wanted, rel=1e-8)
    with pytest.raises(InputError, match="PBAR: mass per length is 0, and no CONM2"):
        read(tmp_path, GRIDS, BARS, light)
    both = solve_modes(read(tmp_path, GRIDS, BARS, light, "CONM2,9,3,,4.\nCONM2,8,2,,4.\n")[0], 2)
    a, b, k = 1 / 3, 8 / 3, 5 / 6  # flexibility of the cantilever at 1 m and 2 m, times EI
    roots = np.linalg.eigvalsh(np.array([[a, k], [k, b]]) * 4 / 4.2e5)
    assert both.frequencies_hz() == pytest.approx(1 / (2 * np.pi * np.sqrt(roots[::-1])), rel=1e-8)


def test_supports_of_other_sets_are_listed(tmp_path):
    _, notes = read(tmp_path, GRIDS, BARS, REST, "SPC1,8,2,3\nSPC1,9,2,2,3\nSPC,8,2,2\n")
    assert any("1 SPC, 2 SPC1" in note for note in notes)
    free, notes = read(tmp_path, GRIDS, BARS, REST, head=HEAD.replace("SPC = 7\n", ""))
    assert free.ends.left == "free"
    assert any("1 SPC1" in note for note in notes)


def test_a_matrix_that_the_case_control_chooses(tmp_path):
    for line, card in (("K2GG = STIF", "DMIG,STIF,0,6,1"), ("TFL = 3", "TF,3,2,2,1.")):
        with pytest.raises(InputError, match=f"chooses {line.split()[0]}"):
            read(
                tmp_path, GRIDS, BARS, REST, card + "\n", head=HEAD.replace("CEND", f"CEND\n{line}")
            )


def test_scalar_points_of_a_larger_model_do_not_matter(tmp_path):
    more = "SPOINT,900\nSPC,7,900,,0.\nCELAS2,50,1.+3,900,,2,2\nSPC,7,3,,0.\n"
    beam, _ = read(tmp_path, GRIDS, BARS, REST, more, elements=(range(1, 3),))
    assert first(beam) == pytest.approx(FIRST, rel=1e-8)
    with pytest.raises(InputError, match="names no freedoms"):
        read(tmp_path, GRIDS, BARS, REST, "SPC,7,3,,0.\n")
