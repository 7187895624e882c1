/** What the program writes into the page: crates/report/src/page/data.rs, field by field. */
export interface ReportData {
  name: string;
  asked: string;
  description: string | null;
  system: string;
  verdict: { passed: boolean; text: string };
  facts: Fact[];
  limits: Limit[];
  notes: string[];
  checks: string[][];
  made_by: string;
  spacecraft: Spacecraft;
  cones: ConeData[];
  /** Failed ones among them. */
  wheels: WheelData[];
  /** Attitude a slew is to reach, scalar first, body to inertial. */
  target_attitude: [number, number, number, number] | null;
  /** Those on the way to it: attitude, and the node at which it is reached. */
  waypoints: { node: number; attitude: [number, number, number, number] }[];
  bound_deg_s: number | null;
  steps: number;
  /** Every so many nodes of the plan are in the columns, and the last. */
  stride: number;
  columns: Record<ColumnName, string>;
}

/** An instrument and the cone that its boresight keeps out of, or stays in. */
export interface ConeData {
  name: string;
  is_inside: boolean;
  half_angle_rad: number;
  /** Unit vector, body axes. */
  boresight_body: [number, number, number];
  /** The cone's axis at each node, a column of unit vectors; inertial axes. */
  axes: string;
}

/** A reaction wheel. */
export interface WheelData {
  /** Unit vector, body axes. */
  axis: Triple;
  momentum_max_n_m_s: number;
  torque_max_n_m: number;
  failed: boolean;
}

export interface Fact {
  label: string;
  value: string;
  note: string;
}

export interface Limit {
  name: string;
  value: string;
  place: string;
  /** Part of the limit that is used, 0 to 1. */
  share: number;
}

export interface Spacecraft {
  /** Edges of the box drawn for the base, m, and its attitude in the body frame. */
  box_m: [number, number, number];
  box_attitude: [number, number, number, number];
  /** Its center, the base's center of mass, in the body frame. */
  box_center_m: Triple;
  /** Of the sphere that the arm keeps out of, if there is one. */
  keep_out_radius_m: number | null;
  /** Shapes that the arm keeps out of, body axes. */
  keep_out: KeepOut[];
  /** Radii of the arm's capsules, in the order of their column. */
  capsule_radii_m: number[];
  clearance_m: number;
  /** The point of the arm that lies on each joint's axis. */
  joint_points: number[];
  /** The points of the arm that links are drawn between. */
  links: [number, number][];
  /** The points of the arm that are its ends. */
  tips: number[];
  /** Names of the joints; null where a joint goes by its number. */
  joint_names: (string | null)[];
  has_payload: boolean;
  joint_limits: JointLimits[];
  /** The system's, at the start; inertial axes. */
  center_of_mass_m: [number, number, number];
}

/** A sphere is a capsule whose ends are the same. */
export type KeepOut =
  | { capsule: { from_m: Triple; to_m: Triple; radius_m: number } }
  | { box: { center_m: Triple; size_m: Triple } };

export type Triple = [number, number, number];

/** Of a joint that turns deg and its rates, of one that slides m and its. */
export interface JointLimits {
  slides: boolean;
  min: number | null;
  max: number | null;
  rate_max: number;
  acceleration_max: number;
  jerk_max: number | null;
}

/** Columns, node by node, each a little-endian float32 array in base64. */
export type ColumnName =
  | "time_s"
  | "position_m"
  | "attitude"
  | "angular_rate_rad_s"
  | "joint_angles_rad"
  | "joint_rates_rad_s"
  | "joint_accelerations_rad_s2"
  | "joint_jerks_rad_s3"
  | "joint_torques_n_m"
  | "power_w"
  | "attitude_error_rad"
  | "arm_points_m"
  | "joint_axes"
  | "capsules_m"
  | "arm_momentum_n_m_s"
  | "angular_momentum_n_m_s"
  | "stored_momentum_n_m_s"
  | "wheel_momenta_n_m_s"
  | "wheel_torques_n_m"
  | "body_clearance_m"
  | "link_clearance_m";

export function readData(): ReportData {
  const element = document.getElementById("data");
  return JSON.parse(element?.textContent ?? "null") as ReportData;
}

export function decodeColumn(base64: string): Float32Array {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}
