// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { depthModes } from '../../settings/preferences';
import { comfortLimit } from './comfort';
import { inWindow, layouts, partsOf, straightPitch, usedShare, windowOf } from './layout';

const canvas = { width: 0.4, height: 0.3 };

describe('the layouts', () => {
  it('are there for every depth mode', () => expect(['plain', ...Object.keys(layouts)].sort()).toEqual([...depthModes].sort()));
  it('show the whole window, except beside each other for free viewing', () => {
    for (const layout of Object.values(layouts)) expect(windowOf(layout, canvas, 1).height).toBe(0.3);
    expect(windowOf(layouts.parallel, canvas, 1).width).toBe(0.2);
    expect(windowOf(layouts['side-by-side'], canvas, 1)).toEqual(canvas);
  });
  it('divide the canvas into equal parts, also of odd sizes', () => {
    expect(partsOf(layouts.parallel, 101, 50, 1)).toEqual([{ left: 0, top: 0, width: 50, height: 50 }, { left: 51, top: 0, width: 50, height: 50 }]);
    expect(partsOf(layouts['over-under'], 100, 51, 1).map(({ top, height }) => [top, height])).toEqual([[0, 25], [26, 25]]);
    expect(partsOf(layouts.rows, 101, 50, 1)).toHaveLength(1);
  });
  it('point at the same place in either picture', () => {
    const near = ({ across, down }: { across: number; down: number }) => [across, down].map((share) => Number(share.toFixed(9)));
    expect(near(inWindow(layouts.crossed, 0.1, 0.7, 1))).toEqual([0.2, 0.7]);
    expect(near(inWindow(layouts.crossed, 0.6, 0.7, 1))).toEqual([0.2, 0.7]);
    expect(near(inWindow(layouts['over-under'], 0.3, 0.75, 1))).toEqual([0.3, 0.5]);
    expect(near(inWindow(layouts['red-cyan'], 0.9, 0.75, 1))).toEqual([0.9, 0.75]);
    expect(near(inWindow(layouts.parallel, 1, 0, 1))).toEqual([1, 0]);
  });
  it('leave eyes that look straight ahead no two pictures of a point that are farther apart than they are', () => {
    for (const eyeDistance of [0.04, 0.063, 0.08])
      for (const distance of [0.2, 0.6, 1.5]) {
        const pitch = straightPitch({ distance, eyeDistance });
        const behind = distance * Math.tan((comfortLimit * Math.PI) / 180);
        expect(pitch + Math.min(behind, eyeDistance / 2)).toBeLessThanOrEqual(eyeDistance + 1e-12);
        expect(pitch).toBeGreaterThanOrEqual(eyeDistance / 2);
        for (const width of [0.07, 0.2, 0.5, 1.2]) {
          const used = usedShare(layouts.parallel, width, { distance, eyeDistance });
          const [left, right] = partsOf(layouts.parallel, Math.round(1e4 * width), 100, used);
          expect((right!.left - left!.left) / 1e4).toBeLessThanOrEqual(pitch + 2e-4);
          // As wide as that allows, and in the middle.
          expect(windowOf(layouts.parallel, { width, height: 0.3 }, used).width).toBeCloseTo(Math.min(width / 2, pitch), 9);
          expect(right!.left + right!.width + left!.left).toBe(Math.round(1e4 * width));
          expect(inWindow(layouts.parallel, 0.5 - used / 4, 0.5, used).across).toBeCloseTo(0.5, 9);
          expect(inWindow(layouts.parallel, 0.5 + used / 8, 0.5, used).across).toBeCloseTo(0.25, 9);
        }
      }
    expect(usedShare(layouts.crossed, 1.2, { distance: 0.6, eyeDistance: 0.063 })).toBe(1);
  });
});
