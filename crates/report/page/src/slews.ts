import "./slews.css";
import { byId, element } from "./element";
import { short } from "./format";
import { SlewCloud, type Coloring } from "./slew-cloud";
import { readSlews } from "./slew-data";
import { SlewFilters } from "./slew-filters";
import { VIEWS, type ViewName } from "./viewport";

const data = readSlews();
let selected: number | null = null;
byId("name").textContent = data.name;
byId("asked").textContent = data.subtitle;
fillScale();
const cloud = openCloud();

function openCloud(): SlewCloud | null {
  try {
    return new SlewCloud(byId("view"), data);
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    byId("view").replaceChildren(
      element("p", "no-view", `No 3D view: ${message} slews.svg and results.csv show the same slews.`),
    );
    return null;
  }
}

function fillScale(): void {
  byId("ramp").style.background = `linear-gradient(to right, ${data.ramp.join(", ")})`;
  for (const { share, label } of data.objective.ticks) {
    const tick = element("span", "", label);
    tick.style.left = `${100 * share}%`;
    byId("ticks").append(tick);
  }
}

function setColoring(coloring: Coloring): void {
  cloud?.color(coloring);
  byId("scale").hidden = coloring !== "objective";
  byId("succeeded").hidden = coloring !== "outcome";
  for (const name of ["outcome", "objective"]) {
    byId(`color-${name}`).setAttribute("aria-pressed", String(name === coloring));
  }
}

/** Says everything about a point, or nothing. */
function select(cloud: SlewCloud, index: number | null): void {
  if (index === selected) return;
  selected = index;
  cloud.select(index);
  byId("card").hidden = index === null;
  if (index === null) return;
  const slew = data.points[index];
  const others = cloud.othersAt(index);
  const facts = [
    ["case_id", slew.case_id],
    ["axis", slew.axis.map((part) => short(part, 3)).join("  ")],
    ["angle", `${Number(slew.angle_deg.toPrecision(6))}°`],
    ...data.columns.map((name, i) => [name, slew.settings[i]]),
    ["status", `${slew.status}, ${slew.succeeded ? "verified" : "failed"}`],
    ["attitude error", slew.attitude_error_deg === null ? "none" : `${short(slew.attitude_error_deg, 3)}°`],
    ["objective", slew.objective === null ? "none" : slew.objective.toExponential(3)],
    ...(others > 0 ? [["same slew", `${others} more, other settings`]] : []),
  ];
  byId("facts").replaceChildren(
    ...facts.flatMap(([name, value]) => [element("dt", "", name), element("dd", "", value)]),
  );
  const link = byId<HTMLAnchorElement>("plan");
  link.hidden = slew.plan_page === null;
  if (slew.plan_page !== null) link.href = slew.plan_page;
}

function connect(cloud: SlewCloud): void {
  for (const view of Object.keys(VIEWS) as ViewName[]) {
    byId(`view-${view}`).addEventListener("click", () => cloud.viewport.look(view));
  }
  const view = byId("view");
  let pressed = [0, 0];
  view.addEventListener("pointerdown", ({ clientX, clientY }) => { pressed = [clientX, clientY]; });
  view.addEventListener("pointermove", (event) => {
    if (event.pointerType !== "mouse" || event.buttons !== 0) return;
    // Leaving a point does not hide what it said: a click beside it does.
    const index = cloud.pick(event.clientX, event.clientY, "mouse");
    if (index !== null) select(cloud, index);
  });
  view.addEventListener("pointerup", ({ clientX, clientY, pointerType }) => {
    if (Math.hypot(clientX - pressed[0], clientY - pressed[1]) > 6) return;
    select(cloud, cloud.pick(clientX, clientY, pointerType === "mouse" ? "mouse" : "touch"));
  });
}

/** For the console and for tests: the page by program. */
const slews = {
  data,
  /** Shows only the slews with a setting; all again with "". */
  filter: (column: number, setting: string) => filters.choose(column, setting),
  setColoring,
  /** Where a point is in the window, CSS pixels. */
  place: (index: number) => cloud?.placeOf(index).slice(0, 2) ?? null,
  state: () => ({ drawn: cloud?.viewport.drawnPoints() ?? null, selected }),
};
declare global {
  interface Window { slews: typeof slews }
}
window.slews = slews;

for (const coloring of ["outcome", "objective"] as const) {
  byId(`color-${coloring}`).addEventListener("click", () => setColoring(coloring));
}
if (cloud) connect(cloud);
const filters = new SlewFilters(byId("filters"), data, (isShown) => {
  if (selected !== null && !isShown(selected) && cloud) select(cloud, null);
  cloud?.filter(isShown);
});
