// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The screen's real size, which browsers do not tell: measured with a card of a known size that is held against it.

/** The format ID-1 of bank cards (ISO/IEC 7810), millimetres. */
export const card = { long: 85.6, short: 53.98 };

/** CSS pixels are defined as 1/96 inch, which few screens keep. */
const nominalPixel = 25.4 / 96;

/** Millimetres per CSS pixel. `pixelSize`: those per device pixel, 0 if not measured; `ratio`: device pixels per CSS pixel. */
export const cssPixel = (pixelSize: number, ratio: number): number => (pixelSize > 0 ? pixelSize * ratio : nominalPixel);

/** The CSS pixel of the screen at the upper left corner of an element, if all of the browser's own bars are above the page. */
export function cornerOnScreen(element: Element): { left: number; top: number } {
  const { left, top } = element.getBoundingClientRect();
  return { left: window.screenX + left, top: window.screenY + window.outerHeight - window.innerHeight + top };
}

/** Millimetres per device pixel, if a side of the card of `side` millimetres is so many CSS pixels. */
export const measuredPixel = (side: number, cssPixels: number, ratio: number): number => Number((side / cssPixels / ratio).toPrecision(5));
