// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Pictures for coloured glasses. Each matrix maps the linear red, green and blue of one eye's picture to a part of the
// anaglyph, so that the colours that the eyes see through the filters are nearest, by least squares, to those of the
// pictures (E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001). The figures are those of
// E. Dubois, "Conversion of a stereo pair to anaglyph with the least-squares projection method", 2009, for the sRGB
// primaries of LCDs and common filters.

/** Row by row. */
type Matrix = readonly [number, number, number, number, number, number, number, number, number];
export type Colour = readonly [number, number, number];

export interface Glasses {
  left: Matrix;
  right: Matrix;
}

export const glasses = {
  'red-cyan': {
    left: [0.437, 0.449, 0.164, -0.062, -0.062, -0.024, -0.048, -0.05, -0.017],
    right: [-0.011, -0.032, -0.007, 0.377, 0.761, 0.009, -0.026, -0.093, 1.234],
  },
  'amber-blue': {
    left: [1.062, -0.205, 0.299, -0.026, 0.908, 0.068, -0.038, -0.173, 0.022],
    right: [-0.016, -0.123, -0.017, 0.006, 0.062, -0.017, 0.094, 0.185, 0.911],
  },
  'green-magenta': {
    left: [-0.062, -0.158, -0.039, 0.284, 0.668, 0.143, -0.015, -0.027, 0.021],
    right: [0.529, 0.705, 0.024, -0.016, -0.015, -0.065, 0.009, 0.075, 0.937],
  },
} as const satisfies Record<string, Glasses>;

const times = (m: Matrix, [r, g, b]: Colour, row: 0 | 1 | 2) => m[3 * row]! * r + m[3 * row + 1]! * g + m[3 * row + 2]! * b;

/** The anaglyph of two linear colours, each from 0 to 1. The view's shader computes the same. */
export function anaglyph(left: Colour, right: Colour, through: Glasses): Colour {
  const channel = (row: 0 | 1 | 2) => Math.min(1, Math.max(0, times(through.left, left, row) + times(through.right, right, row)));
  return [channel(0), channel(1), channel(2)];
}
