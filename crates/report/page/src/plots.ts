import uPlot from "uplot";
import { element } from "./element";
import { clock, short } from "./format";
import { locate } from "./motion";
import { drawLimits, range, tick, type Curve, type Panel } from "./panel";
import type { Player } from "./player";
import { color, onThemeChange } from "./theme";

/** Whole pixels: uPlot scales no others. */
const FONT_PX = 11;

/** The plots beneath each other, all with the player's time; dragging on one seeks, pointing at one reads. */
export class Plots {
  private readonly plots: { plot: uPlot; readouts: HTMLElement[]; panel: Panel }[] = [];
  private readonly times: number[];
  /** The node that the pointer is at, if it is in a plot. */
  private pointed: number | null = null;

  /** `times` are those of all curves of `panels`. */
  constructor(
    private readonly container: HTMLElement, panels: Panel[], times: ArrayLike<number>,
    private readonly player: Player,
  ) {
    this.times = Array.from(times);
    for (const panel of panels) this.add(panel);
    new ResizeObserver(() => this.resize()).observe(container);
    onThemeChange(() => this.plots.forEach(({ plot }) => plot.redraw(false)));
  }

  /** Moves the time line and the readouts. */
  show(time: number): void {
    for (const { plot } of this.plots) {
      const line = plot.over.querySelector<HTMLElement>(".now");
      if (line) line.style.transform = `translateX(${plot.valToPos(time, "x")}px)`;
    }
    this.read();
  }

  /** Writes the values at the node pointed at, or, where none is, at the player's time. */
  private read(): void {
    const time = this.pointed === null ? this.player.time : this.times[this.pointed];
    const { k, share } = locate(this.times, time);
    this.container.classList.toggle("pointed", this.pointed !== null);
    for (const { readouts, panel } of this.plots) {
      panel.curves.forEach(({ values }, i) => {
        const [a, b] = [values[k], values[k + 1]];
        const value = share === 1 ? (panel.held ? a : b)
          : panel.held || share === 0 ? a : a + share * (b - a);
        readouts[i].textContent = short(value);
      });
    }
  }

  /** Takes the node that uPlot's cursor is at; all plots have one cursor. */
  private point(plot: uPlot): void {
    const { left, idx } = plot.cursor;
    const isInside = left !== undefined && left >= 0 && idx != null;
    this.pointed = isInside ? idx : null;
    const flag = plot.over.querySelector<HTMLElement>(".at");
    if (flag && isInside) {
      const x = plot.valToPos(this.times[idx], "x");
      flag.textContent = `${clock(this.times[idx], this.player.duration)} s`;
      flag.style.transform = `translateX(${x}px)` + (x > 0.7 * plot.over.clientWidth ? " translateX(-100%)" : "");
    }
    this.read();
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
    plot.over.append(element("div", "now"), element("div", "at"));
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
        points: { size: 6 },
        sync: { key: "righting" },
        drag: { x: true, y: false, setScale: true },
        // A plain drag scrubs; with Shift it zooms, as a double click does out.
        bind: { mousedown: (_plot, _target, handler) => (event) => (event.shiftKey ? handler(event) : null) },
      },
      hooks: {
        draw: [(plot) => drawLimits(plot, panel.limits.lines)],
        setCursor: [(plot) => this.point(plot)],
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
