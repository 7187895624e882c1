import {
  ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3,
} from "three";
import type { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { label, painted, polyline, segments, type Stroke } from "./parts";
import { AXIS_COLORS, color } from "./theme";

const UNIT = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/** Three axes x, y, z with the index of their frame. */
export function triad(length: number, frame: string, width: number): Group {
  const group = new Group();
  UNIT.forEach((axis, i) => {
    const end = axis.clone().multiplyScalar(length);
    const name = label(AXIS_COLORS[i], frame, AXIS_COLORS[i]);
    name.position.copy(axis).multiplyScalar(1.06 * length);
    // Beside the axis: an arm often points along one.
    name.center.set(-0.35, 0.5);
    group.add(segments([new Vector3(), end], { color: AXIS_COLORS[i], width }), name);
  });
  return group;
}

/** A circle about an axis, on a sphere of `radius` about the origin, `share` of the way to its pole. */
function circle(radius: number, axis: Vector3, share: number): Vector3[] {
  const turn = new Quaternion().setFromUnitVectors(UNIT[2], axis);
  const [height, width] = [radius * Math.sin(share), radius * Math.cos(share)];
  return Array.from({ length: 97 }, (_, i) => {
    const angle = (i / 48) * Math.PI;
    return new Vector3(width * Math.cos(angle), width * Math.sin(angle), height).applyQuaternion(turn);
  });
}

/** Meridians and parallels of a sphere about the origin, every 30°. */
export function graticule(radius: number): Group {
  const group = new Group();
  const step = Math.PI / 6;
  const faint: Stroke = { color: "ink", width: 1, opacity: 0.1 };
  for (let i = -2; i <= 2; i++) {
    const stroke = i === 0 ? { ...faint, opacity: 0.22 } : faint;
    group.add(polyline(circle(radius, UNIT[2], i * step), stroke));
  }
  for (let i = 0; i < 6; i++) {
    const pole = new Vector3(Math.cos(i * step), Math.sin(i * step), 0);
    group.add(polyline(circle(radius, pole, 0), faint));
  }
  return group;
}

/** A sphere about the origin as its circles in the planes of the axes. */
export function rings(radius: number, stroke: Stroke): Group {
  const group = new Group();
  for (const axis of UNIT) group.add(polyline(circle(radius, axis, 0), stroke));
  return group;
}

/** The sphere that links keep out of; nothing if its radius is zero. */
export function keepOut(radius: number): Group {
  if (radius === 0) return new Group();
  const material = new MeshBasicMaterial({ transparent: true, opacity: 0.07, depthWrite: false });
  painted(() => material.color.set(color("keep-out")));
  const group = new Group();
  group.add(new Mesh(new SphereGeometry(radius, 48, 32), material));
  group.add(rings(radius, { color: "keep-out", width: 1, opacity: 0.3 }));
  return group;
}

/** The system's center of mass, where it stays. */
export function centerMark(size: number): Group {
  const group = new Group();
  const arms = UNIT.flatMap((axis) => [axis.clone().multiplyScalar(-size), axis.clone().multiplyScalar(size)]);
  group.add(segments(arms, { color: "ink", width: 1.5, opacity: 0.8 }));
  return group;
}

/** An arrow with the length of a vector. */
export class Arrow {
  readonly group = new Group();
  private readonly shaft: Mesh;
  private readonly head: Mesh;

  constructor(name: string, private readonly thickness: number) {
    // Momentum starts at the center of mass, which is inside the base: seen through it.
    const material = new MeshBasicMaterial({ depthTest: false, transparent: true });
    painted(() => material.color.set(color(name)));
    this.shaft = new Mesh(new CylinderGeometry(thickness, thickness, 1, 16), material);
    this.head = new Mesh(new ConeGeometry(2.6 * thickness, 7 * thickness, 24), material);
    this.shaft.renderOrder = this.head.renderOrder = 5;
    this.group.add(this.shaft, this.head);
  }

  point(vector: Vector3): void {
    const length = vector.length();
    const head = Math.min(7 * this.thickness, 0.5 * length);
    this.group.visible = length > 0.2 * this.thickness;
    if (!this.group.visible) return;
    this.shaft.scale.y = length - head;
    this.shaft.position.y = 0.5 * (length - head);
    this.head.scale.setScalar(head / (7 * this.thickness));
    this.head.position.y = length - 0.5 * head;
    this.group.quaternion.setFromUnitVectors(UNIT[1], vector.clone().divideScalar(length));
  }
}

/** The way of a body axis over the inertial sphere: all of it faint, what is past strong. */
export class Trail {
  readonly group = new Group();
  private readonly past: LineSegments2;
  private readonly pieces: number;

  constructor(directions: Vector3[], radius: number, goal: Vector3 | null, name: string) {
    const points = directions.map((direction) => direction.clone().multiplyScalar(radius));
    this.pieces = points.length - 1;
    this.past = polyline(points, { color: name, width: 3 });
    this.group.add(polyline(points, { color: name, width: 1.5, opacity: 0.35 }), this.past);
    if (goal) {
      const ring = circle(radius, goal, Math.PI / 2 - 0.035);
      this.group.add(polyline(ring, { color: "target", width: 2 }));
    }
  }

  /** Shows the past up to node k. */
  upTo(k: number): void {
    this.past.geometry.instanceCount = Math.min(k, this.pieces);
    this.past.visible = k > 0;
  }
}
