// The time shown, and its playback at, below or above true speed.
const SPEEDS = [10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 1e-4, 1e-5];
const SECONDS = 6; // approximate duration of playback at the default speed

export class Player {
  playing = false;
  speed: number; // simulated seconds per second of playback; for load factors, load factor per second
  private index = 0;
  private began = { clock: 0, time: 0 };

  constructor(
    readonly times: number[], // ascending
    readonly isTimed: boolean, // false: times are load factors or indices of frames
    private readonly show: (time: number) => Promise<void>,
    private readonly changed: () => void,
  ) {
    const span = this.last - this.first;
    const fitting = SPEEDS.reduce((a, b) => (Math.abs(Math.log((span / b) / SECONDS)) < Math.abs(Math.log((span / a) / SECONDS)) ? b : a));
    this.speed = isTimed && span > 0 ? fitting : span / SECONDS || 1;
  }

  get first(): number {
    return this.times[0] ?? 0;
  }
  get last(): number {
    return this.times[this.times.length - 1] ?? 0;
  }
  get time(): number {
    return this.times[this.index] ?? 0;
  }
  get frame(): number {
    return this.index;
  }
  static speeds(): number[] {
    return SPEEDS;
  }

  toggle(): void {
    this.playing = !this.playing;
    if (this.playing && this.index === this.times.length - 1) this.index = 0;
    this.startClock();
    this.changed();
    if (this.playing) requestAnimationFrame(() => void this.advance());
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.startClock();
  }

  async goTo(index: number): Promise<void> {
    this.index = Math.min(Math.max(index, 0), this.times.length - 1);
    this.startClock();
    this.changed();
    await this.show(this.time);
  }

  // Shows the frame nearest to `time`.
  async goToTime(time: number): Promise<void> {
    let best = 0;
    this.times.forEach((t, k) => {
      if (Math.abs(t - time) < Math.abs((this.times[best] as number) - time)) best = k;
    });
    await this.goTo(best);
  }

  private startClock(): void {
    this.began = { clock: performance.now(), time: this.time };
  }

  private async advance(): Promise<void> {
    if (!this.playing) return;
    const time = this.began.time + ((performance.now() - this.began.clock) / 1000) * this.speed;
    let next = this.index;
    while (next + 1 < this.times.length && (this.times[next + 1] as number) <= time) ++next;
    if (next !== this.index) {
      this.index = next;
      this.changed();
      await this.show(this.time);
    }
    if (this.index === this.times.length - 1) {
      if (time < this.last + 0.7 * this.speed) requestAnimationFrame(() => void this.advance()); // pause at the end
      else await this.again();
      return;
    }
    requestAnimationFrame(() => void this.advance());
  }

  private async again(): Promise<void> {
    await this.goTo(0);
    requestAnimationFrame(() => void this.advance());
  }
}
