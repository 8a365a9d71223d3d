// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The depth camera of the program, which tells where the head is. None of its pictures comes here.
import type { FromPage, Head } from '../../generated/protocol';
import type { ScreenPoint } from '../depth/frustum';

/** For as long as it is followed. */
export class DepthCamera {
  /** The head from it, and the tilt that it was told of. */
  from: ScreenPoint | null = null;
  private last = -Infinity;

  constructor(
    private readonly send: (message: FromPage) => void,
    private down: number,
  ) {
    this.ask();
  }

  get tilt(): number {
    return this.down;
  }
  ask(): void {
    this.send({ type: 'follow_head', follows: true, down_deg: this.down });
  }
  /** How far it looks down, degrees. */
  tilted(down: number): void {
    if (down === this.down) return;
    this.down = down;
    this.ask();
  }
  stop(): void {
    this.send({ type: 'follow_head', follows: false, down_deg: this.down });
  }
  /** When the picture came, by performance.now(); later than the one before. */
  timeOf({ age_s }: Head): number {
    return (this.last = Math.max(this.last + 0.001, performance.now() - 1000 * age_s));
  }
}
