// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The head's path for the view: smoothed, with a gain on each axis, and led back to the middle when the head is lost.
import type { ScreenPoint } from '../depth/frustum';
import { restingHead } from '../depth/head';
import { HeadSmoother } from './smooth';

/** A head that was in no picture for so long is lost; the view glides for so long from one source to the other (milliseconds). */
export const lostAfter = 500;
export const glide = 1000;

const axes = ['x', 'y', 'z'] as const;

export class HeadPath {
  private readonly smoother = new HeadSmoother();
  private seenAt: number | null = null;
  private lost = false;
  private seen = false;
  /** The view when the head was found or lost, and when that was. */
  private from: ScreenPoint = restingHead;
  private since = -Infinity;
  private shown: ScreenPoint = restingHead;

  /** `place`: in the frame of the screen, of a picture that was taken at `time` (milliseconds). */
  add(time: number, place: ScreenPoint): void {
    this.seenAt = time;
    this.lost = false;
    this.smoother.add({ time, place });
  }

  /** The picture that was taken at `time` shows no head. A machine that is slow to answer does not lose it. */
  miss(time: number): void {
    if (this.seenAt !== null && time - this.seenAt >= lostAfter) this.lost = true;
  }

  get isSeen(): boolean {
    return this.seenAt !== null && !this.lost;
  }

  /** How far the head has moved from its resting place, `distance` metres from the screen, times the gains. Call it for growing times. */
  at(now: number, distance: number, gains: ScreenPoint): ScreenPoint {
    const seen = this.isSeen;
    if (seen !== this.seen) {
      this.seen = seen;
      this.from = this.shown;
      this.since = now;
    }
    const place = seen ? this.smoother.at(now) : null;
    const goal = place === null ? restingHead : { x: place.x * gains.x, y: place.y * gains.y, z: (place.z - distance) * gains.z };
    const passed = Math.min(1, (now - this.since) / glide);
    const rest = 1 - passed * passed * (3 - 2 * passed);
    const shown = { ...goal };
    // From where it was shown to the goal, which may move meanwhile.
    for (const axis of axes) shown[axis] += rest * (this.from[axis] - goal[axis]);
    this.shown = shown;
    return shown;
  }
}
