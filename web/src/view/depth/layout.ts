// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where on the canvas each depth mode shows the pictures of the two eyes.
import type { Preferences } from '../../settings/preferences';
import { glasses, type Glasses } from './anaglyph';
import type { Size } from './frustum';

export type Mode = Exclude<Preferences['depthMode'], 'plain'>;

/** How both pictures share one canvas. */
export type Mixing = { by: 'colours'; glasses: Glasses } | { by: 'rows' } | { by: 'columns' };

export interface Layout {
  /** Columns and rows of pictures on the canvas. */
  columns: 1 | 2;
  rows: 1 | 2;
  /** Whether the screen stretches each picture to the whole canvas, as 3-D screens do. */
  stretched: boolean;
  /** Whose picture is the left or the upper one, or has the first row or column. */
  first: 'left' | 'right' | 'head';
  mixing: Mixing | null;
}

const whole = { columns: 1, rows: 1, stretched: false, mixing: null } as const;
const beside = { ...whole, columns: 2 } as const;

export const layouts: Record<Mode, Layout> = {
  head: { ...whole, first: 'head' },
  'red-cyan': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['red-cyan'] } },
  'amber-blue': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['amber-blue'] } },
  'green-magenta': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['green-magenta'] } },
  parallel: { ...beside, first: 'left' },
  crossed: { ...beside, first: 'right' },
  'side-by-side': { ...beside, stretched: true, first: 'left' },
  'over-under': { ...whole, rows: 2, stretched: true, first: 'left' },
  rows: { ...whole, first: 'left', mixing: { by: 'rows' } },
  columns: { ...whole, first: 'left', mixing: { by: 'columns' } },
};

/** The window through which an eye sees the scene; of a canvas of this size. */
export function windowOf({ columns, rows, stretched }: Layout, canvas: Size): Size {
  return stretched ? canvas : { width: canvas.width / columns, height: canvas.height / rows };
}

/** The place in its window, in shares from the upper left corner, of a place on the canvas in such shares. */
export function inWindow({ columns, rows }: Layout, across: number, down: number): { across: number; down: number } {
  const part = (share: number, count: number) => share * count - Math.min(count - 1, Math.max(0, Math.floor(share * count)));
  return { across: part(across, columns), down: part(down, rows) };
}

/** Whole device pixels from the canvas's upper left corner. */
export interface Pixels {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** The parts of a canvas, of equal size: the first one, and the second one if there is one. Of odd sizes the middle line is in none. */
export function partsOf({ columns, rows }: Layout, width: number, height: number): Pixels[] {
  const part = { width: Math.floor(width / columns), height: Math.floor(height / rows) };
  const first = { left: 0, top: 0, ...part };
  return columns * rows === 1 ? [first] : [first, { left: width - part.width, top: height - part.height, ...part }];
}
