import type { ReportData } from "./data";

/** What the program writes into the page of several plans: crates/report/src/page/compare.rs, field by field. */
export interface CompareData {
  plans: { name: string; report: ReportData }[];
  /** Rows of the table, its head first: what is compared, then one cell a plan. */
  rows: string[][];
}

export function readPlans(): CompareData {
  return JSON.parse(document.getElementById("data")?.textContent ?? "null") as CompareData;
}
