// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { EdgeDetector, octaves, panOf, pitchOf, RisingEdge } from './sonify';

describe('sonification', () => {
  it('gives equal intervals for equal steps of height', () => {
    const pitches = [0, 0.25, 0.5, 0.75, 1].map((h) => pitchOf(h, 0, 1));
    for (let i = 1; i < 5; ++i) expect(pitches[i]! / pitches[i - 1]!).toBeCloseTo(2 ** (octaves / 4), 9);
  });
  it('stays in its range for heights outside and for a flat scene', () => {
    expect(pitchOf(-9, 0, 1)).toBe(pitchOf(0, 0, 1));
    expect(pitchOf(9, 0, 1)).toBe(pitchOf(1, 0, 1));
    expect(pitchOf(5, 5, 5)).toBe(pitchOf(0, 0, 1));
  });
  it('pans from left to right', () => {
    expect(panOf(-0.05, 0.1)).toBeCloseTo(-0.8);
    expect(panOf(0, 0.1)).toBe(0);
    expect(panOf(1, 0.1)).toBeCloseTo(0.8);
  });
  it('detects an edge once for a long slope', () => {
    const edges = new EdgeDetector(0.8, 0.4);
    expect([0, 1, 1.2, 0.6, 1, 0.3, 1].map((slope) => edges.crossed(slope))).toEqual([false, true, false, false, false, false, true]);
  });
  it('clicks only when contact begins', () => {
    const contact = new RisingEdge();
    expect([false, true, true, false, true].map((now) => contact.rises(now))).toEqual([false, true, false, false, true]);
  });
});
