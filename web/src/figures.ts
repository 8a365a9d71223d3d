// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Formatting and update rate of displayed figures.

import { fixed } from './language';

/** Milliseconds between two updates of figures: ten per second are readable and leave time for the servo. */
export const figuresEvery = 100;

/** Metres as millimetres with one digit after the point, with two on scenes smaller than 50 mm (`scale`: Surface.scale). */
export function millimetreFigure(metres: number, scale = 1): string {
  return fixed(metres * 1000, scale < 0.5 ? 2 : 1).replace(/^-(0[.,]0+)$/, '$1');
}
