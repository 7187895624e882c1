"""The NLP's constraint Jacobian and Lagrangian Hessian from mapped stage derivatives."""

from __future__ import annotations

import casadi as ca
import numpy as np

from .block_assembly import BlockAssembly
from .problem import StageProblem
from .stage_derivatives import StageDerivatives
from .transcription import Transcription, constraint_rows


def derivative_functions(
    problem: StageProblem, transcription: Transcription, stage: StageDerivatives, mirrored: bool
) -> dict[str, ca.Function]:
    """nlp_g, nlp_jac_g and nlp_hess_l out of mapped stage functions, under the names nlpsol looks up.

    `problem` and `stage` may be compiled: nlpsol never has to differentiate them. The constraint Jacobian
    comes with the rows themselves. The Hessian is the upper triangle (Ipopt) or, mirrored, the whole with
    the Lagrangian's gradient before it (fatrop).
    """
    layout = transcription.layout
    steps, path_rows = layout.steps, layout.path_rows
    variables, parameter = transcription.nlp["x"], ca.MX.sym("p", 0)
    states, controls, last = layout.split(variables)
    following = ca.horzcat(states[:, 1:], last)
    stages, nodes = range(steps), range(1, steps + 1)

    jacobian = BlockAssembly(layout.rows, layout.variables)
    gap_rows = [layout.gap_row(k) for k in stages]
    stage_columns = [layout.column(k) for k in stages]
    node_columns = [layout.column(k) for k in nodes]
    jacobian.add(
        stage.step_jacobian_sparsity,
        gap_rows,
        stage_columns,
        -stage.step_jacobian.map(steps)(states, controls),
    )
    unit = ca.Sparsity.diag(layout.states)
    jacobian.add(unit, gap_rows, node_columns, ca.MX(ca.DM.ones(layout.states, steps)))
    if layout.pinned_by_rows:
        jacobian.add(unit, [layout.states], [0], ca.MX(ca.DM.ones(layout.states)))
    if path_rows:
        values = stage.path_jacobian.map(steps)(following)
        jacobian.add(stage.path_jacobian_sparsity, [layout.path_row(k) for k in nodes], node_columns, values)
    rows = constraint_rows(problem, layout, variables)
    g = ca.Function("nlp_g", [variables, parameter], [rows], ["x", "p"], ["g"])
    jac_g = ca.Function(
        "nlp_jac_g",
        [variables, parameter],
        [rows, jacobian.matrix(mirrored=False)],
        ["x", "p"],
        ["g", "jac_g_x"],
    )

    cost_multiplier, multipliers = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", layout.rows)
    gap_multipliers = _gather(multipliers, layout.gap_rows())
    # Node 0 has no path constraint: it gets zero multipliers so that all stages map alike.
    path_multipliers = ca.horzcat(
        ca.MX(ca.DM.zeros(path_rows, 1)), _gather(multipliers, layout.path_rows_table())
    )
    gradient, values = stage.stage_hessian.map(steps)(
        states, controls, -gap_multipliers, path_multipliers[:, :-1], ca.repmat(cost_multiplier, 1, steps)
    )
    last_gradient, last_values = stage.terminal_hessian(last, path_multipliers[:, -1], cost_multiplier)
    hessian = BlockAssembly(layout.variables, layout.variables)
    hessian.add(stage.stage_hessian_sparsity, stage_columns, stage_columns, values)
    hessian.add(stage.terminal_hessian_sparsity, [node_columns[-1]], [node_columns[-1]], last_values)
    outputs, names = [hessian.matrix(mirrored)], ["hess"]
    if mirrored:
        # The gradient of a gap also reaches the state that the gap ends in, and x_0's pin reaches x_0.
        arriving = ca.vertcat(gap_multipliers, ca.MX(ca.DM.zeros(layout.controls, steps)))
        gradient = ca.vertcat(ca.vec(gradient), last_gradient)
        tail = ca.vec(arriving)[: layout.variables - layout.point]
        head = ca.MX(ca.DM.zeros(layout.point))
        if layout.pinned_by_rows:
            head = ca.vertcat(
                multipliers[layout.states : 2 * layout.states], ca.MX(ca.DM.zeros(layout.controls))
            )
        outputs, names = [gradient + ca.vertcat(head, tail), *outputs], ["grad", *names]
    hess_l = ca.Function(
        "nlp_hess_l",
        [variables, parameter, cost_multiplier, multipliers],
        outputs,
        ["x", "p", "lam_f", "lam_g"],
        names,
    )
    return {"nlp_g": g, "nlp_jac_g": jac_g, "nlp_hess_l": hess_l}


def _gather(vector: ca.MX, indices: np.ndarray) -> ca.MX:
    """Entries of a vector as a matrix of the table's shape."""
    return ca.reshape(vector[indices.ravel(order="F").tolist()], *indices.shape)
