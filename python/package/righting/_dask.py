"""Sweeps on a Dask cluster: the shards and records of any other sweep."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from righting import _righting
from righting._sweep import WORKER

if TYPE_CHECKING:
    from distributed import Client

# Some shards take longer than others: enough of them keep all threads at work.
SHARDS_PER_THREAD = 4


def run(client: Client, out: Path, jobs: int, shards: int | None, keep_plans: bool) -> None:
    """Runs what is missing of a planned sweep in shards, one a task, and waits for all."""
    from distributed import wait

    if shards is None:
        threads = client.nthreads()
        shards = SHARDS_PER_THREAD * max(1, sum(threads.values()))
    names = [f"{number}/{shards}" for number in range(1, shards + 1)]
    tasks = [client.submit(run_shard, str(out), name, jobs, keep_plans, pure=False) for name in names]
    try:
        wait(tasks)
    except BaseException:
        client.cancel(tasks)
        raise
    client.gather(tasks)


def run_shard(out: str, shard: str, jobs: int, keep_plans: bool) -> int:
    """What a task does: a shard of the sweep that is planned in a folder; how many cases were recorded."""
    return _righting.run_shard(out, shard, jobs, keep_plans, WORKER, None)
