// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Notices when drawing is too slow to follow the probe: how long each frame waits for the frames before it.

/** Milliseconds that a frame may wait: more is late; on average more than the second is hopeless. */
const late = 45;
const hopeless = 120;
const patience = 8;

export type Speed = 'fine' | 'slow' | 'too slow';

export class Pace {
  private waits: number[] = [];

  /** A frame was drawn that had waited so long (ms): slow or too slow once many in a row were late. */
  drawn(waited: number): Speed {
    this.waits = waited > late ? [...this.waits, waited] : [];
    if (this.waits.length < patience) return 'fine';
    const mean = this.waits.reduce((sum, wait) => sum + wait, 0) / this.waits.length;
    this.waits = [];
    return mean > hopeless ? 'too slow' : 'slow';
  }
}
