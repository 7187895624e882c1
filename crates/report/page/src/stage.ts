import { Group, Matrix4, Quaternion, Vector3 } from "three";
import { Cone } from "./cone";
import type { ReportData } from "./data";
import { fromScalarFirst, type Motion } from "./motion";
import { Arrow, centerMark, graticule, keepOut, Trail, triad } from "./overlays";
import { segments } from "./parts";
import { extent, ghost, SpacecraftModel } from "./spacecraft";
import { AXIS_COLORS } from "./theme";
import { Viewport } from "./viewport";
import { wheelAxes } from "./wheel-axes";

export const LAYERS = ["boresight", "momentum", "keep-out", "cones", "wheels", "ghosts", "axes", "sky"] as const;
export type Layer = (typeof LAYERS)[number];
export type FrameName = "inertial" | "body";

/** Momentum of the arm's motion, of the base with the arm held, in store in the wheels, and of all, N m s. */
export interface Momenta {
  arm: Vector3;
  base: Vector3;
  wheels: Vector3;
  total: Vector3;
}

const ARROWS = ["arm", "base", "wheels", "total"] as const;
const BODY_AXES = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/** Everything in the 3D view, as a function of time. */
export class Stage {
  readonly viewport: Viewport;
  frame: FrameName = "inertial";
  boresight = 0;
  /** Inertial axes, about the base's place at the start. */
  private readonly space = new Group();
  /** Inertial axes, carried with the base: directions. */
  private readonly sky = new Group();
  private readonly spacecraft: SpacecraftModel;
  private readonly layers: Record<Layer, Group[]>;
  private readonly cones: Cone[];
  private readonly trails: Trail[];
  private readonly rays: Group[];
  private readonly arrows: Record<(typeof ARROWS)[number], Arrow>;
  private readonly momentumScale: number;
  /** How far the arm reaches, and where directions are shown: m from the base. */
  private readonly reach: number;
  private readonly skyRadius: number;
  private time = 0;

  constructor(element: HTMLElement, private readonly data: ReportData, private readonly motion: Motion) {
    this.viewport = new Viewport(element);
    const { spacecraft } = data;
    this.reach = farthest(data, motion);
    const side = Math.max(...spacecraft.box_m);
    this.skyRadius = Math.max(0.75 * this.reach, 0.7 * Math.hypot(...spacecraft.box_m));
    this.spacecraft = new SpacecraftModel(spacecraft, this.reach);
    const body = this.spacecraft.group;

    const bodyTriad = triad(0.95 * side, "B", 3);
    const inertialTriad = triad(this.skyRadius, "I", 1.5);
    const sphere = keepOut(spacecraft.keep_out_radius_m ?? 0);
    const lines = graticule(this.skyRadius);
    const center = centerMark(0.06 * this.reach);
    center.position.fromArray(spacecraft.center_of_mass_m);

    this.cones = data.cones.map((cone) => new Cone(cone, this.skyRadius, motion));
    this.trails = BODY_AXES.map((_, i) => this.trail(i));
    this.rays = BODY_AXES.map((axis, i) => {
      const ray = new Group();
      const end = axis.clone().multiplyScalar(this.skyRadius);
      ray.add(segments([new Vector3(), end], { color: AXIS_COLORS[i], width: 2, opacity: 0.9 }));
      return ray;
    });
    const arrow = (name: string) => {
      const made = new Arrow(`momentum-${name}`, 0.006 * this.reach);
      made.group.position.copy(center.position);
      return made;
    };
    this.arrows = { arm: arrow("arm"), base: arrow("base"), wheels: arrow("wheels"), total: arrow("total") };
    this.momentumScale = (0.6 * this.skyRadius) / this.largestMomentum();

    const wheels = wheelAxes(data.wheels, 1.1 * extent(spacecraft));
    const ghosts = this.ghosts();
    const trails = this.trails.map((trail) => trail.group);
    const arrows = ARROWS.map((name) => this.arrows[name].group);
    body.add(bodyTriad, sphere, ...this.rays, ...this.cones.map((cone) => cone.ray), wheels);
    this.sky.add(inertialTriad, lines, ...trails, ...this.cones.map((cone) => cone.group));
    const momentum = new Group();
    momentum.add(...arrows);
    this.space.add(body, this.sky, momentum, center, ...ghosts);
    this.viewport.scene.add(this.space);
    this.layers = {
      boresight: [], momentum: [momentum, center], "keep-out": [sphere], ghosts,
      cones: this.cones.flatMap((cone) => [cone.group, cone.ray]), wheels: [wheels], axes: [bodyTriad, inertialTriad], sky: [lines],
    };
    this.setBoresight(0);
    this.setFrame("inertial");
  }

  /** Shows the plan at a time. */
  show(time: number): void {
    this.time = time;
    const { motion } = this;
    const body = this.spacecraft.group;
    body.position.copy(motion.vector("position_m", time));
    body.quaternion.copy(motion.attitude(time));
    this.sky.position.copy(body.position);
    this.spacecraft.pose(
      motion.vectors("arm_points_m", time), motion.vectors("joint_axes", time), motion.vectors("capsules_m", time));
    const momenta = this.momenta(time);
    for (const name of ARROWS) {
      this.arrows[name].point(momenta[name].multiplyScalar(this.momentumScale));
    }
    const { k, share } = motion.locate(time);
    const past = share === 1 ? k + 1 : k;
    for (const trail of this.trails) trail.upTo(past);
    for (const cone of this.cones) cone.show(k, share, past);
    this.placeSpace();
    this.viewport.requestDraw();
  }

  momenta(time: number): Momenta {
    const { motion, data } = this;
    const attitude = motion.attitude(time);
    const arm = motion.vector("arm_momentum_n_m_s", time).applyQuaternion(attitude);
    const hasWheels = data.wheels.length > 0;
    const wheels = hasWheels ? motion.vector("stored_momentum_n_m_s", time).applyQuaternion(attitude) : new Vector3();
    const total = motion.vector("angular_momentum_n_m_s", time);
    return { arm, base: total.clone().sub(arm).sub(wheels), wheels, total };
  }

  setFrame(frame: FrameName): void {
    this.frame = frame;
    this.show(this.time);
    this.fit();
  }

  /** Looks at everything there is to see in the frame. */
  fit(): void {
    const radius = 1.03 * Math.max(this.reach, this.skyRadius);
    if (this.frame === "body") {
      this.viewport.fit(new Vector3(), radius);
      return;
    }
    const { motion } = this;
    const places = Array.from({ length: motion.nodes }, (_, k) => motion.vectorsAt("position_m", k)[0]);
    const low = places.reduce((least, place) => least.min(place), places[0].clone());
    const high = places.reduce((most, place) => most.max(place), places[0].clone());
    const wandered = low.distanceTo(high) / 2;
    this.viewport.fit(low.add(high).multiplyScalar(0.5), radius + wandered);
  }

  isVisible(layer: Layer): boolean {
    return layer === "boresight"
      ? this.rays[this.boresight].visible
      : this.layers[layer].every((part) => part.visible);
  }

  setVisible(layer: Layer, visible: boolean): void {
    if (layer === "boresight") this.setBoresight(this.boresight, visible);
    for (const part of this.layers[layer]) part.visible = visible;
    this.viewport.requestDraw();
  }

  /** Which body axis leaves a trail. */
  setBoresight(axis: number, visible = true): void {
    this.boresight = axis;
    this.rays.forEach((ray, i) => { ray.visible = visible && i === axis; });
    this.trails.forEach((trail, i) => { trail.group.visible = visible && i === axis; });
    this.viewport.requestDraw();
  }

  /** Where the base and the arm are drawn now, inertial axes: read from the scene itself. */
  drawn(): { position: Vector3; attitude: Quaternion; arm: Vector3[] } {
    const body = this.spacecraft.group;
    return {
      position: body.position.clone(),
      attitude: body.quaternion.clone(),
      arm: this.spacecraft.pointsIn(this.space),
    };
  }

  /** In the body frame, it is the inertial space that turns. */
  private placeSpace(): void {
    const matrix = new Matrix4();
    if (this.frame === "body") {
      const { position, quaternion, scale } = this.spacecraft.group;
      matrix.compose(position, quaternion, scale).invert();
    }
    matrix.decompose(this.space.position, this.space.quaternion, this.space.scale);
    this.space.updateMatrixWorld(true);
  }

  private trail(axis: number): Trail {
    const { motion, data } = this;
    const directions = Array.from({ length: motion.nodes }, (_, k) =>
      BODY_AXES[axis].clone().applyQuaternion(motion.attitudeAt(k)));
    const target = data.target_attitude;
    const goal = target && BODY_AXES[axis].clone().applyQuaternion(fromScalarFirst(target));
    return new Trail(directions, this.skyRadius, goal, AXIS_COLORS[axis]);
  }

  /** The start with its arm; a slew's targets at the places where the base arrives. */
  private ghosts(): Group[] {
    const { motion, data } = this;
    const { spacecraft } = data;
    const start = ghost(spacecraft, motion.vectorsAt("arm_points_m", 0), { color: "ink", width: 1, opacity: 0.35 });
    start.position.copy(motion.vectorsAt("position_m", 0)[0]);
    start.quaternion.copy(motion.attitudeAt(0));
    if (!data.target_attitude) return [start];
    const last = motion.nodes - 1;
    const targets = [...data.waypoints, { node: last, attitude: data.target_attitude }].map(({ node, attitude }) => {
      const target = ghost(spacecraft, motion.vectorsAt("arm_points_m", node), { color: "target", width: 1.25, opacity: 0.75 });
      target.position.copy(motion.vectorsAt("position_m", node)[0]);
      target.quaternion.copy(fromScalarFirst(attitude));
      return target;
    });
    return [start, ...targets];
  }

  /** Whether the system has any momentum, beyond rounding, beside what moves in it. */
  get hasTotalMomentum(): boolean {
    const least = 1e-6 * this.largestMomentum();
    return Array.from(this.motion.time).some((time) => this.momenta(time).total.length() > least);
  }

  private largestMomentum(): number {
    let largest = Number.MIN_VALUE;
    for (const time of this.motion.time) {
      const momenta = this.momenta(time);
      largest = Math.max(largest, ...ARROWS.map((name) => momenta[name].length()));
    }
    return largest;
  }
}

/** Farthest that anything gets from the base's center of mass, m. */
function farthest(data: ReportData, motion: Motion): number {
  let far = extent(data.spacecraft);
  for (let k = 0; k < motion.nodes; k++) {
    for (const point of motion.vectorsAt("arm_points_m", k)) far = Math.max(far, point.length());
  }
  return far;
}
