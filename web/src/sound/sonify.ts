// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sonification as numbers; sound.ts plays it.

export const lowestPitch = 196;
export const octaves = 2.5;

/** Hertz for a height between the scene's lowest and highest: equal steps of height are equal intervals. */
export function pitchOf(height: number, lowest: number, highest: number): number {
  const span = highest - lowest;
  const part = span > 0 ? Math.min(1, Math.max(0, (height - lowest) / span)) : 0;
  return lowestPitch * 2 ** (octaves * part);
}

/** Stereo pan, -1 (left) to 1 (right), for a place across the scene; never fully on one side, for people who hear with one ear. */
export function panOf(x: number, width: number): number {
  return 0.8 * Math.min(1, Math.max(-1, (2 * x) / width));
}

/** Detects edges with hysteresis: the slope exceeds one limit, and must fall below another before the next edge. */
export class EdgeDetector {
  private steep = false;
  constructor(
    readonly onset = 0.8,
    readonly release = 0.4,
  ) {}

  /** `slope`: steepness under the probe. True once per edge. */
  crossed(slope: number): boolean {
    if (this.steep) {
      this.steep = slope > this.release;
      return false;
    }
    this.steep = slope > this.onset;
    return this.steep;
  }
}

/** True when a condition changes from false to true. */
export class RisingEdge {
  private before = false;
  rises(now: boolean): boolean {
    const rose = now && !this.before;
    this.before = now;
    return rose;
  }
}
