// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { anaglyph, glasses, type Colour } from './anaglyph';

const black: Colour = [0, 0, 0];
const white: Colour = [1, 1, 1];
/** The channels that each lens lets through. */
const lens = { 'red-cyan': { left: [0], right: [1, 2] }, 'amber-blue': { left: [0, 1], right: [2] }, 'green-magenta': { left: [1], right: [0, 2] } };

describe.each(Object.entries(glasses))('anaglyphs for %s glasses', (name, through) => {
  const { left, right } = lens[name as keyof typeof lens];
  it('are grey where both eyes see the same grey', () => {
    for (const level of [0, 0.3, 1])
      for (const channel of anaglyph([level, level, level], [level, level, level], through)) expect(Math.abs(channel - level)).toBeLessThan(0.005);
  });
  it('show each eye’s white through its own lens', () => {
    const [ofLeft, ofRight] = [anaglyph(white, black, through), anaglyph(black, white, through)];
    for (const c of left) {
      expect(ofLeft[c]).toBeGreaterThan(0.9);
      expect(ofRight[c]).toBeLessThan(0.06);
    }
    for (const c of right) {
      expect(ofRight[c]).toBeGreaterThan(0.9);
      expect(ofLeft[c]).toBeLessThan(0.06);
    }
  });
});
