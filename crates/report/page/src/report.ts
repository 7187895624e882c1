import "./report.css";
import { Vector3 } from "three";
import { readData } from "./data";
import { byId, element } from "./element";
import { short } from "./format";
import { Motion } from "./motion";
import { fillNumbers } from "./numbers";
import { Player } from "./player";
import { Plots } from "./plots";
import { panels } from "./report-panels";
import { LAYERS, Stage, type FrameName } from "./stage";
import { Tools } from "./tools";
import { Transport } from "./transport";
import { VIEWS, type ViewName } from "./viewport";

const data = readData();
const motion = new Motion(data);
const player = new Player(motion.duration);
fillNumbers(data);
const plots = new Plots(byId("plots"), panels(data, motion), motion.time, player);
const transport = new Transport(player, motion.time);
const stage = openStage();
const tools = new Tools(stage, player, data.name);

function openStage(): Stage | null {
  try {
    return new Stage(byId("view"), data, motion);
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    byId("view").replaceChildren(
      element("p", "no-view", `No 3D view: ${message} The numbers and the plots work all the same.`),
    );
    return null;
  }
}

function show(): void {
  transport.show();
  plots.show(player.time);
  stage?.show(player.time);
  if (stage) showMomenta(stage);
}

function showMomenta(stage: Stage): void {
  for (const [name, vector] of Object.entries(stage.momenta(player.time))) {
    byId(`momentum-${name}`).textContent = short(vector.length(), 3);
  }
}

function connectStage(stage: Stage): void {
  for (const frame of ["inertial", "body"] as const) {
    byId(`frame-${frame}`).addEventListener("click", () => setFrame(frame));
  }
  for (const view of Object.keys(VIEWS) as ViewName[]) {
    byId(`view-${view}`).addEventListener("click", () => stage.viewport.look(view));
  }
  for (const layer of LAYERS) {
    const box = byId<HTMLInputElement>(`show-${layer}`);
    stage.setVisible(layer, box.checked);
    box.addEventListener("change", () => stage.setVisible(layer, box.checked));
  }
  const boresight = byId<HTMLSelectElement>("boresight");
  boresight.addEventListener("change", () => {
    byId<HTMLInputElement>("show-boresight").checked = true;
    stage.setBoresight(Number(boresight.value));
  });
  byId("keep-out").hidden = data.spacecraft.keep_out_radius_m === null;
  byId("target").hidden = data.target_attitude === null;
  byId("cones").hidden = data.cones.length === 0;
  byId("wheels").hidden = byId("wheels-row").hidden = data.wheels.length === 0;
  byId("total-row").hidden = !stage.hasTotalMomentum;
}

/** On a narrow page the legend would cover the scene. */
function foldLegend(): void {
  if (matchMedia("(max-width: 860px)").matches) byId("legend").removeAttribute("open");
}

function setFrame(frame: FrameName): void {
  stage?.setFrame(frame);
  for (const name of ["inertial", "body"]) {
    byId(`frame-${name}`).setAttribute("aria-pressed", String(name === frame));
  }
}

/** `report.html#t=12.5&frame=body&view=x` opens at that time, in that frame, from that side; `from` is a direction. */
function readAddress(): void {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const [frame, view, from, time] = ["frame", "view", "from", "t"].map((name) => wanted.get(name));
  if (frame === "inertial" || frame === "body") setFrame(frame);
  if (view && view in VIEWS) stage?.viewport.look(view as ViewName);
  if (from) stage?.viewport.lookFrom(new Vector3().fromArray(from.split(",").map(Number)));
  if (time) player.seek(Number(time));
}

/** For the console and for tests: the page by program. Angles in radians, SI units. */
const righting = {
  data,
  seek: (time: number) => { player.pause(); player.seek(time); },
  play: () => player.play(),
  pause: () => player.pause(),
  setSpeed: (speed: number) => player.setSpeed(speed),
  setFrame,
  link: () => tools.link(),
  picture: () => tools.picture(),
  video: () => tools.video(),
  /** Time, what is drawn there, and what the plan's columns say. */
  state: () => {
    const drawn = stage?.drawn();
    return {
      time_s: player.time,
      duration_s: player.duration,
      playing: player.playing,
      speed: player.speed,
      frame: stage?.frame ?? null,
      from: stage?.viewport.direction().toArray() ?? null,
      drawn: drawn ? {
        position_m: drawn.position.toArray(),
        attitude_wxyz: [drawn.attitude.w, drawn.attitude.x, drawn.attitude.y, drawn.attitude.z],
        arm_m: drawn.arm.map((point) => point.toArray()),
      } : null,
      angular_rate_rad_s: motion.sample("angular_rate_rad_s", player.time),
      joint_angles_rad: motion.sample("joint_angles_rad", player.time),
      joint_rates_rad_s: motion.sample("joint_rates_rad_s", player.time),
      joint_accelerations_rad_s2: motion.hasJerks
        ? motion.sample("joint_accelerations_rad_s2", player.time)
        : motion.held("joint_accelerations_rad_s2", player.time),
      power_w: motion.sample("power_w", player.time)[0],
    };
  },
};
declare global {
  interface Window { righting: typeof righting }
}
window.righting = righting;

foldLegend();
if (stage) connectStage(stage);
player.onChange(show);
readAddress();
addEventListener("hashchange", readAddress);
show();
