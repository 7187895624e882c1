import { byId } from "./element";
import type { Player } from "./player";
import type { Stage } from "./stage";

const FRAMES_PER_SECOND = 30;
/** How long a video shows the end, ms. */
const END_MS = 500;

/** What the page gives to take along: the link to what it shows, a picture of the scene, the maneuver as a video. */
export class Tools {
  private recorder: MediaRecorder | null = null;

  /** `name` begins the names of files. */
  constructor(private readonly stage: Stage | null, private readonly player: Player, private readonly name: string) {
    const help = byId<HTMLDialogElement>("help");
    byId("open-help").addEventListener("click", () => help.showModal());
    document.addEventListener("keydown", ({ key }) => { if (key === "?" && !help.open) help.showModal(); });
    byId("copy-link").addEventListener("click", () => void this.copyLink());
    byId("save-png").addEventListener("click", () => void this.savePicture());
    byId("save-webm").addEventListener("click", () => void this.saveVideo());
    byId("save-png").hidden = stage === null;
    byId("save-webm").hidden = stage === null || !("MediaRecorder" in window);
  }

  /** The address that opens the page at this time, in this frame, from this side. */
  link(): string {
    const wanted = new URLSearchParams({ t: this.player.time.toFixed(3) });
    if (this.stage) {
      wanted.set("frame", this.stage.frame);
      wanted.set("from", this.stage.viewport.direction().toArray().map((part) => part.toFixed(3)).join(","));
    }
    return `${location.href.split("#")[0]}#${wanted.toString().replaceAll("%2C", ",")}`;
  }

  /** The scene as it is drawn, a PNG. */
  async picture(): Promise<Blob | null> {
    return this.stage?.viewport.picture() ?? null;
  }

  /** The maneuver from its start to its end at the player's speed, a WebM; asked again it ends there. */
  async video(): Promise<Blob | null> {
    if (!this.stage || this.recorder) {
      this.recorder?.stop();
      return null;
    }
    const recorder = new MediaRecorder(this.stage.viewport.stream(FRAMES_PER_SECOND), { mimeType: "video/webm" });
    const parts: Blob[] = [];
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    const [started, ended] = ["start", "stop"].map(
      (name) => new Promise((done) => recorder.addEventListener(name, done)));
    this.recorder = recorder;
    this.player.pause();
    this.player.seek(0);
    recorder.start();
    await started;
    this.player.onEnd(() => setTimeout(() => { if (recorder.state !== "inactive") recorder.stop(); }, END_MS));
    this.player.play();
    await ended;
    this.player.pause();
    this.recorder = null;
    return new Blob(parts, { type: "video/webm" });
  }

  private async copyLink(): Promise<void> {
    const link = this.link();
    history.replaceState(null, "", link);
    // Where there is no clipboard, the address of the page is the link now.
    await navigator.clipboard?.writeText(link).catch(() => undefined);
    this.say("copy-link", "Copied");
  }

  private async savePicture(): Promise<void> {
    save(await this.picture(), `${this.name}.png`);
  }

  private async saveVideo(): Promise<void> {
    const button = byId("save-webm");
    const label = button.textContent ?? "";
    button.textContent = "Stop";
    const video = await this.video();
    if (video) button.textContent = label;
    save(video, `${this.name}.webm`);
  }

  /** A word on a button, for a moment. */
  private say(id: string, word: string): void {
    const button = byId(id);
    const label = button.dataset["label"] ?? button.textContent ?? "";
    button.dataset["label"] = label;
    button.textContent = word;
    setTimeout(() => { button.textContent = label; }, 1500);
  }
}

function save(blob: Blob | null, name: string): void {
  if (!blob) return;
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
