import { Group, Quaternion, Vector3 } from "three";
import { decodeColumn, type ConeData } from "./data";
import type { Motion } from "./motion";
import { Trail } from "./overlays";
import { polyline, segments, type Stroke } from "./parts";

const POLE = new Vector3(0, 0, 1);
/** Straight lines from the tip of a cone to its rim. */
const LINES = 12;

/** The cone of an instrument on the inertial sphere, the way of its boresight there, and the boresight itself. */
export class Cone {
  /** In inertial axes about the base: cone and way. */
  readonly group = new Group();
  /** In body axes. */
  readonly ray = new Group();
  private readonly surface: Group;
  private readonly trail: Trail;
  private readonly axes: Float32Array;

  constructor(data: ConeData, radius: number, motion: Motion) {
    const name = data.is_inside ? "target" : "keep-out";
    this.axes = decodeColumn(data.axes);
    this.surface = cone(data.half_angle_rad, radius, { color: name, width: 1.5, opacity: 0.8 });
    const boresight = new Vector3(...data.boresight_body);
    const directions = Array.from({ length: motion.nodes }, (_, k) =>
      boresight.clone().applyQuaternion(motion.attitudeAt(k)));
    this.trail = new Trail(directions, radius, null, name);
    this.group.add(this.surface, this.trail.group);
    const end = boresight.clone().multiplyScalar(radius);
    this.ray.add(segments([new Vector3(), end], { color: name, width: 2 }));
  }

  /** Shows the moment at a share of the interval that begins at node k, and the way up to node `past`. */
  show(k: number, share: number, past: number): void {
    const [from, to] = [k, k + 1].map((node) => new Vector3().fromArray(this.axes, 3 * node));
    const axis = from.lerp(to, share).normalize();
    this.surface.quaternion.copy(new Quaternion().setFromUnitVectors(POLE, axis));
    this.trail.upTo(past);
  }
}

/** Rim and lines of a cone about the pole with its tip at the origin. */
function cone(halfAngle: number, radius: number, stroke: Stroke): Group {
  const group = new Group();
  const [height, width] = [radius * Math.cos(halfAngle), radius * Math.sin(halfAngle)];
  const rim = (turn: number) =>
    new Vector3(width * Math.cos(turn), width * Math.sin(turn), height);
  const full = 2 * Math.PI;
  group.add(polyline(Array.from({ length: 97 }, (_, i) => rim((i / 96) * full)), stroke));
  const lines = Array.from({ length: LINES }, (_, i) => [new Vector3(), rim((i / LINES) * full)]);
  group.add(segments(lines.flat(), { ...stroke, width: 1, opacity: 0.35 }));
  return group;
}
