"""The lowest versions that pyproject.toml allows: installed, and the main commands run with them.

    python -m validation.lowest_versions

The page (extra `web`) is left out: what it needs asks for newer versions of its own. Takes some
minutes; writes lowest_versions.md.
"""

import re
import subprocess
import sys
import tempfile
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).parents[1]
EXTRAS = ("plot", "sweep", "dask", "dataset", "exchange", "report", "parquet")
COMMANDS = """
init starter
modes starter/case.toml
loads starter/case.toml
modes starter/case.toml --plot modes.png -o modes.nc
report starter/case.toml -o report.pdf
init tower --example tower
beam tower/beam.toml --buckling
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
    """Return ``name==version`` of every lower bound, and the names in order."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    asked = [*project["dependencies"]]
    for extra in EXTRAS:
        asked += project["optional-dependencies"][extra]
    found = (re.fullmatch(r"([\w-]+)>=([\d.]+).*", each) for each in asked)
    return sorted({f"{match[1]}=={match[2]}" for match in found if match})


def main():
    pins = lowest()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        venv.create(place / "venv", with_pip=True)
        bin_ = place / "venv" / ("Scripts" if sys.platform == "win32" else "bin")
        (place / "lowest.txt").write_text("\n".join(pins) + "\n")
        install = [bin_ / "python", "-m", "pip", "install", "-q", "-c", place / "lowest.txt"]
        subprocess.run([*install, f"{ROOT}[{','.join(EXTRAS)}]"], check=True)
        rows, failed = [], 0
        for line in COMMANDS.strip().splitlines():
            command = [bin_ / "antinode", *line.split()]
            done = subprocess.run(command, cwd=place, capture_output=True, text=True, check=False)
            told = "done" if not done.returncode else done.stderr.strip().splitlines()[-1]
            failed += bool(done.returncode)
            rows.append(f"| `antinode {line}` | {told} |")
            print(rows[-1], flush=True)
    python = ".".join(map(str, sys.version_info[:3]))
    text = [
        "# Lowest versions",
        "",
        "Written by `python -m validation.lowest_versions`: the main commands with the lowest "
        f"versions that pyproject.toml allows, Python {python}.",
        "",
        ", ".join(f"`{pin}`" for pin in pins),
        "",
        "| command | |",
        "|---|---|",
        *rows,
    ]
    Path(__file__).with_suffix(".md").write_text("\n".join(text) + "\n")
    return failed


if __name__ == "__main__":
    sys.exit(bool(main()))
