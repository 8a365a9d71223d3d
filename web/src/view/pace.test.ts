// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { Pace } from './pace';

it('the pace is too slow after a dozen late frames in a row, not after pauses', () => {
  const pace = new Pace();
  let now = 0;
  const frames = (count: number, gap: number) => Array.from({ length: count }, () => pace.drawn((now += gap))).includes(true);
  expect(frames(100, 16)).toBe(false);
  expect(frames(11, 60)).toBe(false);
  expect(frames(1, 16)).toBe(false);
  expect(frames(12, 60)).toBe(true);
  for (let i = 0; i < 50; ++i) {
    pace.rested();
    expect(pace.drawn((now += 500))).toBe(false);
  }
});
