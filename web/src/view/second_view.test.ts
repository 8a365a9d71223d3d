// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { Surface } from '../surface';
import { seenBySecond } from './second_view';

/** A surface of 100 x 1 samples, a block of it (40 to 59) 10 samples nearer. */
const columns = 100;
const shares = new Float32Array(columns).map((_, i) => (i >= 40 && i < 60 ? 0.1 : 0));
const shift = { kind: 'shift', scene: 1, columns, rows: 1, shares } as const;
const { across, seen } = seenBySecond(new Surface(columns, 1, new Float32Array(columns), 0.1, 0.001), shift);

it('the second picture shows what is nearer farther left', () => {
  expect(across[20]).toBeCloseTo(0.205, 6);
  expect(across[50]).toBeCloseTo(0.405, 6);
});

it('what is nearer hides what is left of it', () => {
  expect([...seen].map((one, i) => (one === 0 ? i : -1)).filter((i) => i >= 0)).toEqual([31, 32, 33, 34, 35, 36, 37, 38, 39]);
});

it('what is beyond the border is not seen', () => {
  const all = seenBySecond(new Surface(columns, 1, new Float32Array(columns), 0.1, 0.001), { ...shift, columns: 1, shares: new Float32Array([0.25]) });
  expect([...all.seen.slice(0, 25)].every((one) => one === 0)).toBe(true);
  expect([...all.seen.slice(25)].every((one) => one === 1)).toBe(true);
});
