"""The table in README.md, from results.json."""

import json
from pathlib import Path

HERE = Path(__file__).resolve().parent
README, RESULTS = HERE / "README.md", HERE / "results.json"
MARKS = ("<!-- results -->", "<!-- /results -->")
HEAD = ("work", "against", "ratio", "target", "met", "antinode", "peer", "peer's limit")


def text(rows):
    """Table, and the machine below it."""
    lines = [HEAD, ["---"] * len(HEAD), *map(_cells, rows)]
    table = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    return f"{table}\n\n{_machine(rows[0]['machine'])}"


def write(rows):
    """Put the table between the marks in README.md."""
    README.write_text("".join(_parts(text(rows))), encoding="utf-8")


def shown():
    """What README.md has between the marks."""
    whole = README.read_text(encoding="utf-8")
    return whole.split(MARKS[0])[1].split(MARKS[1])[0].strip()


def _parts(table):
    whole = README.read_text(encoding="utf-8")
    before, rest = whole.split(MARKS[0])
    return before, MARKS[0], "\n", table, "\n", MARKS[1], rest.split(MARKS[1])[1]


def _cells(row):
    limit = "none"
    if "peer_within" in row:
        kept = "kept" if row["peer_within"] else "missed"
        limit = f"{duration(row['peer_scaled_limit_s'])}, {kept}"
    return (
        row["work"],
        row["against"],
        f"{row['ratio']:.3g}",
        row["target"],
        "yes" if row["met"] else "no",
        duration(row["antinode_s"]),
        duration(row["peer_s"]),
        limit,
    )


def duration(seconds):
    """Three digits in the unit that suits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= 0.9995 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def _machine(machine):
    versions = ", ".join(f"{name} {number}" for name, number in machine["versions"].items())
    jobs = ", ".join(f"{name}: {duration(t)}" for name, t in machine["calibration_s"].items())
    return (
        f"{machine['processor']}, {machine['cpu_count']} processors; {machine['date']}.\nPython "
        f"{machine['python']}, {versions}.\nThe machine itself: {jobs}; "
        f"{machine['scale']:.3g} times what it takes when quiet."
    )


if __name__ == "__main__":
    write(json.loads(RESULTS.read_text(encoding="utf-8")))
