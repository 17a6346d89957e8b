"""The package as it is released, in an environment of its own: made once for all workers of a run.

Compiling takes longest, so what needs code that was made anew shares it: `cold` in conftest.py.
"""

import os
import subprocess
import sys
import sysconfig
import venv
import zipfile
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
_OURS = ("PYTHON", "VIRTUAL_ENV", "ANTINODE_CACHE", "NUMBA_")


class Installed(NamedTuple):
    """Folders of the two archives, of the installed packages, and the interpreter that has them."""

    archives: Path
    site: Path
    python: Path

    @property
    def cache(self):
        """Folder of the code that was compiled there."""
        return self.site / "antinode" / "riccati" / "lanes" / "__pycache__"


def run(*command, where, **more):
    """Run a command outside the clone, without its paths; return what it printed."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(_OURS)}
    done = subprocess.run(
        [str(part) for part in command],
        cwd=where,
        env=kept | more,
        capture_output=True,
        text=True,
        check=False,
        timeout=900,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def install(folder):
    """Build both archives with this interpreter's hatchling, and install the wheel."""
    archives = folder / "dist"
    if not archives.exists():
        made = folder / "building"
        run(sys.executable, "-m", "hatchling", "build", "-d", made, where=ROOT)
        made.rename(archives)
    home = folder / "env"
    venv.create(home, with_pip=False)
    scripts = home / ("Scripts" if os.name == "nt" else "bin")
    python = next(path for path in scripts.iterdir() if path.stem == "python")
    code = "import sysconfig; print(sysconfig.get_path('purelib'))"
    site = Path(run(python, "-c", code, where=folder).strip())
    if not (site / "libraries.pth").exists():
        (wheel,) = archives.glob("*.whl")
        zipfile.ZipFile(wheel).extractall(site)
        libraries = f"import site; site.addsitedir({sysconfig.get_path('purelib')!r})\n"
        (site / "libraries.pth").write_text(libraries)
    return Installed(archives, site, python)


@contextmanager
def shared(tmp_path_factory, name):
    """Give a folder that all workers of a run share, to one of them at a time."""
    base = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        base = base.parent
    folder = base / name
    folder.mkdir(exist_ok=True)
    with (base / f"{name}.lock").open("ab") as handle:
        try:
            import fcntl
        except ImportError:  # Windows, where a run with several workers may make it twice
            pass
        else:
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield folder


# --- what is solved there and elsewhere -------------------------------------------------------

SOLVE = """
import hashlib, sys
import numpy as np
import antinode as an

def first(rng, n=12, **more):
    x = np.sort(rng.uniform(0, 4, n))
    m, EI, EA = (s * np.exp(0.4 * rng.standard_normal(n)) for s in (300, 3e5, 1e7))
    return an.Beam.from_stations(x, m, EI, EA, 2e3 * x, **more)

def damped(rng):
    beam = an.Beam.from_stations(np.arange(9.0), *np.exp(rng.normal(0, 0.2, (2, 8))))
    return beam.with_attachments(an.Dashpot(3.0, translational=0.4), an.Dashpot(8.0, 0.1))

def batch(rng, one, n=25, beams=150):
    h, m, EI = np.full(n, 0.1), rng.uniform(1, 3, (beams, n)), rng.uniform(1e3, 3e3, (beams, n))
    N = rng.uniform(-1, 1, (beams, 1)) * rng.uniform(0, 500, n)
    return an.BeamBatch(h, m[0] if one else m, EI[0] if one else EI, N, modes=5)

def everything(seed):
    rng = np.random.default_rng(seed)
    for beam in (first(rng, interpolation="log"), first(rng, ends=an.Ends("clamped", "free"))):
        yield an.natural_frequencies(beam, 5).omega2
        result = an.solve_modes(beam, 4)
        for mode in result.modes:
            yield np.array([mode.omega2, *mode.bracket_omega2, mode.modal_mass])
            yield mode.states
    result = an.solve_modes(damped(rng), 3, families=("bending",))
    yield np.array([mode.eigenvalue for mode in result.modes])
    yield np.array([mode.left for mode in result.modes])
    for one in (True, False):
        result = an.solve_many(batch(rng, one))
        yield result.omega2
        yield result.bracket_omega2

def other_things():
    rng = np.random.default_rng(99)
    an.solve_many(batch(rng, False, n=3000, beams=3))
    an.natural_frequencies(first(rng, 40, interpolation="log"), 60, tolerance=1e-9)
    an.solve_modes(first(rng, 5), 20)
    an.solve_modes(damped(rng), 9, families=("bending",))
    an.solve_many(batch(rng, True, n=7, beams=900))

before = sys.argv[1]
if before == "other solves":
    other_things()
elif before == "numba":
    import numba
    numba.njit(lambda x: x + 1)(1)
elif before == "numpy":
    an.solve_modes(first(np.random.default_rng(5)), backend="numpy")
digest = hashlib.sha256()
for values in everything(7):
    digest.update(np.ascontiguousarray(values).tobytes())
from antinode.riccati.lanes.library import library
print(digest.hexdigest(), library().digest)
"""
