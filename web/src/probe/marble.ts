// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The probe as a marble that follows the pointer, slower uphill and faster downhill (pseudo-haptics; pointer gain 1/(1 + k
// s) uphill after Lecuyer et al. 2004).
import type { Place } from '../surface';

/** Gain k: how much a slope of 1 slows the marble. */
export const slopeWeight = 4;
const downhillGainMost = 1.8;
/** Time constant of the marble on level ground, seconds. */
const followTime = 0.025;
const closeEnough = 2e-5;

/** Pointer gain along a direction of motion with the slope `rise`. */
export function pointerGain(rise: number): number {
  return rise >= 0 ? 1 / (1 + slopeWeight * rise) : Math.min(downhillGainMost, 1 + (slopeWeight * -rise) / 4);
}

/** The marble's place after `seconds`, on its way to `target` over ground of this slope. */
export function follow(marble: Place, target: Place, slope: Place, seconds: number): Place {
  const dx = target.x - marble.x;
  const dy = target.y - marble.y;
  const distance = Math.hypot(dx, dy);
  if (distance <= closeEnough) return { ...target };
  const rise = (slope.x * dx + slope.y * dy) / distance;
  const part = 1 - Math.exp((-seconds * pointerGain(rise)) / followTime);
  return { x: marble.x + part * dx, y: marble.y + part * dy };
}
