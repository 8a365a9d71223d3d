// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand in the air trembles: at rest it must not move the probe, which keys or another page may move then.
import type { Place } from '../../surface';

/** Of the scene's longer side: within this the hand rests. */
const tremor = 0.02;
/** ms after which it rests. */
const patience = 400;

export class PointingRest {
  /** Around which place it has stayed, and since when. */
  private around: Place = { x: NaN, y: NaN };
  private since = -Infinity;

  /** Whether a hand that points at this place moves; `size`: the scene's longer side in metres. */
  moves({ x, y }: Place, size: number, now: number): boolean {
    if (!(Math.hypot(x - this.around.x, y - this.around.y) <= tremor * size)) {
      this.around = { x, y };
      this.since = now;
    }
    return now - this.since < patience;
  }
}
