"""A study gives the same bits wherever it is computed, and whatever ran before."""

import os
import subprocess
import sys

import numpy as np
import pytest

from cli_run import run

STUDY = """
case = "case.toml"
inputs = [
  { key = "thrust", low = 0, high = 2.2e5, number = 40 },
  { key = "stations.mass_per_length.3", values = [190, 210, 230] },
]
design.kind = "grid"
outputs = ["frequency_hz", "error_hz", "omega2", "a_X", "cavity_length"]
solve = { modes = 4, families = FAMILIES }
run.chunk = 32
"""

SCRIPT = """
import sys
import numpy as np
import antinode as an


class Stop(Exception):
    pass


def after_two_chunks(done, cases):
    if done >= 64:
        raise Stop


def main(how, file, out):
    study, more = an.load_study(file), {}
    if how == "after other work":
        for modes in (2, 9):
            an.solve_modes(study.case, modes)
        an.natural_frequencies(an.load_beam(file.replace("study", "beam")), 5)
        an.solve_many(an.BeamBatch(np.ones(5), np.ones((3, 5)), np.ones((3, 5))))
        an.sweep(study.model_copy(update={"solve": study.solve.model_copy(update={"modes": 2})}))
    if how == "pool":
        more["workers"] = 2
    if how == "dask":
        from distributed import LocalCluster

        cluster = LocalCluster(
            n_workers=1, threads_per_worker=2, host="127.0.0.1", dashboard_address=None
        )
        more["scheduler"] = cluster.scheduler_address
    if how in ("interrupted", "resumed"):
        more["store"] = file.replace("study.toml", "store.zarr")
    if how == "interrupted":
        try:
            an.sweep(study, progress=after_two_chunks, **more)
        except Stop:
            return
        raise AssertionError("it was not interrupted")
    found = an.sweep(study, **more)
    numbers = {n: np.asarray(v) for n, v in found.variables.items() if v.dtype.kind in "fiu"}
    np.savez(out, **numbers)
    if how == "dask":
        cluster.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
"""


@pytest.fixture(scope="module", params=['["longitudinal"]', '["bending", "longitudinal"]'])
def computed(request, tmp_path_factory):
    """What computes the study in a process of its own, somehow, and returns its arrays."""
    folder = tmp_path_factory.mktemp("history")
    run("init", "--example", "sweep", folder)
    run("init", "--example", "beam", folder)
    (folder / "study.toml").write_text(STUDY.replace("FAMILIES", request.param))
    (folder / "script.py").write_text(SCRIPT)

    def compute(how, **environment):
        out = folder / f"{how}.npz"
        command = [sys.executable, folder / "script.py", how, folder / "study.toml", out]
        subprocess.run(command, check=True, env={**os.environ, **environment}, timeout=600)
        if out.exists():
            with np.load(out) as data:
                return dict(data)
        return None

    return compute


@pytest.fixture(scope="module")
def undisturbed(computed):
    return computed("undisturbed")


def assert_same(found, wanted):
    assert set(found) == set(wanted)
    assert [name for name in wanted if found[name].tobytes() != wanted[name].tobytes()] == []


@pytest.mark.parametrize("how", ["after other work", "pool", "dask"])
def test_a_study_does_not_depend_on_what_its_process_did(computed, undisturbed, how):
    if how == "dask":
        pytest.importorskip("distributed")
    assert_same(computed(how), undisturbed)


def test_an_interrupted_study_ends_as_an_undisturbed_one(computed, undisturbed):
    computed("interrupted")
    assert_same(computed("resumed"), undisturbed)


BATCH = """
import sys
import numpy as np
import antinode as an

n, cases = 1203, 1024
x, random = (np.arange(n) + 0.5) / n, np.random.default_rng(1)
force = [random.uniform(-1, 1, (cases, 1)) * shape for shape in (x, x > 0.4)]
batch = an.BeamBatch(np.full(n, 1 / n), 1 + x, 1 + 0.3 * x, sum(force), modes=2)
np.savez(sys.argv[1], omega2=an.solve_many(batch).omega2)
"""


def test_the_number_of_threads_of_numpy_changes_no_bit(tmp_path):
    """A worker of Dask has one, this process as many as processors."""
    found = []
    for threads in ("1", "2"):
        out = tmp_path / f"{threads}.npz"
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": threads}
        command = [sys.executable, "-c", BATCH, out]
        subprocess.run(command, check=True, env=environment, timeout=600)
        with np.load(out) as data:
            found.append(dict(data))
    assert_same(*found)
