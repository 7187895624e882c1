import type { JointLimits, ReportData } from "./data";
import { short } from "./format";
import type { Motion } from "./motion";
import { common, DEGREES, type Curve, type Panel } from "./panel";
import { AXIS_COLORS, color, jointColor } from "./theme";

/** What the page of a plan plots. */
export function panels(data: ReportData, motion: Motion): Panel[] {
  const { joint_limits, clearance_m } = data.spacecraft;
  const scaled = (values: Float32Array, factor: number) => values.map((value) => factor * value);
  const components = (name: Parameters<Motion["component"]>[0], factor = 1): Curve[] =>
    AXIS_COLORS.map((axis, i) => ({
      name: axis, stroke: () => color(axis), values: scaled(motion.component(name, i), factor),
    }));
  const joints = (name: Parameters<Motion["component"]>[0], factor = 1): Curve[] =>
    joint_limits.map((_, i) => ({
      name: data.spacecraft.joint_names[i] ?? `${i + 1}`, stroke: () => jointColor(i), values: scaled(motion.component(name, i), factor),
    }));
  const one = (name: string, values: ArrayLike<number>, paint = "ink"): Curve =>
    ({ name, stroke: () => color(paint), values });
  const none = { text: "", lines: [] };
  const plain = { limits: none, held: false, leastSpan: 1e-6 };
  const rates = components("angular_rate_rad_s", DEGREES);
  const spin = motion.time.map((_, k) => Math.hypot(...rates.map(({ values }) => values[k])));
  const clearances: Curve[] = [];
  if (motion.width("body_clearance_m")) {
    const what = data.spacecraft.keep_out.length > 0 ? "from the base" : "keep-out sphere";
    clearances.push(one(what, motion.component("body_clearance_m"), "joint-0"));
  }
  if (motion.width("link_clearance_m")) {
    clearances.push(one("between links", motion.component("link_clearance_m"), "joint-1"));
  }
  const bound = data.bound_deg_s;
  const angles = joints("joint_angles_rad", DEGREES);
  const isSlew = motion.width("attitude_error_rad") > 0;
  return [
    ...(isSlew ? [{
      ...plain, title: data.waypoints.length > 0 ? "Angle to the next target" : "Angle to the target", unit: "deg", leastSpan: 1e-3,
      curves: [one("", scaled(motion.component("attitude_error_rad"), DEGREES))],
    }] : []),
    {
      ...plain, title: "Angular rate of the base, body axes", unit: "deg/s", leastSpan: 1e-4,
      curves: [...rates, one("|ω|", spin)],
      limits: bound === null ? none : { text: `least possible ${short(bound, 3)}`, lines: [common(bound)] },
    },
    {
      ...plain, title: "Joint angles", unit: "deg", leastSpan: 1e-2, curves: angles,
      limits: reachedAngles(joint_limits, angles),
    },
    {
      ...plain, title: "Joint rates", unit: "deg/s", leastSpan: 1e-3, curves: joints("joint_rates_rad_s", DEGREES),
      limits: symmetric(joint_limits.map((limit) => limit.rate_max_deg_s)),
    },
    {
      ...plain, title: motion.hasJerks ? "Joint accelerations" : "Joint accelerations, the control",
      unit: "deg/s²", leastSpan: 1e-4, held: !motion.hasJerks,
      curves: joints("joint_accelerations_rad_s2", DEGREES),
      limits: symmetric(joint_limits.map((limit) => limit.acceleration_max_deg_s2)),
    },
    ...(motion.hasJerks ? [{
      ...plain, title: "Joint jerks, the control", unit: "deg/s³", leastSpan: 1e-5, held: true,
      curves: joints("joint_jerks_rad_s3", DEGREES),
      limits: symmetric(joint_limits.flatMap((limit) => limit.jerk_max_deg_s3 ?? [])),
    }] : []),
    { ...plain, title: "Joint torques", unit: "N m", held: true, curves: joints("joint_torques_n_m") },
    { ...plain, title: "Mechanical power of the joints", unit: "W", curves: [one("", motion.component("power_w"))] },
    {
      ...plain, title: "Momentum of the arm's motion, body axes", unit: "N m s",
      curves: components("arm_momentum_n_m_s"),
    },
    ...(clearances.length > 0 ? [{
      ...plain, title: "Least clearance", unit: "m", leastSpan: 1e-3, curves: clearances,
      limits: { text: `at least ${short(clearance_m, 3)}`, lines: [common(clearance_m)] },
    }] : []),
  ];
}

function symmetric(limits: number[]): Panel["limits"] {
  const distinct = [...new Set(limits)].sort((a, b) => a - b);
  const text = `limit ±${distinct.map((limit) => short(limit, 3)).join(", ±")}`;
  return { text, lines: distinct.flatMap((limit) => [common(-limit), common(limit)]) };
}

/** The limits that a joint comes close to, in its colour: all of them would bury the curves. */
function reachedAngles(joints: JointLimits[], curves: Curve[]): Panel["limits"] {
  const lines = joints.flatMap(({ angle_min_deg, angle_max_deg }, i) => {
    const { values, stroke } = curves[i];
    const [low, high] = [Math.min(...Array.from(values)), Math.max(...Array.from(values))];
    const near = 0.02 * ((angle_max_deg ?? high) - (angle_min_deg ?? low));
    return [
      ...(angle_min_deg !== null && low - angle_min_deg < near ? [{ value: angle_min_deg, stroke }] : []),
      ...(angle_max_deg !== null && angle_max_deg - high < near ? [{ value: angle_max_deg, stroke }] : []),
    ];
  });
  return { text: lines.length > 0 ? "dashed: limits reached" : "", lines };
}
