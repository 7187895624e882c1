import { byId } from "./element";
import { clock, short } from "./format";
import { locate } from "./motion";
import type { Player } from "./player";

/** Play, scrub, step and speed: buttons and keys. */
export class Transport {
  private readonly button = byId("play");
  private readonly slider = byId<HTMLInputElement>("time");
  private readonly speed = byId<HTMLSelectElement>("speed");

  /** Steps go from one of `times` to the next. */
  constructor(private readonly player: Player, private readonly times: ArrayLike<number>) {
    this.slider.max = String(player.duration);
    this.slider.step = "any";
    byId("duration").textContent = ` / ${clock(player.duration, player.duration)} s`;
    for (const speed of player.speeds) this.offer(speed);
    this.button.addEventListener("click", () => player.toggle());
    this.slider.addEventListener("input", () => {
      const wanted = Number(this.slider.value);
      player.pause();
      player.seek(wanted);
    });
    this.speed.addEventListener("change", () => player.setSpeed(Number(this.speed.value)));
    byId("back").addEventListener("click", () => this.step(-1));
    byId("forward").addEventListener("click", () => this.step(1));
    document.addEventListener("keydown", (event) => this.onKey(event));
  }

  show(): void {
    const { time, playing, duration, speed } = this.player;
    this.slider.value = String(time);
    this.slider.style.setProperty("--share", `${(100 * time) / duration}%`);
    this.slider.setAttribute("aria-valuetext", `${clock(time, duration)} seconds`);
    byId("now").textContent = clock(time, duration);
    this.button.classList.toggle("playing", playing);
    this.button.setAttribute("aria-label", playing ? "Pause" : "Play");
    if (this.speed.value !== String(speed)) {
      if (![...this.speed.options].some((option) => option.value === String(speed))) this.offer(speed);
      this.speed.value = String(speed);
    }
  }

  private offer(speed: number): void {
    this.speed.add(new Option(`${short(speed, 2).replace(/\.0$/, "")}×`, String(speed)));
  }

  /** To the next node, or the one before. */
  private step(nodes: number): void {
    const { times } = this;
    this.player.pause();
    const { k, share } = locate(times, this.player.time);
    const here = share === 1 ? k + 1 : k;
    const target = nodes < 0 && share > 0 && share < 1 ? here : here + nodes;
    this.player.seek(times[Math.min(Math.max(target, 0), times.length - 1)]);
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const isControl = ["SELECT", "BUTTON", "SUMMARY"].includes(target.tagName);
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => this.step(event.shiftKey ? 10 : 1),
      Home: () => this.player.seek(0),
      End: () => this.player.seek(this.player.duration),
      ...(isControl ? {} : { " ": () => this.player.toggle() }),
    };
    const action = target.tagName === "SELECT" ? undefined : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}
