"""Sweeps: in worker processes, gone on with, and on a Dask cluster."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import righting as rt


@pytest.fixture(scope="module")
def angles(scenarios: Path) -> dict[str, object]:
    """Six slews, one of which is refused."""
    scenario = rt.Scenario(scenarios / "slew_2dof.json").to_dict()
    scenario["horizon"]["steps"] = 60
    return {
        "name": "angles",
        "scenario": scenario,
        "vary": [
            {"field": "maneuver.angle_deg", "name": "angle", "values": [5, 10, 15]},
            {"field": "horizon.duration_s", "values": np.array([30.0, 60.0])},
        ],
    }


@pytest.fixture(scope="module")
def results(angles: dict[str, object], tmp_path_factory: pytest.TempPathFactory) -> rt.SweepResults:
    return rt.sweep(angles, tmp_path_factory.mktemp("sweep"), jobs=2)


def comparable(results: rt.SweepResults) -> dict[str, list[object]]:
    """What does not depend on the run."""
    columns = results.columns.items()
    return {name: list(cells) for name, cells in columns if name not in ("solve_s", "attempts")}


def test_every_case_is_recorded(results: rt.SweepResults) -> None:
    assert len(results) == results.cases == 6
    assert list(results.columns["angle"]) == [5, 5, 10, 10, 15, 15]
    assert results.columns["verified"].dtype == bool
    assert results.summary["succeeded"] == results.columns["verified"].sum() == 6
    assert repr(results) == "SweepResults('angles': 6 of 6 succeed, 6 of 6 recorded)"


def test_tables_are_frames(results: rt.SweepResults) -> None:
    pandas, polars, arrow = results.to_pandas(), results.to_polars(), results.to_arrow()
    for frame in (pandas, polars):
        assert frame.shape == (6, len(results.columns))
    assert pandas.groupby("angle")["objective"].min().is_monotonic_increasing
    assert polars["angle"].to_list() == arrow["angle"].to_pylist() == list(pandas["angle"])


def test_a_folder_with_records_is_gone_on_with_only_if_asked(
    angles: dict[str, object], results: rt.SweepResults
) -> None:
    with pytest.raises(rt.FileError, match="6 records of an earlier run") as raised:
        rt.sweep(angles, results.folder)
    assert raised.value.hint is not None and "resume=True" in raised.value.hint
    records = results.folder / "records" / "1-of-1.jsonl"
    lines = records.read_text().splitlines(keepends=True)
    records.write_text("".join(lines[:4]))
    assert len(rt.SweepResults(results.folder)) == 4
    again = rt.sweep(angles, results.folder, resume=True)
    assert comparable(again) == comparable(results)


def test_slews_over_axes_have_a_page(scenarios: Path, tmp_path: Path) -> None:
    swept = {
        "name": "axes",
        "scenario": "slew_2dof.json",
        "vary": [
            {"field": "maneuver.axis", "fibonacci": 2},
            {"field": "maneuver.angle_deg", "values": [5]},
            {"field": "horizon.steps", "values": [60]},
        ],
    }
    results = rt.sweep(swept, tmp_path, folder=scenarios)
    page = results.page()
    assert page is not None and page.startswith("<!doctype html>")


def test_what_is_wrong_with_a_sweep_is_named(angles: dict[str, object], tmp_path: Path) -> None:
    wrong = {**angles, "vary": [{"field": "maneuver.angel_deg", "values": [1]}]}
    with pytest.raises(rt.InputError) as raised:
        rt.sweep(wrong, tmp_path)
    assert raised.value.field is not None and raised.value.field.startswith("vary[0]")
    with pytest.raises(ValueError, match="client"):
        rt.sweep(angles, tmp_path, shards=3)


def test_a_callback_that_raises_ends_the_workers(angles: dict[str, object], tmp_path: Path) -> None:
    from righting import _righting
    from righting._sweep import WORKER

    def stop(succeeded: bool, recorded: int, left: int) -> None:
        raise LookupError(f"{recorded} of {left}")

    _righting.plan_sweep(angles, tmp_path, False, None)
    with pytest.raises(LookupError, match="1 of 6"):
        _righting.run_shard(tmp_path, "1/1", 1, WORKER, stop)
    assert 1 <= len(rt.SweepResults(tmp_path)) < 6


@pytest.mark.filterwarnings("ignore")
def test_a_dask_cluster_runs_the_same_shards(
    angles: dict[str, object], results: rt.SweepResults, tmp_path: Path
) -> None:
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        on_cluster = rt.sweep(angles, tmp_path, client=client, shards=3)
    names = sorted(file.name for file in (tmp_path / "records").iterdir())
    assert names == ["1-of-3.jsonl", "2-of-3.jsonl", "3-of-3.jsonl"]
    assert comparable(on_cluster) == comparable(results)


def test_plans_are_kept_where_asked(angles: dict[str, object], results: rt.SweepResults, tmp_path: Path) -> None:
    kept = rt.sweep(angles, tmp_path / "kept", jobs=2, keep_plans=True)
    assert comparable(kept) == comparable(results)
    plan = kept.plan(kept.columns["case_id"][0])
    assert plan.verified and plan.objective == kept.columns["objective"][0]
    with pytest.raises(rt.FileError):
        results.plan(results.columns["case_id"][0])
