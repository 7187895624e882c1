import type { ReportData } from "./data";
import { short } from "./format";
import { jointPanels } from "./joint-panels";
import type { Motion } from "./motion";
import { common, DEGREES, type Curve, type Panel } from "./panel";
import { wheelPanels } from "./wheel-panels";
import { AXIS_COLORS, color } from "./theme";

/** What the page of a plan plots. */
export function panels(data: ReportData, motion: Motion): Panel[] {
  const { clearance_m } = data.spacecraft;
  const scaled = (values: Float32Array, factor: number) => values.map((value) => factor * value);
  const components = (name: Parameters<Motion["component"]>[0], factor = 1): Curve[] =>
    AXIS_COLORS.map((axis, i) => ({
      name: axis, stroke: () => color(axis), values: scaled(motion.component(name, i), factor),
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
    ...jointPanels(data, motion, false),
    ...jointPanels(data, motion, true),
    ...wheelPanels(data, motion),
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
