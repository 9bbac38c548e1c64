"""A sweep of the sample player on one core, on all cores, and on a Dask cluster that loses a worker: equal tables.

`python -m benchmarks.sweeps [--seeds N] [--full]`; --full takes 200 seeds. Needs the extra vicode-fsm[cluster].
"""

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from distributed import Client, LocalCluster

DESIGN = "designs/forward/player.yaml"
VALUES = "pan_threshold=15..55:5"


def main() -> None:
    """Run the sweeps, and print their times and whether the tables are equal."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--full", action="store_true", help="200 seeds")
    parser.add_argument("--out", help="folder that keeps the results")
    args = parser.parse_args()
    seeds = 200 if args.full else args.seeds
    with tempfile.TemporaryDirectory() as temporary:
        out = Path(args.out or temporary)
        print(f"{seeds} seeds, 5 values, load average {os.getloadavg()[0]:.1f}")
        measure("one core", out / "one", seeds, "--jobs", "1")
        measure(f"{len(os.sched_getaffinity(0))} cores", out / "all", seeds)
        with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            killer = threading.Thread(target=kill_worker, args=(cluster, out / "cluster/runs.jsonl", seeds * 5 // 2))
            killer.start()
            measure("2 workers of Dask", out / "cluster", seeds, "--cluster", cluster.scheduler_address)
            killer.join()
        tables = {(out / name / "runs.csv").read_bytes() for name in ("one", "all", "cluster")}
        print("equal tables" if len(tables) == 1 else f"{len(tables)} different tables")


def measure(name: str, out: Path, seeds: int, *words: str) -> None:
    """Run one sweep."""
    command = [sys.executable, "-m", "vicode", "sweep", DESIGN, "--set", VALUES, "--seeds", str(seeds)]
    command += ["--out", str(out), "--minimize", "world.first_goal_s", *words]
    begin = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    seconds = time.perf_counter() - begin
    print(
        f"{name}: {seconds:.1f} s, {seeds * 5 / seconds:.1f} runs per second; {done.stdout.splitlines()[1]}", flush=True
    )


def kill_worker(cluster: LocalCluster, runs: Path, count: int) -> None:
    """Kill a worker as soon as there are so many runs."""
    while not runs.exists() or runs.read_bytes().count(b"\n") <= count:
        time.sleep(0.05)
    with Client(cluster) as client:
        worker, pid = min(client.run(os.getpid).items())
    os.kill(pid, signal.SIGKILL)
    print(f"killed the worker {worker} after {runs.read_bytes().count(bytes([10])) - 1} runs", flush=True)


if __name__ == "__main__":
    main()
