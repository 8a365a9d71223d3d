// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { comfortableDepth, disparity, disparityAngle, placeOfAngle } from './comfort';
import { eyesOf, onScreen } from './frustum';

const viewer = { distance: 0.6, eyeDistance: 0.063 };

describe('disparity', () => {
  it('is the distance of both eyes’ pictures on the screen, crossed before it', () => {
    for (const z of [-0.4, -0.05, 0, 0.02, 0.2]) {
      const [left, right] = eyesOf({ x: 0.03, y: 0.01, z: viewer.distance }, viewer.eyeDistance).map((eye) => onScreen({ x: 0.05, y: 0, z }, eye));
      expect(disparity(z, viewer)).toBeCloseTo(left!.x - right!.x, 12);
    }
  });
  it('is an angle of the eyes, which its place has', () => {
    expect(disparityAngle(0, viewer)).toBe(0);
    // Very far away the eyes are parallel: by 6.01 degrees less than at the screen.
    expect(disparityAngle(-1e9, viewer)).toBeCloseTo((-2 * Math.atan(0.0315 / 0.6) * 180) / Math.PI, 4);
    for (const angle of [-2, -1, 0.5, 1]) expect(disparityAngle(placeOfAngle(angle, viewer), viewer)).toBeCloseTo(angle, 9);
    expect(placeOfAngle(-7, viewer)).toBe(-Infinity);
  });
});

describe('the comfortable depth', () => {
  it('is all of a shallow scene', () => expect(comfortableDepth({ nearest: 0.05, farthest: -0.05 }, viewer)).toBe(1));
  it('keeps the worse end of a deep scene at a degree, and the other one below', () => {
    for (const [nearest, farthest] of [[0.3, -0.1], [0.1, -0.9], [0.4, 0], [0, -2]] as const) {
      const share = comfortableDepth({ nearest, farthest }, viewer);
      expect(share).toBeLessThan(1);
      const worst = Math.max(disparityAngle(share * nearest, viewer), -disparityAngle(share * farthest, viewer));
      expect(worst).toBeCloseTo(1, 9);
    }
  });
});
