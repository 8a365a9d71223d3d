// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { depthModes } from '../../settings/preferences';
import { inWindow, layouts, partsOf, windowOf } from './layout';

const canvas = { width: 0.4, height: 0.3 };

describe('the layouts', () => {
  it('are there for every depth mode', () => expect(['plain', ...Object.keys(layouts)].sort()).toEqual([...depthModes].sort()));
  it('show the whole window, except beside each other for free viewing', () => {
    for (const layout of Object.values(layouts)) expect(windowOf(layout, canvas).height).toBe(0.3);
    expect(windowOf(layouts.parallel, canvas).width).toBe(0.2);
    expect(windowOf(layouts['side-by-side'], canvas)).toEqual(canvas);
  });
  it('divide the canvas into equal parts, also of odd sizes', () => {
    expect(partsOf(layouts.parallel, 101, 50)).toEqual([{ left: 0, top: 0, width: 50, height: 50 }, { left: 51, top: 0, width: 50, height: 50 }]);
    expect(partsOf(layouts['over-under'], 100, 51).map(({ top, height }) => [top, height])).toEqual([[0, 25], [26, 25]]);
    expect(partsOf(layouts.rows, 101, 50)).toHaveLength(1);
  });
  it('point at the same place in either picture', () => {
    const near = ({ across, down }: { across: number; down: number }) => [across, down].map((share) => Number(share.toFixed(9)));
    expect(near(inWindow(layouts.crossed, 0.1, 0.7))).toEqual([0.2, 0.7]);
    expect(near(inWindow(layouts.crossed, 0.6, 0.7))).toEqual([0.2, 0.7]);
    expect(near(inWindow(layouts['over-under'], 0.3, 0.75))).toEqual([0.3, 0.5]);
    expect(near(inWindow(layouts['red-cyan'], 0.9, 0.75))).toEqual([0.9, 0.75]);
    expect(near(inWindow(layouts.parallel, 1, 0))).toEqual([1, 0]);
  });
});
