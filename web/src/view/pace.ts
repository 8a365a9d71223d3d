// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Detects when drawing is too slow to follow the probe, by the waiting time of each frame.

/** Limits of the waiting time (ms): above `late` a frame is late; a mean above `hopeless` is too slow. */
const late = 45;
const hopeless = 120;
const patience = 8;

export type Speed = 'fine' | 'slow' | 'too slow';

export class Pace {
  private waits: number[] = [];

  /** Records a frame's waiting time (ms); the result is slow or too slow after several late frames in a row. */
  drawn(waited: number): Speed {
    this.waits = waited > late ? [...this.waits, waited] : [];
    if (this.waits.length < patience) return 'fine';
    const mean = this.waits.reduce((sum, wait) => sum + wait, 0) / this.waits.length;
    this.waits = [];
    return mean > hopeless ? 'too slow' : 'slow';
  }
}
