// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is heard, as numbers; sound.ts plays it.

export const lowestPitch = 196;
export const octaves = 2.5;

/** Hertz for a height between the scene's lowest and highest: equal steps of height are equal intervals. */
export function pitchOf(height: number, lowest: number, highest: number): number {
  const span = highest - lowest;
  const part = span > 0 ? Math.min(1, Math.max(0, (height - lowest) / span)) : 0;
  return lowestPitch * 2 ** (octaves * part);
}

/** -1 (left) to 1 (right) for a place across the scene; never quite at one ear, where it would be lost on some. */
export function panOf(x: number, width: number): number {
  return 0.8 * Math.min(1, Math.max(-1, (2 * x) / width));
}

/** Tells when the probe crosses an edge: the slope grows past one limit, and must fall below the other before the next. */
export class EdgeDetector {
  private steep = false;
  constructor(
    readonly onset = 0.8,
    readonly release = 0.4,
  ) {}

  /** `slope`: steepness under the probe (metres a metre). True once an edge. */
  crossed(slope: number): boolean {
    if (this.steep) {
      this.steep = slope > this.release;
      return false;
    }
    this.steep = slope > this.onset;
    return this.steep;
  }
}

/** True when a condition becomes true, after it was false. */
export class RisingEdge {
  private before = false;
  rises(now: boolean): boolean {
    const rose = now && !this.before;
    this.before = now;
    return rose;
  }
}
