"""Faults: kills at random moments, full and read-only disks, damaged chunks, clocks that go back.

    python validation/faults.py [--kills 100] [--seed 1]

After every kill all chunks that the store calls done are compared with an undisturbed run, bit by
bit, and must not have become fewer; at the end of every store so is the whole. The record is
faults.md beside this script. Dask's servers listen on loopback and end with the script.
"""

import argparse
import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

import numpy as np

import antinode as an
from antinode.study.sweep.contents import TIMESTAMPS
from antinode.study.sweep.ledger import Ledger

HERE = Path(__file__).resolve().parent
STUDIES = {
    "sobol": ("samples.toml", ("design.number=40000", "run.chunk=1000")),
    "hypercube": (
        "samples.toml",
        ("design.kind=latin_hypercube", "design.number=30000", "run.chunk=512"),
    ),
    "tracked grid": ("study.toml", ("inputs.0.number=400", "run.chunk=40", "solve.modes=3")),
}
EXECUTORS = ("in-process", "pool", "dask", "dask, worker killed")
LIMIT = 300  # seconds for one command


def command(*arguments, before=""):
    code = f"{before}\nfrom antinode.cli import main; main()"
    return [sys.executable, "-c", code, *map(str, arguments)]


def quiet(arguments, **options):
    streams = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen(arguments, start_new_session=True, **{**streams, **options})


def end(process):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(timeout=30)


class Cluster:
    """A Dask scheduler and a worker on loopback, in a group of their own."""

    def __enter__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{port}"
        options = ("--host", "127.0.0.1", "--no-dashboard")
        dask = ["timeout", "3600", sys.executable, "-m", "dask"]
        self.scheduler = quiet([*dask, "scheduler", *options, "--port", str(port)])
        self.worker = quiet([*dask, "worker", self.address, *options, "--nthreads", "1",
                             "--nworkers", "2"])  # fmt: skip
        return self

    def __exit__(self, *_):
        end(self.worker)
        end(self.scheduler)

    def kill_a_worker(self, rng):
        """Kill a process that computes; its nanny starts another."""
        workers = [pid for pid, text in processes() if "spawn_main" in text and
                   os.getpgid(pid) == self.worker.pid]  # fmt: skip
        if workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(rng.choice(workers)), signal.SIGKILL)


def processes():
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError):
                text = (entry / "cmdline").read_text()
                os.getpgid(int(entry.name))
                yield int(entry.name), text


class Reference:
    """An undisturbed run of a study."""

    def __init__(self, folder, name):
        self.file, self.settings = folder / STUDIES[name][0], STUDIES[name][1]
        self.path = folder / f"{name.replace(' ', '_')}.zarr"
        start = time.perf_counter()
        an.sweep(an.load_study(self.file, self.settings), self.path)
        self.seconds = time.perf_counter() - start
        self.data = {k: np.asarray(v) for k, v in open_raw(self.path).items()}

    def arguments(self, store, *more):
        sets = [part for text in self.settings for part in ("--set", text)]
        return ("sweep", self.file, "-o", store, *sets, *more)


def open_raw(path):
    import zarr

    group = zarr.open_group(path, mode="r")
    return {name: array[:] for name, array in group.arrays()}


def done_chunks(reference, path):
    """Return how many chunks are done, and how many rows of them differ from the reference."""
    import zarr

    if not path.exists():
        return 0, 0
    group = zarr.open_group(path, mode="r")
    done = [block for block in Ledger(path).records if block >= 0]
    size, wrong = group["reason"].chunks[0], 0
    names = [n for n in reference.data if n not in ("point", "mode", "track")]
    names = [n for n in names if not n.startswith("tracked")]
    for chunk in done:
        part = slice(chunk * size, (chunk + 1) * size)
        for name in names:
            a, b = group[name][part], reference.data[name][part]
            rows = (np.asarray(a != b) & ~(np.isnan(a) & np.isnan(b))).reshape(len(a), -1)
            wrong += int(rows.any(axis=1).sum())
    return len(done), wrong


def differing_rows(reference, path):
    """Return the rows of a finished store that differ, and attributes too (timestamps apart)."""
    found, wrong = open_raw(path), 0
    for name, b in reference.data.items():
        a = found[name]
        same = a.shape == b.shape
        equal = (a == b) | (np.isnan(a) & np.isnan(b)) if a.dtype.kind == "f" else a == b
        wrong += int((~equal.reshape(len(a), -1)).any(axis=1).sum()) if same else len(b)
    one, two = (dict(an.open_store(p).attrs) for p in (path, reference.path))
    for key in TIMESTAMPS:
        one.pop(key), two.pop(key)
    return wrong + (one != two)


def kills(references, folder, number, rng, cluster):
    """Kill sweeps until there were so many kills; return rows of the record."""
    rows, count, store_number = {}, 0, 0
    while count < number:
        name = str(rng.choice(list(STUDIES)))
        executor = EXECUTORS[store_number % len(EXECUTORS)]
        reference, path = references[name], folder / f"store_{store_number}.zarr"
        store_number += 1
        row = rows.setdefault((name, executor), dict.fromkeys(KEYS, 0))
        before = 0
        more = {
            "in-process": ("--workers", 1),
            "pool": ("--workers", 2),
        }.get(executor, ("--scheduler", cluster.address))
        for attempt in range(12):
            ended, killed = one_run(reference, path, more, executor, rng, cluster, attempt)
            count, row["kills"] = count + killed, row["kills"] + killed
            done, wrong = done_chunks(reference, path)
            row["chunks lost"] += max(0, before - done)
            row["rows wrong"] += wrong
            before = done
            if ended or count >= number:
                break
        if not ended:
            finish = quiet(command(*reference.arguments(path, *more)))
            assert finish.wait(timeout=LIMIT) == 0
        row["stores"] += 1
        row["rows wrong"] += differing_rows(reference, path)
        print(f"{count} kills; {name}, {executor}: {row}", flush=True)
        shutil.rmtree(path)
    return rows


KEYS = ("stores", "kills", "chunks lost", "rows wrong")


def one_run(reference, path, more, executor, rng, cluster, attempt):
    """Start a run and kill it, or a worker, at a random moment; tell if it ended, and kills."""
    process = quiet(command(*reference.arguments(path, *more)))
    moment = rng.uniform(0.3, 3.5 + 1.2 * reference.seconds)
    start, killed = time.perf_counter(), 0
    if executor.endswith("worker killed"):
        while process.poll() is None and killed < 3:
            time.sleep(rng.uniform(0.5, 2.5))
            if process.poll() is None:
                cluster.kill_a_worker(rng)
                killed += 1
        if process.wait(timeout=LIMIT) == 0:
            return True, killed
        return False, killed
    while process.poll() is None and time.perf_counter() - start < moment:
        time.sleep(0.005)
    if process.poll() is not None:
        assert process.returncode == 0, process.returncode
        return True, 0
    end(process)
    return False, 1


# --- other faults ---


def mounted(folder, options):
    """Mount a small file system in memory; tell whether it went."""
    folder.mkdir(exist_ok=True)
    done = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(folder)],
        capture_output=True, check=False,
    )  # fmt: skip
    return done.returncode == 0


def full_disk(reference, folder):
    """Fill the disk, say so, make room, go on."""
    disk = folder / "disk"
    if not mounted(disk, "size=1536k"):
        return full_by_limit(reference, folder)
    try:
        path = disk / "s.zarr"
        first = subprocess.run(
            command(*reference.arguments(path)), capture_output=True, text=True, check=False
        )
        said = last_line(first.stderr)
        assert first.returncode == 1, first
        assert "no space is left" in said, said
        kept, wrong = done_chunks(reference, path)
        subprocess.run(["mount", "-o", "remount,size=64m", str(disk)], check=True)
        second = quiet(command(*reference.arguments(path)))
        assert second.wait(timeout=LIMIT) == 0
        wrong += differing_rows(reference, path)
    finally:
        subprocess.run(["umount", str(disk)], check=True)
    return f"tmpfs of 1.5 MB: {kept} chunks kept; after making room", wrong, said


def full_by_limit(reference, folder):
    path = folder / "limited.zarr"
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))"
    first = subprocess.run(
        command(*reference.arguments(path), before=limit),
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    said = last_line(first.stderr)
    assert first.returncode == 1, first
    second = quiet(command(*reference.arguments(path)))
    assert second.wait(timeout=LIMIT) == 0
    return "files of at most 20 kB; without the limit", differing_rows(reference, path), said


def last_line(text):
    return text.strip().splitlines()[-1].removeprefix("antinode: ")


def read_only(reference, folder):
    """A folder that cannot be written is refused before any work."""
    disk = folder / "read_only"
    if mounted(disk, "ro,size=1m"):
        undo = ["umount", str(disk)]
    else:
        disk.chmod(0o555)
        undo = ["chmod", "755", str(disk)]
    try:
        start = time.perf_counter()
        done = subprocess.run(
            command(*reference.arguments(disk / "s.zarr")),
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        seconds = time.perf_counter() - start
        assert done.returncode == 2, done
        assert not any(disk.iterdir())
    finally:
        subprocess.run(undo, check=True)
    return f"exit code 2 after {seconds:.1f} s, nothing written", 0, last_line(done.stderr)


def corrupted(reference, folder, rng, times=20):
    """Damage chunks: bits flipped, ends cut, files lost or of another chunk."""
    path, wrong = folder / "corrupted.zarr", 0
    shutil.copytree(reference.path, path)
    for k in range(times):
        files = sorted(f for f in path.rglob("c/*") if f.is_file())
        file = files[int(rng.integers(len(files)))]
        data = bytearray(file.read_bytes())
        if k % 4 == 0:
            data[int(rng.integers(len(data)))] ^= 1 << int(rng.integers(8))
            file.write_bytes(data)
        elif k % 4 == 1:
            file.write_bytes(data[: len(data) // 2])
        elif k % 4 == 2:
            file.unlink()
        else:
            file.write_bytes(sorted(file.parent.iterdir())[0].read_bytes())
        an.sweep(an.load_study(reference.file, reference.settings), path)
        wrong += differing_rows(reference, path)
    shutil.rmtree(path)
    return f"{times} damages, each found and computed again", wrong, ""


def clock(reference, folder):
    """A clock that runs backwards, and files from the future."""
    path = folder / "clock.zarr"
    back = (
        "import time, itertools, antinode.study.sweep.sweep as s\n"
        "count = itertools.count()\n"
        "time.time = lambda: 1e9 - 3600.0 * next(count)\n"
        "s._now = lambda: '1970-01-01T00:00:00+00:00'"
    )
    process = quiet(command(*reference.arguments(path), before=back))
    time.sleep(3.5 + 0.4 * reference.seconds)
    end(process)
    for file in path.rglob("*") if path.exists() else ():
        os.utime(file, (4e9, 4e9))
    second = quiet(command(*reference.arguments(path), before=back))
    assert second.wait(timeout=LIMIT) == 0
    return "killed, dated to the future, gone on with", differing_rows(reference, path), ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    with tempfile.TemporaryDirectory() as name, Cluster() as cluster:
        folder = Path(name)
        subprocess.run(command("init", "--example", "sweep", folder), check=True)
        references = {name: Reference(folder, name) for name in STUDIES}
        rows = kills(references, folder, arguments.kills, rng, cluster)
        others = {
            "full disk": full_disk(references["sobol"], folder),
            "read-only folder": read_only(references["sobol"], folder),
            "corrupted chunks": corrupted(references["tracked grid"], folder, rng),
            "clock going backwards": clock(references["sobol"], folder),
        }
    record(rows, others, arguments)
    failed = sum(row["rows wrong"] + row["chunks lost"] for row in rows.values())
    failed += sum(other[1] for other in others.values())
    print(f"{failed} rows lost or wrong")
    sys.exit(bool(failed))


def record(rows, others, arguments):
    total = {key: sum(row[key] for row in rows.values()) for key in KEYS}
    lines = [
        "# Faults of sweeps",
        "",
        f"`python validation/faults.py --kills {arguments.kills} --seed {arguments.seed}`, "
        f"{date.today().isoformat()}, {os.cpu_count()} processors.",
        "",
        "SIGKILL at random moments, to the whole process group, or to a worker of Dask while the",
        "sweep goes on. After each kill every chunk that is called done is compared with an",
        "undisturbed run bit by bit, and each store as a whole at its end, attributes too",
        "(timestamps apart).",
        "",
        "| study | executor | stores | kills | chunks lost | rows wrong |",
        "|---|---|---|---|---|---|",
    ]
    for (study, executor), row in sorted(rows.items()):
        lines.append(f"| {study} | {executor} | " + " | ".join(str(row[k]) for k in KEYS) + " |")
    lines += ["| **all** | | " + " | ".join(f"**{total[k]}**" for k in KEYS) + " |", ""]
    lines += ["| fault | what happened | rows wrong |", "|---|---|---|"]
    for fault, (text, wrong, said) in others.items():
        quote = f'; it says: "{short(said)}"' if said else ""
        lines.append(f"| {fault} | {text}{quote} | {wrong} |")
    (HERE / "faults.md").write_text("\n".join(lines) + "\n")


def short(said):
    """A sentence without the name of a temporary folder."""
    return " ".join("s.zarr" + w.partition("s.zarr")[2] if "s.zarr" in w else w
                    for w in said.split())  # fmt: skip


if __name__ == "__main__":
    main()
