"""The lowest versions that pyproject.toml allows, and the newest that an index serves, tried.

    python -m validation.versions lowest
    python -m validation.versions newest

Each is an environment of its own, the lowest with its lower bounds as constraints, the newest with
none; the main commands are run there, and every warning of Python is shown. The page (extra `web`)
is left out of the lowest: what it needs asks for newer versions of its own. Takes some minutes;
writes lowest_versions.md or newest_versions.md.
"""

import os
import re
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
EXTRAS = ("plot", "sweep", "dask", "dataset", "exchange", "report", "parquet", "prove")
SAID = {
    "lowest": "the lowest versions that pyproject.toml allows",
    "newest": "the newest versions that the index served, without constraints",
}
COMMANDS = """
verify
init starter
modes starter/case.toml
loads starter/case.toml
modes starter/case.toml --plot modes.png -o modes.nc
report starter/case.toml -o report.pdf
init tower --example tower
beam tower/beam.toml --buckling
beam tower/beam.toml --prove
convert tower/beam.toml tower.bdf
convert tower/beam.toml tower.xlsx
beam tower.xlsx
init rocket --example rocket
stability rocket/beam.toml
init response --example response
response response/response.toml --plot response.png
init sweep --example sweep
sweep sweep/study.toml -o sweep.zarr --plot sweep.png
ask sweep.zarr
ask sweep.zarr -o sweep.parquet
sensitivity sweep/samples.toml
init mast --example mast
sweep mast/study.toml -o mast.zarr
reproduce --out paper
"""


def lowest():
    """Return ``name==version`` of every lower bound, in order of names."""
    found = (re.fullmatch(r"([\w-]+)>=([\d.]+).*", each) for each in asked())
    return sorted({f"{match[1]}=={match[2]}" for match in found if match})


def asked(extras=EXTRAS):
    """Return the requirements of the package and of these extras, as they are written."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return [*project["dependencies"], *(r for e in extras for r in
                                        project["optional-dependencies"][e])]  # fmt: skip


def installed(python, names):
    """Return ``name==version`` of what stands in an environment, of these names."""
    listed = subprocess.run([python, "-m", "pip", "freeze"], capture_output=True, text=True,
                            check=True)  # fmt: skip
    pinned = [line for line in listed.stdout.split() if "==" in line]
    return [line for line in pinned if line.partition("==")[0].lower() in names]


def tried(binary, place):
    """Run the commands; return a row of the record for each, and how many failed or warned."""
    rows, failed = [], 0
    for line in COMMANDS.strip().splitlines():
        done = subprocess.run(
            [binary / "antinode", *line.split()],
            cwd=place,
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "PYTHONWARNINGS": "default", "PYTHONPATH": ""},
        )
        warned = re.findall(r"\b(\w+Warning: [^\n|]*)", done.stderr)
        told = "; ".join(dict.fromkeys(warned)) or "done"
        if done.returncode:
            told = (done.stderr.strip() or "no word").splitlines()[-1]
        failed += told != "done"
        rows.append(f"| `antinode {line}` | {told} |")
        print(rows[-1], flush=True)
    return rows, failed


def main(which):
    """Install, run, write the record; return how many commands did not end well."""
    extras = [*EXTRAS, *(["web"] if which == "newest" else [])]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        venv.create(place / "venv", with_pip=True)
        binary = place / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
        (place / "bounds.txt").write_text("\n".join(lowest() if which == "lowest" else []) + "\n")
        install = [binary / "python", "-m", "pip", "install", "-q", "-c", place / "bounds.txt"]
        subprocess.run([*install, f"{ROOT}[{','.join(extras)}]"], check=True)
        names = {re.match(r"[\w-]+", each)[0].lower() for each in asked(extras)}
        pins = installed(binary / "python", names)
        rows, failed = tried(binary, place)
    python = ".".join(map(str, sys.version_info[:3]))
    text = [
        f"# {which.capitalize()} versions",
        "",
        f"Written by `python -m validation.versions {which}`: the main commands with {SAID[which]},"
        f" Python {python}. A warning of Python's would stand here as well.",
        "",
        ", ".join(f"`{pin}`" for pin in pins),
        "",
        "| command | |",
        "|---|---|",
        *rows,
    ]
    (Path(__file__).parent / f"{which}_versions.md").write_text("\n".join(text) + "\n")
    return failed


if __name__ == "__main__":
    if sys.argv[1:] not in ([["lowest"], ["newest"]]):
        sys.exit(__doc__)
    sys.exit(bool(main(sys.argv[1])))
