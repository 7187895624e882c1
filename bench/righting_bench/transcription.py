"""Direct multiple shooting over mapped stage functions, in the stage order that fatrop wants."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca
import numpy as np

from .problem import StageProblem


@dataclass(frozen=True)
class Layout:
    """Offsets of everything in the decision vector [x_0, u_0, x_1, ..., x_N] and in the constraint rows.

    Rows run [gap_0, x_0 pinned, gap_1, path_1, ..., gap_{N-1}, path_{N-1}, path_N]. The pinning rows are
    there only for a solver that wants x_0 as a constraint; else x_0 is fixed by its bounds.
    """

    steps: int
    states: int
    controls: int
    path_rows: int
    pinned_by_rows: bool

    @property
    def point(self) -> int:
        """Length of (x_k, u_k)."""
        return self.states + self.controls

    @property
    def variables(self) -> int:
        """Length of the decision vector."""
        return self.steps * self.point + self.states

    @property
    def head_rows(self) -> int:
        """Rows of stage 0."""
        return self.states * (2 if self.pinned_by_rows else 1)

    @property
    def rows(self) -> int:
        """Number of constraint rows."""
        return self.head_rows + (self.steps - 1) * (self.states + self.path_rows) + self.path_rows

    def column(self, node: int) -> int:
        """First column of x_node."""
        return node * self.point

    def gap_row(self, stage: int) -> int:
        """First row of the continuity condition that ends a stage."""
        return 0 if stage == 0 else self.head_rows + (stage - 1) * (self.states + self.path_rows)

    def path_row(self, node: int) -> int:
        """First row of the path constraint at a node; node 0 has none, since x_0 is given."""
        if node == self.steps:
            return self.rows - self.path_rows
        return self.gap_row(node) + self.states

    def split(self, variables: ca.MX) -> tuple[ca.MX, ca.MX, ca.MX]:
        """Node states 0...N-1 and controls as matrices of columns, and the last state."""
        points = ca.reshape(variables[: self.steps * self.point], self.point, self.steps)
        return points[: self.states, :], points[self.states :, :], variables[self.steps * self.point :]

    def rows_of(self, first_rows: Iterator[int], count: int) -> np.ndarray:
        """Row numbers of equal blocks, one column a block."""
        return np.array(list(first_rows), dtype=int)[None, :] + np.arange(count)[:, None]

    def gap_rows(self) -> np.ndarray:
        """Row numbers of every continuity condition, one column a stage."""
        return self.rows_of((self.gap_row(stage) for stage in range(self.steps)), self.states)

    def path_rows_table(self) -> np.ndarray:
        """Row numbers of every path constraint, one column a node from 1 to N."""
        return self.rows_of((self.path_row(node) for node in range(1, self.steps + 1)), self.path_rows)


@dataclass(frozen=True)
class Transcription:
    """The NLP as CasADi takes it, with its bounds and the constant guess."""

    layout: Layout
    nlp: dict[str, ca.MX]
    guess: np.ndarray
    variables_low: np.ndarray
    variables_high: np.ndarray
    rows_low: np.ndarray
    rows_high: np.ndarray


def constraint_rows(problem: StageProblem, layout: Layout, variables: ca.MX) -> ca.MX:
    """All constraint rows from mapped stage functions."""
    states, controls, last = layout.split(variables)
    following = ca.horzcat(states[:, 1:], last)
    gaps = following - problem.step.map(layout.steps)(states, controls)
    paths = problem.path.map(layout.steps)(following) if layout.path_rows else ca.MX(0, layout.steps)
    pins = [states[:, 0]] if layout.pinned_by_rows else []
    middle = ca.vec(ca.vertcat(gaps[:, 1:], paths[:, :-1]))
    return ca.vertcat(gaps[:, 0], *pins, middle, paths[:, -1])


def transcribe(problem: StageProblem, pinned_by_rows: bool) -> Transcription:
    """Multiple shooting with the paper's constant guess: x_0 held, no control."""
    layout = Layout(problem.steps, problem.states, problem.controls, problem.path_rows, pinned_by_rows)
    variables = ca.MX.sym("w", layout.variables)
    _, controls, last = layout.split(variables)
    rows = constraint_rows(problem, layout, variables)
    cost = ca.sum2(problem.running.map(layout.steps)(controls)) + problem.terminal(last)

    def along(state: np.ndarray, control: np.ndarray) -> np.ndarray:
        return np.concatenate([np.tile(np.concatenate([state, control]), layout.steps), state])

    low = along(problem.state_low, -problem.control_limit)
    high = along(problem.state_high, problem.control_limit)
    rows_low, rows_high = np.zeros(layout.rows), np.zeros(layout.rows)
    rows_high[layout.path_rows_table()] = np.inf
    start = slice(0, layout.states)
    if pinned_by_rows:
        low[start], high[start] = -np.inf, np.inf
        pinned = slice(layout.states, 2 * layout.states)
        rows_low[pinned] = rows_high[pinned] = problem.initial_state
    else:
        low[start] = high[start] = problem.initial_state
    return Transcription(
        layout=layout,
        nlp={"x": variables, "f": cost, "g": rows},
        guess=along(problem.initial_state, np.zeros(layout.controls)),
        variables_low=low,
        variables_high=high,
        rows_low=rows_low,
        rows_high=rows_high,
    )
