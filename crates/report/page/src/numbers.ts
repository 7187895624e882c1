import type { ReportData } from "./data";
import { byId, element } from "./element";

/** What does not move: the verdict and the numbers behind it. */
export function fillNumbers(data: ReportData): void {
  const verdict = byId("verdict");
  verdict.textContent = data.verdict.passed ? "Verified" : "Not verified";
  verdict.classList.toggle("failed", !data.verdict.passed);
  verdict.title = data.verdict.text;
  byId("name").textContent = data.name;
  byId("asked").textContent = `${data.system}: ${data.asked}`;
  byId("verdict-text").textContent = data.verdict.text;
  byId("description").textContent = data.description ?? "";
  byId("made-by").textContent = data.made_by
    + (data.stride > 1 ? ` Shown is every ${data.stride}th of ${data.steps + 1} nodes.` : "");

  for (const { label, value, note } of data.facts) {
    const fact = element("div", "fact");
    fact.append(element("dt", "", label), element("dd", "", value), element("small", "", note));
    byId("facts").append(fact);
  }
  for (const text of data.notes) byId("notes").append(element("li", "", text));
  for (const { name, value, place, share } of data.limits) {
    const row = element("div", "limit-row");
    const bar = element("span", "bar");
    const used = element("i");
    used.style.width = `${100 * Math.min(Math.max(share, 0), 1)}%`;
    bar.append(used);
    row.append(element("span", "", name), bar, element("b", "", value), element("small", "", place));
    byId("limits").append(row);
  }
  const [head, ...rows] = data.checks;
  byId("checks").append(...(head ? [row("th", head)] : []), ...rows.map((cells) => row("td", cells)));
}

function row(kind: "th" | "td", cells: string[]): HTMLElement {
  const made = element("tr", cells[0] === "FAILED" ? "failed" : "");
  made.append(...cells.map((cell) => element(kind, "", cell)));
  return made;
}
