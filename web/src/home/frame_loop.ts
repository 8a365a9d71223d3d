// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Animation frames only while something moves: at rest the page asks for none.

export class FrameLoop {
  private pending = false;
  private last: number | null = null;
  /** Frames so far; the tests read it. */
  count = 0;

  /**
   * `frame`: milliseconds now, since the frame before (null after a rest), and since this frame was requested; true if another
   * one is needed.
   */
  constructor(
    private readonly frame: (now: number, passed: number | null, waited: number) => boolean,
    private readonly ask: (callback: () => void) => void = (callback) => requestAnimationFrame(callback),
    private readonly clock: () => number = () => performance.now(),
  ) {}

  /** Something has changed: draw it in the next frame. */
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
