/** What the program writes into the page of a sweep: crates/report/src/page/slews.rs, field by field. */
export interface SlewsData {
  name: string;
  subtitle: string;
  /** Names of what varies beside axis and angle. */
  columns: string[];
  points: SlewPoint[];
  /** Colours from the least objective to the largest, evenly over its logarithm. */
  ramp: string[];
  /** Decimal logarithms. */
  objective: { low: number; high: number; ticks: { share: number; label: string }[] };
}

export interface SlewPoint {
  case_id: string;
  /** One a column, as tables show them. */
  settings: string[];
  /** Unit vector, body axes. */
  axis: [number, number, number];
  angle_deg: number;
  status: string;
  succeeded: boolean;
  attitude_error_deg: number | null;
  objective: number | null;
  /** The page of its plan, relative to this one, where it is kept. */
  plan_page: string | null;
}

export function readSlews(): SlewsData {
  return JSON.parse(document.getElementById("data")?.textContent ?? "null") as SlewsData;
}
