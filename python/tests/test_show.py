"""Figures and pages of a plan."""

from __future__ import annotations

import webbrowser
from pathlib import Path

import matplotlib
import numpy as np
import pytest
import righting as rt


def test_a_figure_shows_the_columns_of_the_plan(plan: rt.Plan) -> None:
    matplotlib.use("agg")
    figure = plan.plot()
    axes = figure.axes
    assert [len(axis.lines) >= count for axis, count in zip(axes, [4, 3, 4, 4, 4, 4], strict=True)] == [True] * 6
    lines = [np.asarray(line.get_ydata()) for line in axes[2].lines[:4]]
    assert np.array_equal(np.transpose(lines), np.degrees(plan.joint_angles_rad))
    assert "verified" in figure.get_suptitle()
    figure.canvas.draw()


def test_a_figure_of_two_arms_has_their_joints_names(scenarios: Path) -> None:
    matplotlib.use("agg")
    plan = rt.solve(scenarios / "real" / "slew_two_arms.json")
    names = plan.scenario.system.joint_names
    assert names[:3] == ["left_shoulder_pitch", "left_shoulder_roll", "left_elbow"]
    shown = [text.get_text() for text in plan.plot().axes[2].get_legend().get_texts()]
    assert shown == names


def test_the_page_opens_in_a_browser(plan: rt.Plan, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    file = plan.show()
    assert opened == [Path(file).as_uri()]
    assert Path(file).read_text(encoding="utf-8") == plan.page()
    Path(file).unlink()
