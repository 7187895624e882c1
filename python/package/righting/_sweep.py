"""Sweeps: many maneuvers by worker processes, on this machine or on a Dask cluster."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from righting import _righting
from righting._progress import Line, is_watched
from righting._righting import Plan, SweepTable

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow
    from distributed import Client

# A worker process: it takes cases on its standard input and answers on its standard output.
WORKER = [sys.executable, "-m", "righting._worker"]


class SweepResults:
    """What the cases of a sweep came to, in the order of its plan; those that are recorded.

    ``columns`` holds one array (or list of texts) a column: the case, what it sets, how it ended (`status`, `verified`,
    `attitude_error`, `final_rate_deg_s`, `joint_rate_deg_s`, `objective`, `iterations`, `reason`) and how it was computed
    (`solve_s`, `attempts`).
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Reads the records of a folder that a sweep was planned in, also while it runs."""
        self.folder = Path(folder)
        self._table = SweepTable(self.folder)
        self.columns: dict[str, Any] = self._table.columns()

    @property
    def cases(self) -> int:
        """Number of cases planned."""
        return self._table.cases

    def __len__(self) -> int:
        """Number of cases recorded."""
        return len(self.columns["case_id"])

    @property
    def summary(self) -> dict[str, Any]:
        """What the sweep came to in few numbers: how many succeeded, why others failed, how numbers are spread."""
        return self._table.summary()

    def plan(self, case_id: str) -> Plan:
        """The plan of a case, verified again, of a sweep that keeps plans (``keep_plans=True``).

        Raises
        ------
        FileError
            None was kept.
        """
        return Plan.read(self.folder / "plans" / case_id)

    def page(self) -> str | None:
        """The interactive page of a sweep over slew axes and angles, an HTML document; None of any other."""
        return self._table.page()

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame of pandas; numbers are not copied where pandas allows."""
        import pandas

        return pandas.DataFrame(self.columns, copy=False)

    def to_polars(self) -> polars.DataFrame:
        """The table as a data frame of Polars."""
        import polars

        return polars.DataFrame(self.columns)

    def to_arrow(self) -> pyarrow.Table:
        """The table as a table of Arrow."""
        import pyarrow

        return pyarrow.table(self.columns)

    def __repr__(self) -> str:
        summary = self.summary
        return (
            f"SweepResults({summary['sweep']!r}: {summary['succeeded']} of {len(self)} succeed, "
            f"{len(self)} of {self.cases} recorded)"
        )


def sweep(
    source: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str],
    *,
    folder: str | os.PathLike[str] | None = None,
    resume: bool = False,
    jobs: int | None = None,
    client: Client | None = None,
    shards: int | None = None,
    keep_plans: bool = False,
    progress: bool | None = None,
) -> SweepResults:
    """Plans and verifies every case of a sweep.

    Worker processes plan the cases, and each finished one is recorded in ``out`` at once. After an interruption
    (Ctrl-C stops cleanly) ``resume=True`` goes on. The folder is that of ``righting sweep``: either program may go on
    where the other stopped.

    Parameters
    ----------
    source
        The path of a sweep file, or a mapping of what such a file holds: ``righting.schema("sweep")``.
    out
        The folder of the plan and the records; made if it is missing. With a client all workers must see it.
    folder
        Of a mapping: the folder that relative paths start from; the working folder by default.
    resume
        Whether to go on with the records that ``out`` has; otherwise a folder with records is refused.
    jobs
        Number of worker processes, of each shard with a client; by default one a core, and one a shard with a client.
    client
        A client of a Dask cluster, which runs the sweep in shards.
    shards
        With a client: how many; by default four a thread of the cluster.
    keep_plans
        Whether to keep the plans of the cases that are planned now, for `SweepResults.plan`.
    progress
        Whether to show how many cases are done; by default in notebooks and on terminals.

    Raises
    ------
    InputError, FileError
        Something is wrong with the sweep, an argument or the folder. A case that fails is a result like any other.
    NotReadyError
        No worker comes up.
    """
    if shards is not None and client is None:
        raise ValueError("shards: they need a client")
    _righting.plan_sweep(source, out, resume, folder)
    if client is not None:
        from righting._dask import run

        run(client, Path(out).resolve(), jobs or 1, shards, keep_plans)
        return SweepResults(out)
    with ExitStack() as stack:
        show = progress if progress is not None else is_watched()
        line = Line()
        stack.callback(line.close)
        solved = 0

        def on_record(succeeded: bool, recorded: int, left: int) -> None:
            nonlocal solved
            solved += succeeded
            line.show(f"{recorded} of {left} cases: {solved} solved, {recorded - solved} failed")

        _righting.run_shard(out, "1/1", jobs, keep_plans, WORKER, on_record if show else None)
    return SweepResults(out)
