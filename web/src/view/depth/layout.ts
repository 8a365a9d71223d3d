// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where on the canvas each depth mode shows the pictures of the two eyes.
import type { Preferences } from '../../settings/preferences';
import { glasses, type Glasses } from './anaglyph';
import { comfortLimit, type Viewer } from './comfort';
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
  /** Whether each eye looks straight ahead, at its own picture. */
  straight: boolean;
  /** Whose picture is the left or the upper one, or has the first row or column. */
  first: 'left' | 'right' | 'head';
  mixing: Mixing | null;
}

const whole = { columns: 1, rows: 1, stretched: false, straight: false, mixing: null } as const;
const beside = { ...whole, columns: 2 } as const;

export const layouts: Record<Mode, Layout> = {
  head: { ...whole, first: 'head' },
  'red-cyan': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['red-cyan'] } },
  'amber-blue': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['amber-blue'] } },
  'green-magenta': { ...whole, first: 'left', mixing: { by: 'colours', glasses: glasses['green-magenta'] } },
  parallel: { ...beside, straight: true, first: 'left' },
  crossed: { ...beside, first: 'right' },
  'side-by-side': { ...beside, stretched: true, first: 'left' },
  'over-under': { ...whole, rows: 2, stretched: true, first: 'left' },
  rows: { ...whole, first: 'left', mixing: { by: 'rows' } },
  columns: { ...whole, first: 'left', mixing: { by: 'columns' } },
};

/**
 * How far apart two pictures may be that eyes look at straight ahead: no two pictures of one point may be farther apart than
 * the eyes, which cannot turn outwards. Points behind the screen are up to the comfort limit farther apart than the pictures;
 * beyond 1.8 m that would leave nothing, so half of the eyes' distance is kept. In the viewer's unit.
 */
export function straightPitch({ distance, eyeDistance }: Viewer): number {
  const behind = distance * Math.tan((comfortLimit * Math.PI) / 180);
  return eyeDistance - Math.min(behind, eyeDistance / 2);
}

/** The share of the canvas's width that the pictures take, in its middle; `width`: that of the canvas. */
export function usedShare({ straight, columns }: Layout, width: number, viewer: Viewer): number {
  return straight ? Math.min(1, (columns * straightPitch(viewer)) / width) : 1;
}

/** Whether each eye's picture has its own size and place on the screen, as the scene has where a hand feels it. */
export const fillsCanvas = ({ columns, stretched }: Layout): boolean => columns === 1 || stretched;

/** The window through which an eye sees the scene; of a canvas of this size, of which `used` is the pictures' share. */
export function windowOf({ columns, rows, stretched }: Layout, canvas: Size, used: number): Size {
  return stretched ? canvas : { width: (canvas.width * used) / columns, height: canvas.height / rows };
}

/** The place in its window, in shares from the upper left corner, of a place on the canvas in such shares. */
export function inWindow({ columns, rows }: Layout, across: number, down: number, used: number): { across: number; down: number } {
  const part = (share: number, count: number) => share * count - Math.min(count - 1, Math.max(0, Math.floor(share * count)));
  return { across: part((across - (1 - used) / 2) / used, columns), down: part(down, rows) };
}

/** Whole device pixels from the canvas's upper left corner. */
export interface Pixels {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** The parts of a canvas, of equal size: the first one, and the second one if there is one. Of odd sizes the middle line is in none. */
export function partsOf({ columns, rows }: Layout, width: number, height: number, used: number): Pixels[] {
  const part = { width: Math.floor((width * used) / columns), height: Math.floor(height / rows) };
  const left = Math.round((width * (1 - used)) / 2);
  const first = { left, top: 0, ...part };
  return columns * rows === 1 ? [first] : [first, { left: width - left - part.width, top: height - part.height, ...part }];
}
