import { Quaternion, Vector3 } from "three";
import { decodeColumn, type ColumnName, type ReportData } from "./data";

/** An interval between times, and how far into it, 0 to 1. */
export interface Place {
  k: number;
  share: number;
}

/** The interval of ascending `times` that holds a time. */
export function locate(times: ArrayLike<number>, time: number): Place {
  let [low, high] = [0, times.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  const share = (time - times[low]) / (times[high] - times[low]);
  return { k: low, share: Math.min(Math.max(share, 0), 1) };
}

/** The plan as a function of time: exact at its nodes, in between on the straight way. */
export class Motion {
  readonly time: Float32Array;
  readonly joints: number;
  private readonly columns: Record<ColumnName, Float32Array>;

  constructor(data: ReportData) {
    const entries = Object.entries(data.columns).map(([name, text]) => [name, decodeColumn(text)]);
    this.columns = Object.fromEntries(entries) as Record<ColumnName, Float32Array>;
    this.time = this.columns.time_s;
    this.joints = data.spacecraft.joint_points.length;
  }

  get nodes(): number {
    return this.time.length;
  }

  get duration(): number {
    return this.time[this.nodes - 1];
  }

  /** One component of a column over all nodes. */
  component(name: ColumnName, index = 0): Float32Array {
    const width = this.width(name);
    const column = this.columns[name];
    return Float32Array.from({ length: width ? this.nodes : 0 }, (_, k) => column[k * width + index]);
  }

  /** Numbers of a column at each node; 0 where the plan has none. */
  width(name: ColumnName): number {
    return this.columns[name].length / this.nodes;
  }

  /** Whether accelerations are linear between nodes, by jerks, rather than held. */
  get hasJerks(): boolean {
    return this.width("joint_jerks_rad_s3") > 0;
  }

  /** The interval that holds a time, and how far into it the time is, 0 to 1. */
  locate(time: number): Place {
    return locate(this.time, time);
  }

  /** All numbers of a column at a time. */
  sample(name: ColumnName, time: number): number[] {
    const width = this.width(name);
    const column = this.columns[name];
    const { k, share } = this.locate(time);
    return Array.from({ length: width }, (_, i) => {
      const [a, b] = [column[k * width + i], column[(k + 1) * width + i]];
      return share === 0 ? a : share === 1 ? b : a + share * (b - a);
    });
  }

  /** What is held over an interval, such as the control. */
  held(name: ColumnName, time: number): number[] {
    const width = this.width(name);
    const { k, share } = this.locate(time);
    const row = Math.min(share === 1 ? k + 1 : k, this.nodes - 2);
    return Array.from(this.columns[name].subarray(row * width, (row + 1) * width));
  }

  vector(name: ColumnName, time: number): Vector3 {
    return new Vector3().fromArray(this.sample(name, time));
  }

  /** Body to inertial. */
  attitude(time: number): Quaternion {
    const { k, share } = this.locate(time);
    return this.attitudeAt(k).slerp(this.attitudeAt(k + 1), share);
  }

  attitudeAt(k: number): Quaternion {
    return fromScalarFirst(this.columns.attitude.subarray(4 * k, 4 * k + 4));
  }

  /** Points of a column of vectors at node k. */
  vectorsAt(name: ColumnName, k: number): Vector3[] {
    const width = this.width(name);
    return toVectors(Array.from(this.columns[name].subarray(k * width, (k + 1) * width)));
  }

  /** Points of a column of vectors at a time. */
  vectors(name: ColumnName, time: number): Vector3[] {
    return toVectors(this.sample(name, time));
  }
}

/** three.js keeps the scalar part last. */
export function fromScalarFirst(wxyz: ArrayLike<number>): Quaternion {
  return new Quaternion(wxyz[1], wxyz[2], wxyz[3], wxyz[0]).normalize();
}

function toVectors(flat: number[]): Vector3[] {
  return Array.from({ length: flat.length / 3 }, (_, i) => new Vector3().fromArray(flat, 3 * i));
}
