// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Requests animation frames only while something moves; a headset brings its own frames.

export class FrameLoop {
  private pending = false;
  private last: number | null = null;
  /** Counts the frames that were requested: one that comes after a change of the clock is none. */
  private turn = 0;
  private isDriven = false;
  /** Number of frames so far, for tests. */
  count = 0;

  /**
   * `frame` gets the time in ms, the time since the previous frame (null after a rest), and the time since
   * this frame was requested. It returns true if another frame is needed.
   */
  constructor(
    private readonly frame: (now: number, passed: number | null, waited: number) => boolean,
    private readonly ask: (callback: () => void) => void = (callback) => requestAnimationFrame(callback),
    private readonly clock: () => number = () => performance.now(),
  ) {}

  /** Requests a frame after a change. */
  request(): void {
    if (this.pending || this.isDriven) return;
    this.pending = true;
    const requested = this.clock();
    const turn = this.turn;
    this.ask(() => {
      if (turn === this.turn) this.run(requested);
    });
  }

  /** Whether a headset calls tick() for each of its frames, so that none is requested from the window. */
  drive(driven: boolean): void {
    if (driven === this.isDriven) return;
    this.isDriven = driven;
    this.turn += 1;
    this.pending = false;
    this.request();
  }

  tick(): void {
    this.run(this.clock());
  }

  private run(requested: number): void {
    const now = this.clock();
    this.pending = false;
    this.count += 1;
    const passed = this.last === null ? null : now - this.last;
    this.last = now;
    if (this.frame(now, passed, now - requested)) this.request();
    else this.last = null;
  }
}
