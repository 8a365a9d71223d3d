// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How much depth two eyes accept: they focus on the screen but turn to where a point seems to be. Within a degree of
// difference that is no effort for most people (Lambooij et al., "Visual discomfort and visual fatigue of stereoscopic
// displays: a review", J. Imaging Sci. Technol. 53(3), 2009).

/** Degrees. */
export const comfortLimit = 1;

const degrees = 180 / Math.PI;

/** The distance from the screen to the eyes, and between the eyes: one unit. */
export interface Viewer {
  distance: number;
  eyeDistance: number;
}

/** The nearest and the farthest point, along the screen's normal, from its plane: positive towards the person. */
export interface DepthRange {
  nearest: number;
  farthest: number;
}

/** The distance on the screen from the right eye's to the left eye's picture of a point `z` before the screen: negative behind it. */
export const disparity = (z: number, { distance, eyeDistance }: Viewer): number => (eyeDistance * z) / (distance - z);

/** The angle between the eyes' lines of sight to a point, less that to a point on the screen; degrees. */
export function disparityAngle(z: number, { distance, eyeDistance }: Viewer): number {
  return 2 * degrees * (Math.atan(eyeDistance / (2 * (distance - z))) - Math.atan(eyeDistance / (2 * distance)));
}

/** The place before the screen whose disparity is this angle; -∞ if no place is so far behind it. */
export function placeOfAngle(angle: number, { distance, eyeDistance }: Viewer): number {
  const convergence = Math.atan(eyeDistance / (2 * distance)) + angle / (2 * degrees);
  return convergence > 0 ? distance - eyeDistance / (2 * Math.tan(convergence)) : -Infinity;
}

/** The greatest share of the depth, at most 1, with which no disparity exceeds `limit` degrees. */
export function comfortableDepth({ nearest, farthest }: DepthRange, viewer: Viewer, limit = comfortLimit): number {
  const before = nearest > 0 ? placeOfAngle(limit, viewer) / nearest : Infinity;
  const behind = farthest < 0 ? placeOfAngle(-limit, viewer) / farthest : Infinity;
  return Math.min(1, before, behind);
}
