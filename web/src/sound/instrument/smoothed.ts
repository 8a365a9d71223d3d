// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A value that follows its target without a step: each change of it is inaudible as such.

export class Smoothed {
  private value: number;
  private readonly share: number;
  /** `time`: after it, 63 % of a change has been made (s). */
  constructor(
    public target: number,
    time: number,
    sampleRate: number,
  ) {
    this.value = target;
    this.share = 1 - Math.exp(-1 / (time * sampleRate));
  }

  /** The value for the next sample. */
  next(): number {
    this.value += (this.target - this.value) * this.share;
    // Denormal numbers are slow.
    if (Math.abs(this.value) < 1e-12) this.value = 0;
    return this.value;
  }
  /** Takes a value at once: for one that cannot be heard now. */
  jump(value: number): void {
    this.value = this.target = value;
  }
}
