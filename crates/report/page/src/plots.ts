import uPlot from "uplot";
import type { JointLimits, ReportData } from "./data";
import { element } from "./element";
import { short } from "./format";
import type { Motion } from "./motion";
import type { Player } from "./player";
import { AXIS_COLORS, color, jointColor, onThemeChange } from "./theme";

interface Curve {
  name: string;
  stroke: () => string;
  values: ArrayLike<number>;
}

interface LimitLine {
  value: number;
  stroke: () => string;
}

interface Panel {
  title: string;
  unit: string;
  curves: Curve[];
  /** Dashed where they are near the curves, named in any case. */
  limits: { text: string; lines: LimitLine[] };
  /** Held over each interval rather than joined. */
  held: boolean;
  /** Below this height curves count as constant. */
  leastSpan: number;
}

const DEGREES = 180 / Math.PI;
/** Whole pixels: uPlot scales no others. */
const FONT_PX = 11;

/** The plots beneath each other, all with the player's time; dragging on one seeks. */
export class Plots {
  private readonly plots: { plot: uPlot; readouts: HTMLElement[]; panel: Panel }[] = [];
  private readonly times: number[];

  constructor(
    private readonly container: HTMLElement, data: ReportData,
    private readonly motion: Motion, private readonly player: Player,
  ) {
    this.times = Array.from(motion.time);
    for (const panel of panels(data, motion)) this.add(panel);
    new ResizeObserver(() => this.resize()).observe(container);
    onThemeChange(() => this.plots.forEach(({ plot }) => plot.redraw(false)));
  }

  /** Moves the time line and the readouts. */
  show(time: number): void {
    const { k, share } = this.motion.locate(time);
    for (const { plot, readouts, panel } of this.plots) {
      const line = plot.over.querySelector<HTMLElement>(".now");
      if (line) line.style.transform = `translateX(${plot.valToPos(time, "x")}px)`;
      panel.curves.forEach(({ values }, i) => {
        const [a, b] = [values[k], values[k + 1]];
        const value = share === 1 ? (panel.held ? a : b)
          : panel.held || share === 0 ? a : a + share * (b - a);
        readouts[i].textContent = short(value);
      });
    }
  }

  private add(panel: Panel): void {
    const figure = document.createElement("figure");
    const caption = document.createElement("figcaption");
    const title = element("span", "title", panel.title);
    title.append(element("span", "unit", ` [${panel.unit}]`));
    if (panel.limits.text) title.append(element("span", "limit", panel.limits.text));
    const legend = element("span", "legend");
    const readouts = panel.curves.map((curve, i) => {
      const chip = element("button", "chip");
      const readout = element("b");
      if (curve.name) chip.append(element("i"), element("span", "", curve.name));
      chip.append(readout);
      const paint = () => chip.style.setProperty("--swatch", curve.stroke());
      paint();
      onThemeChange(paint);
      chip.title = "Show or hide";
      chip.addEventListener("click", () => {
        const shown = !plot.series[i + 1].show;
        plot.setSeries(i + 1, { show: shown });
        chip.classList.toggle("off", !shown);
      });
      legend.append(chip);
      return readout;
    });
    caption.append(title, legend);
    const place = element("div", "plot");
    figure.append(caption, place);
    this.container.append(figure);
    const plot = new uPlot(this.options(panel), this.columns(panel), place);
    plot.over.append(element("div", "now"));
    this.scrubOn(plot);
    this.plots.push({ plot, readouts, panel });
  }

  private columns(panel: Panel): uPlot.AlignedData {
    const column = ({ values }: Curve) =>
      Array.from(values, (value) => (Number.isFinite(value) ? value : null));
    return [this.times, ...panel.curves.map(column)];
  }

  private options(panel: Panel): uPlot.Options {
    const axis: uPlot.Axis = {
      stroke: () => color("faint"),
      font: `${FONT_PX}px system-ui, sans-serif`,
      grid: { stroke: () => color("grid"), width: 1 },
      ticks: { show: false },
    };
    const paths = panel.held ? uPlot.paths.stepped?.({ align: 1 }) : undefined;
    return {
      ...this.size(),
      legend: { show: false },
      scales: {
        x: { time: false },
        y: { range: (_, low, high) => range(panel, low, high) },
      },
      axes: [
        { ...axis, size: 22, gap: 2, space: 60, values: (_, ticks) => ticks.map((t) => `${tick(t, ticks)} s`) },
        { ...axis, size: 50, gap: 4, space: 22, values: (_, ticks) => ticks.map((v) => tick(v, ticks)) },
      ],
      series: [
        {},
        ...panel.curves.map((curve): uPlot.Series => ({
          stroke: curve.stroke, width: 1.5, points: { show: false }, ...(paths ? { paths } : {}),
        })),
      ],
      cursor: {
        y: false,
        points: { show: false },
        sync: { key: "righting" },
        drag: { x: true, y: false, setScale: true },
        // A plain drag scrubs; with Shift it zooms, as a double click does out.
        bind: { mousedown: (_plot, _target, handler) => (event) => (event.shiftKey ? handler(event) : null) },
      },
      hooks: {
        draw: [(plot) => drawLimits(plot, panel.limits.lines)],
        setScale: [(plot, key) => { if (key === "x") this.zoomTo(plot); }],
      },
    };
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(this.container.clientWidth, 200), height: 138 };
  }

  private resize(): void {
    for (const { plot } of this.plots) plot.setSize(this.size());
    this.show(this.player.time);
  }

  /** All plots show the stretch of time that one of them was zoomed to. */
  private zoomTo(source: uPlot): void {
    const { min, max } = source.scales["x"];
    if (min == null || max == null) return;
    for (const { plot } of this.plots) {
      const { min: low, max: high } = plot.scales["x"];
      if (low !== min || high !== max) plot.setScale("x", { min, max });
    }
    this.show(this.player.time);
  }

  private scrubOn(plot: uPlot): void {
    const { over } = plot;
    let scrubbing = false;
    const seek = (event: PointerEvent) => {
      const left = event.clientX - over.getBoundingClientRect().left;
      this.player.seek(plot.posToVal(left, "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      if (event.shiftKey || event.button !== 0) return;
      scrubbing = true;
      this.player.pause();
      over.setPointerCapture(event.pointerId);
      seek(event);
    });
    over.addEventListener("pointermove", (event) => { if (scrubbing) seek(event); });
    for (const end of ["pointerup", "pointercancel"] as const) {
      over.addEventListener(end, () => { scrubbing = false; });
    }
  }
}

function panels(data: ReportData, motion: Motion): Panel[] {
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

function common(value: number): LimitLine {
  return { value, stroke: () => color("limit") };
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

/** Room for the curves, and for limits that do not squeeze them. */
function range(panel: Panel, low: number | null, high: number | null): [number, number] {
  let [from, to] = [low ?? 0, high ?? 0];
  const span = Math.max(to - from, panel.leastSpan);
  const middle = (from + to) / 2;
  [from, to] = [Math.min(from, middle - span / 2), Math.max(to, middle + span / 2)];
  for (const { value: limit } of panel.limits.lines) {
    if (limit > middle && limit - to < 0.35 * span) to = Math.max(to, limit);
    if (limit < middle && from - limit < 0.35 * span) from = Math.min(from, limit);
  }
  const pad = 0.06 * (to - from);
  return [from - pad, to + pad];
}

function drawLimits(plot: uPlot, lines: LimitLine[]): void {
  const { ctx, bbox } = plot;
  const { min = 0, max = 0 } = plot.scales["y"];
  ctx.save();
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
  for (const { value, stroke } of lines) {
    ctx.strokeStyle = stroke();
    if (value < (min ?? 0) || value > (max ?? 0)) continue;
    const y = plot.valToPos(value, "y", true);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
  }
  ctx.restore();
}

/** A tick label with just the decimals that tell the ticks apart. */
function tick(value: number, ticks: number[]): string {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : Math.abs(value);
  const isPlain = step >= 1e-4 && step < 1e5;
  let decimals = 0;
  while (isPlain && Math.abs(+step.toFixed(decimals) - step) > 1e-3 * step) decimals++;
  const text = isPlain || step === 0 ? value.toFixed(decimals) : value.toExponential(1);
  return text.replaceAll("-", "\u2212");
}
