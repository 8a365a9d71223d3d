// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { highestOf, offsetWords, peaksOf, positionWords, regionOf, sceneWords, slopeWords } from './describe';
import { Surface } from '../surface';

function made(height: (x: number, y: number) => number, columns = 200, rows = 150): Surface {
  const surface = new Surface(columns, rows, new Float32Array(columns * rows), 0.1, 0.075);
  for (let j = 0; j < rows; ++j) for (let i = 0; i < columns; ++i) surface.heights[j * columns + i] = height(surface.xOf(i), surface.yOf(j));
  return surface;
}
const bump = (x: number, y: number, at: [number, number], width: number, height: number) =>
  height * Math.exp(-((x - at[0]) ** 2 + (y - at[1]) ** 2) / width ** 2);
const twin = made((x, y) => 0.001 + bump(x, y, [-0.03, 0.02], 0.008, 0.012) + bump(x, y, [0.025, -0.015], 0.008, 0.008));

describe('words for places', () => {
  it('name the ninths', () => {
    expect(regionOf({ x: 0, y: 0 }, 0.1, 0.1)).toBe('centre');
    expect(regionOf({ x: -0.04, y: 0.04 }, 0.1, 0.1)).toBe('upper left');
    expect(regionOf({ x: 0.04, y: 0 }, 0.1, 0.1)).toBe('middle right');
    expect(regionOf({ x: 0, y: -0.04 }, 0.1, 0.1)).toBe('lower middle');
  });
  it('count millimetres', () => {
    expect(offsetWords(-0.032, 0.001)).toBe('32 millimetres left, 1 millimetre up');
    expect(offsetWords(0.0004, -0.0004)).toBe('here');
  });
  it('tell which way it rises', () => {
    expect(slopeWords({ x: 0, y: 0 })).toBe('level');
    expect(slopeWords({ x: 0.3, y: 0.3 })).toBe('rising to the upper right');
    expect(slopeWords({ x: -2, y: 0.1 })).toBe('rising steeply to the left');
    expect(slopeWords({ x: 0, y: -0.1 })).toBe('rising gently to the bottom');
  });
});

describe('peaks', () => {
  it('are found where they are, with their prominence', () => {
    const peaks = peaksOf(twin, 0.001);
    expect(peaks).toHaveLength(2);
    expect(peaks[0]!.x).toBeCloseTo(-0.03, 2);
    expect(peaks[0]!.y).toBeCloseTo(0.02, 2);
    expect(peaks[0]!.prominence).toBeCloseTo(0.012, 3);
    expect(peaks[1]!.prominence).toBeCloseTo(0.008, 3);
  });
  it('leave out ripples', () => {
    const rippled = made((x, y) => bump(x, y, [0, 0], 0.02, 0.01) + 0.0001 * Math.sin(2000 * x));
    expect(peaksOf(rippled, 0.001)).toHaveLength(1);
  });
  it('make one of a plateau', () => {
    const table = made((x, y) => (Math.abs(x) < 0.02 && Math.abs(y) < 0.02 ? 0.01 : 0));
    expect(peaksOf(table, 0.001)).toHaveLength(1);
  });
});

describe('the description', () => {
  it('says size, highest point, way to it and the other rises', () => {
    const words = sceneWords(twin, 'twin', 1, { x: 0, y: 0 });
    expect(words).toContain('twin: 100 millimetres wide, 75 millimetres from top to bottom, heights from 1.0 millimetres to 13.0 millimetres');
    expect(words).toContain('Highest point: upper left, 30 millimetres left, 20 millimetres up from the middle.');
    expect(words).toContain('From the probe: 30 millimetres left, 20 millimetres up.');
    expect(words).toMatch(/Further rises: lower right, 9\.0 millimetres high/);
    expect(words).not.toMatch(/NaN|undefined/);
  });
  it('follows the depth, and turns over when engraved', () => {
    expect(sceneWords(twin, 'twin', 2, { x: 0, y: 0 })).toContain('to 26.0 millimetres');
    expect(sceneWords(twin, 'twin', -1, { x: 0, y: 0 })).toContain('heights from -13.0 millimetres to -1.0 millimetres');
  });
  it('calls a flat scene flat', () => expect(sceneWords(made(() => 0.002), 'plate', 1, { x: 0, y: 0 })).toContain('flat at 2.0 millimetres'));
  it('finds the highest sample itself', () => {
    const spike = made((x, y) => (Math.abs(x - 0.01025) < 1e-4 && Math.abs(y + 0.02025) < 1e-4 ? 0.02 : 0.001));
    expect(highestOf(spike)).toMatchObject({ height: expect.closeTo(0.02, 6), x: expect.closeTo(0.01025, 6), y: expect.closeTo(-0.02025, 6) });
  });
  it('tells position, height and slope', () => {
    expect(positionWords({ x: 0.01, y: 0 }, 0.0123, { x: 0.2, y: 0 }, 'roof', twin)).toBe(
      'Centre, 10 millimetres right from the middle. Height 12.3 millimetres, rising to the right. roof.',
    );
  });
});
