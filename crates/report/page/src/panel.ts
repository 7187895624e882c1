import type uPlot from "uplot";
import { color } from "./theme";

/** A curve over the times of all plots; not finite where there is nothing. */
export interface Curve {
  name: string;
  stroke: () => string;
  values: ArrayLike<number>;
}

export interface LimitLine {
  value: number;
  stroke: () => string;
}

/** One of the plots beneath each other. */
export interface Panel {
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

export const DEGREES = 180 / Math.PI;

/** A limit that is no curve's own. */
export function common(value: number): LimitLine {
  return { value, stroke: () => color("limit") };
}

/** Room for the curves, and for limits that do not squeeze them. */
export function range(panel: Panel, low: number | null, high: number | null): [number, number] {
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

export function drawLimits(plot: uPlot, lines: LimitLine[]): void {
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
export function tick(value: number, ticks: number[]): string {
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : Math.abs(value);
  const isPlain = step >= 1e-4 && step < 1e5;
  let decimals = 0;
  while (isPlain && Math.abs(+step.toFixed(decimals) - step) > 1e-3 * step) decimals++;
  const text = isPlain || step === 0 ? value.toFixed(decimals) : value.toExponential(1);
  return text.replaceAll("-", "\u2212");
}
