// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { isSwitch, scaleOf } from './parameter_panel';

describe("a law's parameter", () => {
  it('is a switch if it is yes or no, else a slider', () => {
    expect(isSwitch({ unit: 'yes or no' })).toBe(true);
    for (const unit of ['', 'N/m', 'm']) expect(isSwitch({ unit })).toBe(false);
  });
  it('is shown in millimetres if it is a length', () => {
    expect(scaleOf({ unit: 'm' })).toEqual({ scale: 1000, unit: 'mm' });
    expect(scaleOf({ unit: 'N/m' })).toEqual({ scale: 1, unit: 'N/m' });
  });
});
