import {
  BoxGeometry, EdgesGeometry, Group, Mesh, SphereGeometry, Vector3, type BufferGeometry,
} from "three";
import type { Spacecraft } from "./data";
import { fromScalarFirst } from "./motion";
import { polyline, segments, Strut, surface, type Stroke } from "./parts";
import { color, jointColor } from "./theme";

/** The base and its arm, in body axes. */
export class SpacecraftModel {
  readonly group = new Group();
  private readonly links: Strut[] = [];
  private readonly joints: Strut[] = [];
  private readonly tip: Mesh;
  private points: Vector3[] = [];

  constructor(private readonly spacecraft: Spacecraft, reach: number) {
    const smallest = Math.min(...spacecraft.box_m);
    this.thickness = Math.min(0.02 * reach, 0.16 * smallest);
    this.group.add(box(spacecraft), boxEdges(spacecraft, { color: "edge", width: 1.5 }));
    const count = spacecraft.joint_points.length;
    for (let i = 0; i < count; i++) {
      const link = new Strut(this.thickness, surface(() => color("link")));
      const joint = new Strut(1.75 * this.thickness, surface(() => jointColor(i)));
      this.links.push(link);
      this.joints.push(joint);
      this.group.add(link.mesh, joint.mesh);
    }
    const size = spacecraft.has_payload ? 4 : 1.6;
    this.tip = new Mesh(new SphereGeometry(size * this.thickness, 32, 16), surface(() => color("tip")));
    this.group.add(this.tip);
  }

  private readonly thickness: number;

  /** Puts the arm where its points and joint axes are, body axes. */
  pose(points: Vector3[], axes: Vector3[]): void {
    this.points = points;
    this.links.forEach((link, i) => link.between(points[i], points[i + 1]));
    this.joints.forEach((joint, i) => {
      const center = points[this.spacecraft.joint_points[i]];
      const half = axes[i].clone().setLength(2.1 * this.thickness);
      joint.between(center.clone().sub(half), center.clone().add(half));
    });
    this.tip.position.copy(points[points.length - 1]);
  }

  /** The arm's points where they are drawn, in the axes of the whole scene's `space`. */
  pointsIn(space: Group): Vector3[] {
    this.group.updateWorldMatrix(true, false);
    return this.points.map((point) => space.worldToLocal(this.group.localToWorld(point.clone())));
  }
}

/** The base's box and its arm as lines: where they start, or shall arrive. */
export function ghost(spacecraft: Spacecraft, arm: Vector3[], stroke: Stroke): Group {
  const group = new Group();
  group.add(boxEdges(spacecraft, stroke), polyline(arm, { ...stroke, width: 2 * stroke.width }));
  return group;
}

function box(spacecraft: Spacecraft): Mesh {
  const mesh = new Mesh(new BoxGeometry(...spacecraft.box_m), surface(() => color("base")));
  mesh.quaternion.copy(fromScalarFirst(spacecraft.box_attitude));
  return mesh;
}

function boxEdges(spacecraft: Spacecraft, stroke: Stroke) {
  const edges: BufferGeometry = new EdgesGeometry(new BoxGeometry(...spacecraft.box_m));
  const position = edges.getAttribute("position");
  const points = Array.from({ length: position.count }, (_, i) =>
    new Vector3().fromBufferAttribute(position, i));
  const lines = segments(points, stroke);
  lines.quaternion.copy(fromScalarFirst(spacecraft.box_attitude));
  return lines;
}
