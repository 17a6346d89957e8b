"""A simulated cluster: workers whose solve is replaced by its time; client, scheduler, store real.

    python benchmarks/cluster.py [--cases 4000000] [--microseconds 20]

16 workers (threads of two processes) sleep as long as their cases would take, and write numbers of
the right sizes into the store. What the client, the scheduler and the writing take of a processor
says how many workers each of them carries. The record is cluster.md beside this script.
"""

import argparse
import os
import platform
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from datetime import date
from pathlib import Path

from sweeps import LOADS, command

HERE = Path(__file__).resolve().parent
PROCESSES, THREADS = 2, 8
IDLE = 5  # seconds in which the scheduler has nothing to do
PRELOAD = """
import time
import numpy as np
from antinode.study.sweep import work
from antinode.study.sweep.contents import TRACKED, outputs_of

def slept(points, chunk):
    start, stop = points.bounds(chunk)
    time.sleep((stop - start) * MICROSECONDS * 1e-6)
    rng, found = np.random.default_rng(chunk), {}
    for name, about in outputs_of(points).items():
        shape = (stop - start, *about.shape[1:])
        whole = about.dtype != "float64"
        found[name] = np.zeros(shape, about.dtype) if whole else rng.random(shape)
    return found

work.compute_chunk = slept
"""


def seconds_of(pid):
    """Processor time of a process so far."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def start(*arguments):
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([sys.executable, *map(str, arguments)], **quiet)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=4_000_000)
    parser.add_argument("--microseconds", type=float, default=20.0)
    given = parser.parse_args()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address, local = f"tcp://127.0.0.1:{port}", ("--host", "127.0.0.1", "--no-dashboard")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([*command(), "init", name], check=True, capture_output=True)
        (folder / "study.toml").write_text(LOADS.replace("NUMBER", str(given.cases)))
        code = PRELOAD.replace("MICROSECONDS", str(given.microseconds))
        code += "from distributed.cli.dask_worker import main; main()"
        servers = [start("-m", "dask", "scheduler", *local, "--port", port)]
        servers += [
            start("-c", code, address, *local, "--no-nanny", "--nthreads", THREADS)
            for _ in range(PROCESSES)
        ]
        try:
            row = measured(folder, address, servers, given)
        finally:
            for server in servers:
                server.terminate()
                server.wait(timeout=20)
        shutil.rmtree(folder / "s.zarr")
    (HERE / "cluster.md").write_text(PAGE.format(**row))
    print(PAGE.format(**row))


def measured(folder, address, servers, given):
    """Run one sweep; return what it took."""
    from antinode import load_study, sweep

    study = load_study(folder / "study.toml")
    connected(address)
    idle = seconds_of(servers[0].pid)
    time.sleep(IDLE)
    idle = (seconds_of(servers[0].pid) - idle) / IDLE
    before, own, began = [seconds_of(s.pid) for s in servers], time.process_time(), time.time()
    marks = []
    sweep(study, folder / "s.zarr", scheduler=address, progress=lambda *_: marks.append(own_time()))
    wall = time.time() - began
    client = time.process_time() - own
    scheduler, *workers = (seconds_of(s.pid) - b for s, b in zip(servers, before, strict=True))
    scheduler = max(scheduler - idle * wall, 0.01)
    work = given.cases * given.microseconds * 1e-6
    running = marks[-1] - marks[0]
    return {
        "cases": f"{given.cases:,}",
        "micro": given.microseconds,
        "blocks": len(marks) - 1,
        "ideal": f"{work / (PROCESSES * THREADS):.1f}",
        "wall": f"{wall:.1f}",
        "client": f"{client:.2f}",
        "running": f"{running:.2f}",
        "scheduler": f"{scheduler:.2f}",
        "writing": f"{sum(workers):.1f}",
        "per_case": f"{sum(workers) / given.cases * 1e6:.2f}",
        "by_client": f"{work / running:,.0f}",
        "by_scheduler": f"{work / scheduler:,.0f}",
        "store": f"{sum(f.stat().st_size for f in folder.rglob('*') if f.is_file()) / 1e6:.0f}",
        "machine": f"{os.cpu_count()} processors, shared and busy; Python "
        f"{platform.python_version()}; {date.today().isoformat()}",
    }


own_time = time.process_time


def connected(address):
    from antinode.study.sweep.cluster import close, connect

    client = connect(address)
    client.wait_for_workers(PROCESSES, timeout=60)
    close(client)


PAGE = """# A simulated cluster

`python benchmarks/cluster.py`: 16 workers sleep {micro:g} us a case in place of solving, at chunk
4,096, and write numbers of the right sizes into one store; client, scheduler, ledger, fsync are
real.

| cases | blocks | solve / 16 workers | wall | client, all | client, while blocks come |
|---|---|---|---|---|---|
| {cases} | {blocks} | {ideal} s | {wall} s | {client} s | {running} s |

| scheduler | workers' writing | a case |
|---|---|---|
| {scheduler} s | {writing} s | {per_case} us |

The scheduler's time is that above what it takes when it has nothing to do. The client alone would
carry {by_client} workers of that speed while blocks come, the scheduler {by_scheduler}; the store
has {store} MB. {machine}.

Drawn on, on paper, to 100 nodes of 32 cores and 1e9 cases: these are 3,815 blocks of 64 chunks,
each 5.2 s of solving. 3,200 workers do them in two rounds, some 11 s, the second one hardly
filled: what breaks first is the length of a block against the run. Then the disk: 100 GB in 11 s
are 9 GB/s, which only a parallel file system writes. Client and scheduler
see 350 blocks a second, about what the scheduler takes; the ledger's fsync for each, 1 to 2 ms
here, is half of the client's time. With 320 cores all of this is
far away: 63 s, 1.6 GB/s, 60 blocks a second.
"""

if __name__ == "__main__":
    main()
