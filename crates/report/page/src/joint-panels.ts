import type { JointLimits, ReportData } from "./data";
import { short } from "./format";
import type { Motion } from "./motion";
import { common, DEGREES, type Curve, type Panel } from "./panel";
import { jointColor } from "./theme";

/** What the joints that turn do, or those that slide; nothing where there are none. */
export function jointPanels({ spacecraft }: ReportData, motion: Motion, slides: boolean): Panel[] {
  const listed = spacecraft.joint_limits.flatMap((limits, i) => (limits.slides === slides ? [{ limits, i }] : []));
  if (listed.length === 0) return [];
  const [factor, unit] = slides ? [1, "m"] : [DEGREES, "deg"];
  const curves = (name: Parameters<Motion["component"]>[0], by = factor): Curve[] =>
    listed.map(({ i }) => ({
      name: spacecraft.joint_names[i] ?? `${i + 1}`, stroke: () => jointColor(i),
      values: motion.component(name, i).map((value) => by * value),
    }));
  const limits = listed.map((joint) => joint.limits);
  const [turned, rated, of, effort] = slides
    ? ["Joint travels", "Joint speeds", "of sliding joints", "Joint forces"]
    : ["Joint angles", "Joint rates", "", "Joint torques"];
  const title = (what: string, added = "") => `Joint ${what}${of && ` ${of}`}${added}`;
  const span = slides ? 0.01 : 1;
  const coordinates = curves("joint_angles_rad");
  const plain = { limits: { text: "", lines: [] }, held: false, leastSpan: 1e-6 };
  return [
    { ...plain, title: turned, unit, leastSpan: 1e-2 * span, curves: coordinates, limits: reached(limits, coordinates) },
    {
      ...plain, title: rated, unit: `${unit}/s`, leastSpan: 1e-3 * span, curves: curves("joint_rates_rad_s"),
      limits: symmetric(limits.map((limit) => limit.rate_max)),
    },
    {
      ...plain, title: title("accelerations", motion.hasJerks ? "" : ", the control"),
      unit: `${unit}/s²`, leastSpan: 1e-4 * span, held: !motion.hasJerks,
      curves: curves("joint_accelerations_rad_s2"),
      limits: symmetric(limits.map((limit) => limit.acceleration_max)),
    },
    ...(motion.hasJerks ? [{
      ...plain, title: title("jerks", ", the control"), unit: `${unit}/s³`, leastSpan: 1e-5 * span, held: true,
      curves: curves("joint_jerks_rad_s3"),
      limits: symmetric(limits.flatMap((limit) => limit.jerk_max ?? [])),
    }] : []),
    { ...plain, title: effort, unit: slides ? "N" : "N m", held: true, curves: curves("joint_torques_n_m", 1) },
  ];
}

function symmetric(limits: number[]): Panel["limits"] {
  const distinct = [...new Set(limits)].sort((a, b) => a - b);
  const text = `limit ±${distinct.map((limit) => short(limit, 3)).join(", ±")}`;
  return { text, lines: distinct.flatMap((limit) => [common(-limit), common(limit)]) };
}

/** The limits that a joint comes close to, in its colour: all of them would bury the curves. */
function reached(joints: JointLimits[], curves: Curve[]): Panel["limits"] {
  const lines = joints.flatMap(({ min, max }, i) => {
    const { values, stroke } = curves[i];
    const [low, high] = [Math.min(...Array.from(values)), Math.max(...Array.from(values))];
    const near = 0.02 * ((max ?? high) - (min ?? low));
    return [
      ...(min !== null && low - min < near ? [{ value: min, stroke }] : []),
      ...(max !== null && max - high < near ? [{ value: max, stroke }] : []),
    ];
  });
  return { text: lines.length > 0 ? "dashed: limits reached" : "", lines };
}
