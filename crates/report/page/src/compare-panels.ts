import type { ColumnName } from "./data";
import type { Motion } from "./motion";
import { DEGREES, type Curve, type Panel } from "./panel";
import { jointColor } from "./theme";

/** A plan by its name and its motion. */
export interface ComparedPlan {
  name: string;
  motion: Motion;
}

/** All times at which any plan has a node. */
export function allTimes(plans: ComparedPlan[]): number[] {
  const times = new Set(plans.flatMap(({ motion }) => Array.from(motion.time)));
  return [...times].sort((a, b) => a - b);
}

/** What the plans are compared by: one curve a plan. A plan's curve ends where the plan does. */
export function comparePanels(plans: ComparedPlan[], times: number[]): Panel[] {
  const panel = (title: string, unit: string, of: (motion: Motion, time: number) => number, held = false): Panel => ({
    title, unit, held, leastSpan: 1e-6, limits: { text: "", lines: [] },
    curves: plans.map(({ name, motion }, i): Curve => ({
      name, stroke: () => jointColor(i),
      values: times.map((time) => (time <= motion.duration ? of(motion, time) : NaN)),
    })),
  });
  const has = (name: ColumnName) => plans.some(({ motion }) => motion.width(name) > 0);
  const first = (name: ColumnName, factor = 1) => (motion: Motion, time: number) =>
    motion.width(name) > 0 ? factor * motion.sample(name, time)[0] : NaN;
  const length = (name: ColumnName, factor = 1) => (motion: Motion, time: number) =>
    factor * Math.hypot(...motion.sample(name, time));
  const accelerations = (motion: Motion, time: number) => {
    const name = "joint_accelerations_rad_s2";
    return DEGREES * Math.hypot(...(motion.hasJerks ? motion.sample(name, time) : motion.held(name, time)));
  };
  const torque = (motion: Motion, time: number) =>
    Math.max(...motion.held("joint_torques_n_m", time).map(Math.abs));
  const isHeld = plans.every(({ motion }) => !motion.hasJerks);
  return [
    ...(has("attitude_error_rad")
      ? [panel("Angle to the target", "deg", first("attitude_error_rad", DEGREES))] : []),
    panel("Angular rate of the base", "deg/s", length("angular_rate_rad_s", DEGREES)),
    panel("Joint rates, norm", "deg/s", length("joint_rates_rad_s", DEGREES)),
    panel("Joint accelerations, norm", "deg/s²", accelerations, isHeld),
    panel("Largest joint torque", "N m", torque, true),
    panel("Mechanical power of the joints", "W", first("power_w")),
    panel("Momentum of the arm's motion", "N m s", length("arm_momentum_n_m_s")),
    ...(has("body_clearance_m") ? [panel("Least clearance from the base", "m", first("body_clearance_m"))] : []),
    ...(has("link_clearance_m") ? [panel("Least clearance between links", "m", first("link_clearance_m"))] : []),
  ];
}
