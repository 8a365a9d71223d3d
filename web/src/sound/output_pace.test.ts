// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { OutputPace } from './output_pace';

describe('the pace of the output', () => {
  it('bears a late block now and then', () => {
    const pace = new OutputPace();
    for (let second = 0; second < 60; ++second) expect(pace.losesSound({ totalDuration: second, underrunDuration: 0.004 * second })).toBe(false);
  });
  it('loses sound if more than a hundredth of two seconds is lost', () => {
    const pace = new OutputPace();
    expect(pace.losesSound({ totalDuration: 0, underrunDuration: 0 })).toBe(false);
    expect(pace.losesSound({ totalDuration: 1, underrunDuration: 0.03 })).toBe(false);
    expect(pace.losesSound({ totalDuration: 2, underrunDuration: 0.03 })).toBe(true);
    expect(pace.losesSound({ totalDuration: 4, underrunDuration: 0.03 })).toBe(false);
  });
});
