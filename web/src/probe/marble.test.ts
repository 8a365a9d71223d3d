// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Surface } from '../surface';
import { follow, pointerGain } from './marble';
import { PageProbe } from './page_probe';

const slope = new Surface(11, 11, Float32Array.from({ length: 121 }, (_, k) => (k % 11) * 0.001), 0.11, 0.11);

describe('the marble', () => {
  it('is slower uphill, faster downhill, and arrives', () => {
    const after = (rise: number) => follow({ x: 0, y: 0 }, { x: 0.01, y: 0 }, { x: rise, y: 0 }, 0.016).x;
    expect(after(1)).toBeLessThan(after(0));
    expect(after(-1)).toBeGreaterThan(after(0));
    expect(pointerGain(0)).toBe(1);
    let marble = { x: 0, y: 0 };
    for (let i = 0; i < 200; ++i) marble = follow(marble, { x: 0.01, y: 0.01 }, { x: 2, y: 0 }, 0.016);
    expect(marble).toEqual({ x: 0.01, y: 0.01 });
  });
  it('moves at once by a key, within the scene', () => {
    const probe = new PageProbe();
    expect(probe.step(0.001, 0, 0, slope, 0)).toBe(true);
    expect(probe.place).toEqual({ x: 0.001, y: 0 });
    expect(probe.step(1, 0, 0, slope, 0)).toBe(false);
    expect(probe.place.x).toBe(0.055);
    expect(probe.advance(0.016, slope, 1)).toBe(true);
    expect(probe.advance(0.016, slope, 1)).toBe(false);
  });
});
