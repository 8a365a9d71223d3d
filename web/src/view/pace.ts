// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Notices when drawing is too slow to follow the probe.

const slow = 45;
const patience = 12;

export class Pace {
  private last: number | null = null;
  private slowFrames = 0;

  /** A frame was drawn at `now` (ms); true if too many in a row came late. */
  drawn(now: number): boolean {
    const late = this.last !== null && now - this.last > slow;
    this.last = now;
    this.slowFrames = late ? this.slowFrames + 1 : 0;
    if (this.slowFrames < patience) return false;
    this.slowFrames = 0;
    return true;
  }

  /** Nothing had to be drawn: the time until the next frame says nothing. */
  rested(): void {
    this.last = null;
  }
}
