import { BoxGeometry, Group, Mesh, SphereGeometry, Vector3 } from "three";
import type { KeepOut, Spacecraft } from "./data";
import { fromScalarFirst } from "./motion";
import { boxEdges, Capsule, segments, Strut, surface, type Stroke } from "./parts";
import { color, jointColor } from "./theme";

/** The base and its arms, in body axes. */
export class SpacecraftModel {
  readonly group = new Group();
  private readonly links: Strut[] = [];
  private readonly joints: Strut[] = [];
  private readonly capsules: Capsule[];
  private readonly tips: Mesh[];
  private points: Vector3[] = [];

  constructor(private readonly spacecraft: Spacecraft, reach: number) {
    const smallest = Math.min(...spacecraft.box_m);
    this.thickness = Math.min(0.02 * reach, 0.16 * smallest);
    this.group.add(base(spacecraft), outline(spacecraft, { color: "edge", width: 1.5 }));
    for (const _ of spacecraft.links) this.links.push(new Strut(this.thickness, surface(() => color("link"))));
    spacecraft.joint_points.forEach((_, i) => {
      this.joints.push(new Strut(1.75 * this.thickness, surface(() => jointColor(i))));
    });
    this.group.add(...[...this.links, ...this.joints].map((strut) => strut.mesh));
    const size = spacecraft.has_payload ? 4 : 1.6;
    const ball = new SphereGeometry(size * this.thickness, 32, 16);
    this.tips = spacecraft.tips.map(() => new Mesh(ball, surface(() => color("tip"))));
    const skin = surface(() => color("link"), 0.45);
    this.capsules = spacecraft.capsule_radii_m.map((radius) => new Capsule(radius, skin));
    this.group.add(...this.tips, ...this.capsules.map((capsule) => capsule.group));
  }

  private readonly thickness: number;

  /** Puts the arms where their points, its joint axes and the ends of its capsules are, body axes. */
  pose(points: Vector3[], axes: Vector3[], capsules: Vector3[]): void {
    this.points = points;
    this.links.forEach((link, i) => link.between(...linkEnds(this.spacecraft, points, i)));
    this.joints.forEach((joint, i) => {
      const center = points[this.spacecraft.joint_points[i]];
      const half = axes[i].clone().setLength(2.1 * this.thickness);
      joint.between(center.clone().sub(half), center.clone().add(half));
    });
    this.tips.forEach((tip, i) => tip.position.copy(points[this.spacecraft.tips[i]]));
    this.capsules.forEach((capsule, i) => capsule.between(capsules[2 * i], capsules[2 * i + 1]));
  }

  /** The arm's points where they are drawn, in the axes of the whole scene's `space`. */
  pointsIn(space: Group): Vector3[] {
    this.group.updateWorldMatrix(true, false);
    return this.points.map((point) => space.worldToLocal(this.group.localToWorld(point.clone())));
  }
}

/** The two points that a link is drawn between. */
function linkEnds({ links }: Spacecraft, points: Vector3[], link: number): [Vector3, Vector3] {
  const [from, to] = links[link];
  return [points[from], points[to]];
}

/** The base and its arms as lines: where they start, or shall arrive. */
export function ghost(spacecraft: Spacecraft, arm: Vector3[], stroke: Stroke): Group {
  const group = new Group();
  const ends = spacecraft.links.flatMap((_, link) => linkEnds(spacecraft, arm, link));
  group.add(outline(spacecraft, stroke), segments(ends, { ...stroke, width: 2 * stroke.width }));
  return group;
}

/** The shapes that the arm keeps out of; without any, the uniform box with the base's inertia. */
function base(spacecraft: Spacecraft): Group {
  const group = new Group();
  const skin = surface(() => color("base"));
  for (const shape of spacecraft.keep_out) group.add(solid(shape, skin));
  if (spacecraft.keep_out.length === 0) {
    const mesh = new Mesh(new BoxGeometry(...spacecraft.box_m), skin);
    mesh.quaternion.copy(fromScalarFirst(spacecraft.box_attitude));
    mesh.position.fromArray(spacecraft.box_center_m);
    group.add(mesh);
  }
  return group;
}

function solid(shape: KeepOut, skin: ReturnType<typeof surface>): Group {
  if ("capsule" in shape) {
    const { from_m, to_m, radius_m } = shape.capsule;
    const capsule = new Capsule(radius_m, skin);
    capsule.between(new Vector3(...from_m), new Vector3(...to_m));
    return capsule.group;
  }
  const group = new Group();
  group.add(new Mesh(new BoxGeometry(...shape.box.size_m), skin));
  group.position.fromArray(shape.box.center_m);
  return group;
}

/** The edges of the same. */
function outline(spacecraft: Spacecraft, stroke: Stroke): Group {
  const group = new Group();
  for (const shape of spacecraft.keep_out) {
    if (!("box" in shape)) continue;
    const lines = boxEdges(shape.box.size_m, stroke);
    lines.position.fromArray(shape.box.center_m);
    group.add(lines);
  }
  if (spacecraft.keep_out.length === 0) {
    const lines = boxEdges(spacecraft.box_m, stroke);
    lines.quaternion.copy(fromScalarFirst(spacecraft.box_attitude));
    lines.position.fromArray(spacecraft.box_center_m);
    group.add(lines);
  }
  return group;
}

/** How far the base reaches from the origin of its frame, m. */
export function extent(spacecraft: Spacecraft): number {
  const of = (shape: KeepOut): number => {
    if ("box" in shape) {
      const { center_m, size_m } = shape.box;
      return Math.hypot(...center_m.map((center, i) => Math.abs(center) + size_m[i] / 2));
    }
    const { from_m, to_m, radius_m } = shape.capsule;
    return Math.max(Math.hypot(...from_m), Math.hypot(...to_m)) + radius_m;
  };
  const shapes = spacecraft.keep_out.map(of);
  if (shapes.length === 0) shapes.push(Math.hypot(...spacecraft.box_m) / 2);
  return Math.max(...shapes, spacecraft.keep_out_radius_m ?? 0);
}
