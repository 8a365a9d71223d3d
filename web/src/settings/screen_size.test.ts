// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { card, cssPixel, measuredPixel } from './screen_size';

it('a pixel is 1/96 inch until the screen is measured, then as measured at any magnification of the browser', () => {
  expect(cssPixel(0, 2)).toBeCloseTo(0.26458, 5);
  // A card that is 400 CSS pixels wide.
  for (const ratio of [1, 1.5, 2]) expect(cssPixel(measuredPixel(card.long, 400, ratio), ratio)).toBeCloseTo(0.214, 4);
  const measured = measuredPixel(card.short, 270, 3);
  expect(cssPixel(measured, 3 * 1.25)).toBeCloseTo((card.short / 270) * 1.25, 4);
});
