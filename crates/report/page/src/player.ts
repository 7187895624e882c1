/** How long the whole plan takes to watch at the speed that the page opens with, s. */
const WATCHED_S = 15;

/** 1, 2 or 5 times a power of ten, real time at least. */
function roundSpeed(wanted: number): number {
  const decade = 10 ** Math.max(0, Math.floor(Math.log10(wanted)));
  const [first, second] = [3.2, 1.5].map((least) => wanted >= least * decade);
  return decade * (wanted >= 7.5 * decade ? 10 : first ? 5 : second ? 2 : 1);
}

/** The clock of the page: one time, whoever sets it, and everyone who shows it. */
export class Player {
  time = 0;
  speed: number;
  private playingSince: number | null = null;
  private readonly listeners: (() => void)[] = [];
  private atEnd: (() => void) | null = null;

  /** Speeds to choose from, times real time. */
  readonly speeds: number[];

  constructor(readonly duration: number) {
    const usual = roundSpeed(duration / WATCHED_S);
    const around = [0.1, 0.25, 0.5, 1, 2, 5].map((factor) => +(usual * factor).toPrecision(2));
    this.speeds = [...new Set([1, ...around])].sort((a, b) => a - b);
    this.speed = usual;
  }

  get playing(): boolean {
    return this.playingSince !== null;
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Calls once, when playing has come to the end. */
  onEnd(listener: () => void): void {
    this.atEnd = listener;
  }

  seek(time: number): void {
    this.time = Number.isFinite(time) ? Math.min(Math.max(time, 0), this.duration) : 0;
    this.tell();
  }

  setSpeed(speed: number): void {
    if (speed > 0 && Number.isFinite(speed)) this.speed = speed;
    this.tell();
  }

  /** Plays on; from the start, if at the end. */
  play(): void {
    if (this.playing) return;
    if (this.time >= this.duration) this.time = 0;
    this.playingSince = performance.now();
    requestAnimationFrame(this.advance);
    this.tell();
  }

  pause(): void {
    this.playingSince = null;
    this.tell();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  private readonly advance = (now: number): void => {
    if (this.playingSince === null) return;
    const elapsed = Math.max(0, now - this.playingSince) / 1000;
    this.playingSince = now;
    this.time = Math.min(this.time + elapsed * this.speed, this.duration);
    if (this.time >= this.duration) this.playingSince = null;
    else requestAnimationFrame(this.advance);
    this.tell();
    if (this.playing) return;
    this.atEnd?.();
    this.atEnd = null;
  };

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
