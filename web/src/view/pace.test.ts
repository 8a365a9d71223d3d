// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { Pace } from './pace';

it('the pace is slow after several late frames in a row, and too slow after very late ones', () => {
  const pace = new Pace();
  const frames = (count: number, waited: number) => Array.from({ length: count }, () => pace.drawn(waited)).find((speed) => speed !== 'fine') ?? 'fine';
  expect(frames(100, 16)).toBe('fine');
  expect(frames(7, 60)).toBe('fine');
  expect(frames(1, 16)).toBe('fine');
  expect(frames(8, 60)).toBe('slow');
  expect(frames(8, 400)).toBe('too slow');
});
