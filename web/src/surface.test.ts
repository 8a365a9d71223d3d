// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Surface } from './surface';

const slope = new Surface(11, 11, Float32Array.from({ length: 121 }, (_, k) => (k % 11) * 0.001), 0.11, 0.11);

describe('the surface', () => {
  it('has the heights and slopes of a ramp, and its rectangle', () => {
    expect(slope.heightAt({ x: 0, y: 0.02 })).toBeCloseTo(0.005, 9);
    expect(slope.heightAt({ x: 0.013, y: 0 })).toBeCloseTo(0.0063, 9);
    expect(slope.slopeAt({ x: 0, y: 0 }).x).toBeCloseTo(0.1, 6);
    expect(slope.slopeAt({ x: 0, y: 0 }).y).toBeCloseTo(0, 9);
    expect(slope.clamp({ x: 1, y: -1 })).toEqual({ x: 0.055, y: -0.055 });
  });
  it('intersects a ray at its own height', () => {
    const straight = slope.hit([0.02, 0.01, 1], [0, 0, -1], 1)!;
    expect(straight).toEqual({ x: 0.02, y: 0.01 });
    const slanted = slope.hit([0.02, -0.5, 0.5], [0, Math.SQRT1_2, -Math.SQRT1_2], 2)!;
    expect(slanted.y).toBeCloseTo(-2 * slope.heightAt(slanted), 3);
    expect(slope.hit([0, 0, 1], [0, 0, 1], 1)).toBeNull();
  });
  it('searches its lowest and highest place once, however often it is asked', () => {
    let read = 0;
    const heights = new Proxy(Float32Array.from([3, -1, 2, 5]), {
      get: (samples, key) => {
        if (key === Symbol.iterator) read += 1;
        const value: unknown = Reflect.get(samples, key, samples);
        return typeof value === 'function' ? (value as () => unknown).bind(samples) : value;
      },
    });
    const surface = new Surface(2, 2, heights, 1, 1);
    expect([surface.range(), surface.range(), surface.range()]).toEqual(Array(3).fill({ lowest: -1, highest: 5 }));
    expect(read).toBe(1);
  });
  it('has a scale that its steps follow, from 5 mm to 10 m', () => {
    const scale = (size: number) => new Surface(2, 2, new Float32Array(4), size, size / 2).scale;
    expect([0.005, 0.03, 0.1, 0.12, 0.2, 1, 10].map(scale)).toEqual([0.05, 0.2, 1, 1, 2, 10, 100]);
  });
});
