// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { figure, keyValue, snapped, stepOf } from './range_input';

describe('a slider', () => {
  it('has a round step of about a hundredth of its range', () => {
    expect([stepOf(20, 2000), stepOf(0, 1), stepOf(0, 5), stepOf(0.1, 5), stepOf(1, 32), stepOf(0, 500)]).toEqual([20, 0.01, 0.05, 0.05, 0.5, 5]);
  });
  it('has round values: 500 and not 495.2', () => {
    expect(snapped(495.2, 20, 2000)).toBe(500);
    expect(snapped(0.333, 0, 1)).toBe(0.33);
    expect(snapped(9999, 20, 2000)).toBe(2000);
  });
  it('is moved by all slider keys, in both directions', () => {
    expect(keyValue('ArrowRight', 500, 20, 2000)).toBe(520);
    expect(keyValue('ArrowLeft', 520, 20, 2000)).toBe(500);
    expect(keyValue('PageUp', 500, 20, 2000)).toBe(700);
    expect(keyValue('Home', 500, 20, 2000)).toBe(20);
    expect(keyValue('End', 500, 20, 2000)).toBe(2000);
    expect(keyValue('a', 500, 20, 2000)).toBeNull();
    let value = 0;
    for (let k = 0; k < 1000 && value < 1; ++k) value = keyValue('ArrowUp', value, 0, 1)!;
    expect(value).toBe(1);
  });
  it('shows a value that a program has set to four digits', () => expect([figure(412.3789), figure(0.123456), figure(-1e-12)]).toEqual([412.4, 0.1235, 0]));
});
