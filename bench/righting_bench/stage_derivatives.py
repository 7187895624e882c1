"""Hand-arranged stage derivatives: what a CasADi expert writes when nlpsol's own are too slow.

The step's Jacobian and Lagrangian Hessian are composed from those of the differential equation at the four
Runge-Kutta points, as in acados' explicit integrator, rather than by seeding the whole unrolled step.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from .problem import StageProblem

# (fraction of the step to the point, weight of its slope in the step), in order of evaluation.
RUNGE_KUTTA_POINTS = ((0.0, 1 / 6), (1 / 2, 1 / 3), (1 / 2, 1 / 3), (1.0, 1 / 6))


@dataclass(frozen=True)
class StageDerivatives:
    """Functions that return nonzeros as dense columns, with the sparsity each column fills.

    `step_jacobian` is (x, u); `path_jacobian` is (x). `stage_hessian` is (x, u, multipliers of the step,
    multipliers of the path, cost multiplier) and `terminal_hessian` (x, multipliers of the path, cost
    multiplier), both to the gradient and the upper triangle of the Hessian of cost + multipliers times rows.
    """

    step_jacobian: ca.Function
    step_jacobian_sparsity: ca.Sparsity
    path_jacobian: ca.Function
    path_jacobian_sparsity: ca.Sparsity
    stage_hessian: ca.Function
    stage_hessian_sparsity: ca.Sparsity
    terminal_hessian: ca.Function
    terminal_hessian_sparsity: ca.Sparsity


def composed_derivatives(problem: StageProblem) -> StageDerivatives:
    """Derivatives with the step's composed from the differential equation's."""
    return _derivatives(problem, _composed_step(problem))


def unrolled_derivatives(problem: StageProblem) -> StageDerivatives:
    """Derivatives with CasADi differentiating the unrolled step itself."""
    return _derivatives(problem, _unrolled_step(problem))


@dataclass(frozen=True)
class _StepDerivatives:
    """Symbolic point, multipliers and derivatives of the step."""

    state: ca.SX
    control: ca.SX
    multipliers: ca.SX
    jacobian: ca.SX
    hessian: ca.SX


def _unrolled_step(problem: StageProblem) -> _StepDerivatives:
    state, control, multipliers = _symbols(problem)
    following = problem.step(state, control)
    point = ca.vertcat(state, control)
    hessian, _ = ca.hessian(ca.dot(multipliers, following), point)
    return _StepDerivatives(state, control, multipliers, ca.jacobian(following, point), hessian)


def _composed_step(problem: StageProblem) -> _StepDerivatives:
    state, control, multipliers = _symbols(problem)
    states, controls, step = problem.states, problem.controls, problem.step_s
    dynamics = problem.dynamics
    slope_jacobian, slope_hessian = _slope_derivatives(dynamics)
    identity = ca.SX.eye(states + controls)
    to_state, to_control = identity[:states, :], identity[states:, :]

    points, point_jacobians, state_jacobians = [], [], []
    slope, slope_total = ca.SX.zeros(states), ca.SX(states, states + controls)
    jacobian = to_state
    for fraction, weight in RUNGE_KUTTA_POINTS:
        at = state + fraction * step * slope
        point_jacobian = to_state + fraction * step * slope_total
        local = slope_jacobian(at, control)
        slope = dynamics(at, control)
        slope_total = local[:, :states] @ point_jacobian + local[:, states:] @ to_control
        jacobian = jacobian + weight * step * slope_total
        points.append(at)
        point_jacobians.append(ca.vertcat(point_jacobian, to_control))
        state_jacobians.append(local[:, :states])

    adjoints = [weight * step * multipliers for _, weight in RUNGE_KUTTA_POINTS]
    for later in (3, 2, 1):
        fraction = RUNGE_KUTTA_POINTS[later][0]
        adjoints[later - 1] += fraction * step * (state_jacobians[later].T @ adjoints[later])
    hessian = ca.SX(states + controls, states + controls)
    for at, jac, adjoint in zip(points, point_jacobians, adjoints, strict=True):
        hessian = hessian + jac.T @ slope_hessian(at, control, adjoint) @ jac
    return _StepDerivatives(state, control, multipliers, jacobian, hessian)


def _slope_derivatives(dynamics: ca.Function) -> tuple[ca.Function, ca.Function]:
    state, control = ca.SX.sym("x", dynamics.size1_in(0)), ca.SX.sym("u", dynamics.size1_in(1))
    adjoint = ca.SX.sym("a", dynamics.size1_in(0))
    point, slope = ca.vertcat(state, control), dynamics(state, control)
    jacobian = ca.jacobian(slope, point)
    hessian, _ = ca.hessian(ca.dot(adjoint, slope), point)
    return (
        ca.Function("slope_jacobian", [state, control], [jacobian]),
        ca.Function("slope_hessian", [state, control, adjoint], [hessian]),
    )


def _derivatives(problem: StageProblem, step: _StepDerivatives) -> StageDerivatives:
    state, control = step.state, step.control
    path_multipliers, cost_multiplier = ca.SX.sym("mu", problem.path_rows), ca.SX.sym("sigma")
    point = ca.vertcat(state, control)
    margins = problem.path(state)
    path_jacobian = ca.jacobian(margins, state)
    path_sum = ca.dot(path_multipliers, margins) if problem.path_rows else ca.SX(0)

    beside = cost_multiplier * problem.running(control) + path_sum
    beside_hessian, beside_gradient = ca.hessian(beside, point)
    stage_gradient = ca.densify(step.jacobian.T @ step.multipliers + beside_gradient)
    stage_hessian = ca.triu(step.hessian + beside_hessian)

    terminal = cost_multiplier * problem.terminal(state) + path_sum
    terminal_hessian, terminal_gradient = ca.hessian(terminal, state)
    terminal_hessian = ca.triu(terminal_hessian)
    stage_inputs = [state, control, step.multipliers, path_multipliers, cost_multiplier]
    return StageDerivatives(
        step_jacobian=_function("step_jacobian", [state, control], [_nonzeros(step.jacobian)]),
        step_jacobian_sparsity=step.jacobian.sparsity(),
        path_jacobian=_function("path_jacobian", [state], [_nonzeros(path_jacobian)]),
        path_jacobian_sparsity=path_jacobian.sparsity(),
        stage_hessian=_function("stage_hessian", stage_inputs, [stage_gradient, _nonzeros(stage_hessian)]),
        stage_hessian_sparsity=stage_hessian.sparsity(),
        terminal_hessian=_function(
            "terminal_hessian",
            [state, path_multipliers, cost_multiplier],
            [ca.densify(terminal_gradient), _nonzeros(terminal_hessian)],
        ),
        terminal_hessian_sparsity=terminal_hessian.sparsity(),
    )


def _symbols(problem: StageProblem) -> tuple[ca.SX, ca.SX, ca.SX]:
    return (
        ca.SX.sym("x", problem.states),
        ca.SX.sym("u", problem.controls),
        ca.SX.sym("lam", problem.states),
    )


def _nonzeros(matrix: ca.SX) -> ca.SX:
    return ca.vertcat(ca.SX(0, 1), *matrix.nonzeros())


def _function(name: str, inputs: list[ca.SX], outputs: list[ca.SX]) -> ca.Function:
    return ca.Function(name, inputs, ca.cse(outputs))
