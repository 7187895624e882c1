import {
  BufferGeometry, CanvasTexture, Color, Float32BufferAttribute, Points, PointsMaterial, Vector3,
} from "three";
import { graticule, rings, triad } from "./overlays";
import { caption, painted } from "./parts";
import type { SlewPoint, SlewsData } from "./slew-data";
import { color } from "./theme";
import { Viewport } from "./viewport";

export type Coloring = "outcome" | "objective";

/** Angles between spheres, deg; the first that leaves at most six of them is taken. */
const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60, 180];
/** How far a pointer may be from a point that it means, CSS pixels. */
const REACH = { mouse: 10, touch: 24 };

type Draw = (context: CanvasRenderingContext2D) => void;

const disc: Draw = (context) => {
  context.arc(32, 32, 27, 0, 2 * Math.PI);
  context.fill();
  // A rim in a darker shade: neighbours of one colour stay apart.
  context.strokeStyle = "#888";
  context.lineWidth = 7;
  context.stroke();
};
const cross: Draw = (context) => {
  for (const [from, to] of [[10, 54], [54, 10]]) {
    context.moveTo(from, 10);
    context.lineTo(to, 54);
  }
  context.lineWidth = 14;
  context.stroke();
};
const ring: Draw = (context) => {
  context.arc(32, 32, 26, 0, 2 * Math.PI);
  context.lineWidth = 8;
  context.stroke();
};

/** Slews as points at their rotation vectors θ·n̂, body axes, degrees. */
export class SlewCloud {
  readonly viewport: Viewport;
  private readonly places: Vector3[];
  private readonly discs: Points;
  private readonly crosses: Points;
  private readonly mark = marks([new Vector3()], ring, 20);
  private coloring: Coloring = "outcome";
  private isShown: (index: number) => boolean = () => true;

  constructor(private readonly element: HTMLElement, private readonly data: SlewsData) {
    this.viewport = new Viewport(element);
    const { points } = data;
    this.places = points.map((slew) => new Vector3(...slew.axis).multiplyScalar(slew.angle_deg));
    const size = Math.max(5, 10 * Math.min(1, (300 / Math.max(points.length, 1)) ** 0.35));
    this.discs = marks(this.chosen(true).map((i) => this.places[i]), disc, size);
    this.crosses = marks(this.chosen(false).map((i) => this.places[i]), cross, size);
    this.mark.visible = false;
    this.mark.renderOrder = 11;
    this.viewport.scene.add(this.discs, this.crosses, this.mark);
    this.addSpheres();
    painted(() => this.paint());
  }

  color(coloring: Coloring): void {
    this.coloring = coloring;
    this.paint();
    this.viewport.requestDraw();
  }

  /** Draws only some of the points. */
  filter(isShown: (index: number) => boolean): void {
    this.isShown = isShown;
    place(this.discs, this.chosen(true).map((i) => this.places[i]));
    place(this.crosses, this.chosen(false).map((i) => this.places[i]));
    this.paint();
    this.viewport.requestDraw();
  }

  /** Puts a ring around a point, or around none. */
  select(index: number | null): void {
    this.mark.visible = index !== null;
    if (index !== null) this.mark.position.copy(this.places[index]);
    this.viewport.requestDraw();
  }

  /** The point that a pointer means: the closest, and of those about as close the one in front. */
  pick(x: number, y: number, kind: keyof typeof REACH): number | null {
    let best: { index: number; distance: number; depth: number } | null = null;
    for (let index = 0; index < this.places.length; index++) {
      if (!this.isShown(index)) continue;
      const [px, py, depth] = this.placeOf(index);
      const distance = Math.round(Math.hypot(px - x, py - y) / 3);
      if (3 * distance > REACH[kind]) continue;
      if (!best || distance < best.distance || (distance === best.distance && depth < best.depth)) {
        best = { index, distance, depth };
      }
    }
    return best?.index ?? null;
  }

  /** Where a point is in the window, CSS pixels, and how deep. */
  placeOf(index: number): [number, number, number] {
    const { camera } = this.viewport;
    camera.updateMatrixWorld();
    const { x, y, z } = this.places[index].clone().project(camera);
    const view = this.element.getBoundingClientRect();
    return [view.x + 0.5 * (1 + x) * view.width, view.y + 0.5 * (1 - y) * view.height, z];
  }

  /** How many other slews have the same rotation vector. */
  othersAt(index: number): number {
    const place = this.places[index];
    return this.places.filter((other, i) => this.isShown(i) && other.distanceTo(place) < 1e-6).length - 1;
  }

  private chosen(succeeded: boolean): number[] {
    const indices = this.data.points.map((_, i) => i);
    return indices.filter((i) => this.isShown(i) && this.data.points[i].succeeded === succeeded);
  }

  private addSpheres(): void {
    const largest = Math.max(...this.places.map((place) => place.length()), 1e-3);
    const step = STEPS.find((step) => largest <= 6 * step) ?? largest;
    const count = Math.ceil(largest / step - 1e-9);
    for (let i = 1; i <= count; i++) {
      const radius = i * step;
      const text = caption(`${Number(radius.toPrecision(3))}°`, "faint");
      text.position.set(0, -Math.SQRT1_2, Math.SQRT1_2).multiplyScalar(radius);
      const stroke = { color: "ink", width: 1, opacity: 0.16 };
      this.viewport.scene.add(i < count ? rings(radius, stroke) : graticule(radius), text);
    }
    this.viewport.scene.add(triad(1.1 * count * step, "B", 2));
    this.viewport.fit(new Vector3(), 1.2 * count * step);
  }

  private paint(): void {
    const succeeded = this.chosen(true).map((i) => this.data.points[i]);
    const one = color("accent");
    const shade = (slew: SlewPoint) => (this.coloring === "outcome" ? one : this.shade(slew));
    dye(this.discs, succeeded.map(shade));
    dye(this.crosses, this.chosen(false).map(() => color("x")));
    dye(this.mark, [color("ink")]);
  }

  private shade({ objective }: SlewPoint): string {
    const { ramp, objective: { low, high } } = this.data;
    const share = objective === null || objective <= 0 ? 0 : (Math.log10(objective) - low) / (high - low);
    return ramp[Math.round(Math.min(Math.max(share, 0), 1) * (ramp.length - 1))];
  }
}

/** Points with a picture of `size` CSS pixels, white until they are dyed. */
function marks(places: Vector3[], draw: Draw, size: number): Points {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d");
  if (context) {
    context.fillStyle = context.strokeStyle = "#fff";
    context.beginPath();
    draw(context);
  }
  const material = new PointsMaterial({
    map: new CanvasTexture(canvas), size, sizeAttenuation: false, vertexColors: true, alphaTest: 0.4,
  });
  const points = new Points(new BufferGeometry(), material);
  place(points, places);
  return points;
}

/** Puts points where they are, white until they are dyed. */
function place(points: Points, places: Vector3[]): void {
  points.geometry.dispose();
  points.geometry = new BufferGeometry().setFromPoints(places);
  points.geometry.setAttribute("color", new Float32BufferAttribute(new Float32Array(3 * places.length), 3));
  points.visible = places.length > 0;
}

function dye(points: Points, colors: string[]): void {
  const attribute = points.geometry.getAttribute("color");
  const made = new Color();
  colors.forEach((name, i) => {
    made.set(name);
    attribute.setXYZ(i, made.r, made.g, made.b);
  });
  attribute.needsUpdate = true;
}
