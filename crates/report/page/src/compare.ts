import "./compare.css";
import { readPlans } from "./compare-data";
import { allTimes, comparePanels, type ComparedPlan } from "./compare-panels";
import { byId, element } from "./element";
import { Motion } from "./motion";
import { Player } from "./player";
import { Plots } from "./plots";
import { Stage, type FrameName, type Layer } from "./stage";
import { jointColor, onThemeChange } from "./theme";
import { Transport } from "./transport";
import { VIEWS, type ViewName } from "./viewport";

/** What a small scene has no room for. */
const HIDDEN: Layer[] = ["momentum", "axes", "keep-out"];

const data = readPlans();
const plans: ComparedPlan[] = data.plans.map(({ name, report }) => ({ name, motion: new Motion(report) }));
const player = new Player(Math.max(...plans.map(({ motion }) => motion.duration)));
const times = allTimes(plans);
const names = plans.map(({ name }) => name).join(", ");
document.title = names;
byId("name").textContent = names;
fillTable();
const plots = new Plots(byId("plots"), comparePanels(plans, times), times, player);
const transport = new Transport(player, times);
const stages = data.plans.map((_, i) => openStage(i));

function fillTable(): void {
  byId("table").append(...data.rows.map((cells, i) => {
    const row = element("tr");
    row.append(...cells.map((cell) => element(i === 0 ? "th" : "td", "", cell)));
    return row;
  }));
}

function openStage(i: number): Stage | null {
  const { name, report } = data.plans[i];
  const scene = element("figure", "scene");
  const caption = element("figcaption");
  const swatch = element("i");
  const paint = () => swatch.style.setProperty("--swatch", jointColor(i));
  paint();
  onThemeChange(paint);
  caption.append(swatch, element("b", "", name), element("span", "", `${report.system}: ${report.asked}`));
  const view = element("div", "scene-view");
  scene.append(view, caption);
  byId("scenes").append(scene);
  try {
    const stage = new Stage(view, report, plans[i].motion);
    for (const layer of HIDDEN) stage.setVisible(layer, false);
    return stage;
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    view.replaceChildren(element("p", "no-view", `No 3D view: ${message} The table and the plots work all the same.`));
    return null;
  }
}

function forEachStage(act: (stage: Stage) => void): void {
  for (const stage of stages) if (stage) act(stage);
}

function show(): void {
  transport.show();
  plots.show(player.time);
  forEachStage((stage) => stage.show(player.time));
}

function setFrame(frame: FrameName): void {
  forEachStage((stage) => stage.setFrame(frame));
  for (const name of ["inertial", "body"]) {
    byId(`frame-${name}`).setAttribute("aria-pressed", String(name === frame));
  }
}

/** Turning one scene turns all. */
function turnTogether(): void {
  let turning = false;
  forEachStage((turned) => turned.viewport.onTurn(() => {
    if (turning) return;
    turning = true;
    forEachStage((stage) => { if (stage !== turned) stage.viewport.lookAs(turned.viewport); });
    turning = false;
  }));
}

/** For the console and for tests: the page by program. */
const compare = {
  data,
  seek: (time: number) => { player.pause(); player.seek(time); },
  setFrame,
  state: () => ({
    time_s: player.time,
    duration_s: player.duration,
    plans: stages.map((stage, i) => {
      const drawn = stage?.drawn();
      return {
        name: plans[i].name,
        attitude_wxyz: drawn ? [drawn.attitude.w, drawn.attitude.x, drawn.attitude.y, drawn.attitude.z] : null,
        camera: stage?.viewport.direction().toArray() ?? null,
      };
    }),
  }),
};
declare global {
  interface Window { compare: typeof compare }
}
window.compare = compare;

for (const frame of ["inertial", "body"] as const) {
  byId(`frame-${frame}`).addEventListener("click", () => setFrame(frame));
}
for (const view of Object.keys(VIEWS) as ViewName[]) {
  byId(`view-${view}`).addEventListener("click", () => forEachStage((stage) => stage.viewport.look(view)));
}
turnTogether();
player.onChange(show);
show();
