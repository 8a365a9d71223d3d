// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { OutputPace } from './output_pace';

describe('the pace of the output', () => {
  it('bears a late block now and then', () => {
    const pace = new OutputPace();
    for (let second = 0; second < 60; ++second) expect(pace.losesSound({ totalDuration: second, underrunDuration: 0.004 * second })).toBe(false);
  });
  it('loses sound if more than a hundredth is lost twice in a row', () => {
    const pace = new OutputPace();
    const after = (totalDuration: number, underrunDuration: number) => pace.losesSound({ totalDuration, underrunDuration });
    expect([after(0, 0), after(1, 0.03), after(2, 0.03), after(4, 0.03), after(6, 0.06), after(7, 0.09), after(8, 0.09)]).toEqual([
      false, false, false, false, false, false, true,
    ]);
  });
});
