// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Requests animation frames only while something moves.

export class FrameLoop {
  private pending = false;
  private last: number | null = null;
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
    if (this.pending) return;
    this.pending = true;
    const requested = this.clock();
    this.ask(() => {
      const now = this.clock();
      this.pending = false;
      this.count += 1;
      const passed = this.last === null ? null : now - this.last;
      this.last = now;
      if (this.frame(now, passed, now - requested)) this.request();
      else this.last = null;
    });
  }
}
