// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A scene of ten discs at known places, and where they are in drawn pixels: for depth.browser.ts and headset.browser.ts.
import { fileURLToPath } from 'node:url';
import { build, type Rollup } from 'vite';
import type { Colour } from '../src/view/depth/anaglyph';
import type { Mark } from './depth_scene';

/** The surface's highest point, metres. */
export const top = 0.02;
export const marks: Mark[] = [0, 1].flatMap((row) =>
  [0, 1, 2, 3, 4].map((column): Mark => {
    const k = 5 * row + column;
    return { x: (column - 2) * 0.018, y: row === 0 ? 0.03 : -0.03, height: ((7 * k) % 10) * (top / 9), kind: 'disc', colour: [255, 255, 255] };
  }),
);

export interface Pixels {
  width: number;
  height: number;
  at(left: number, top: number): Colour;
}

/** `text`: red, green, blue, opacity; row-major from the upper left corner, in base 64. */
export function pixelsOf(text: string, width: number, height: number): Pixels {
  const bytes = Buffer.from(text, 'base64');
  return {
    width,
    height,
    at: (left, top) => {
      const k = 4 * (top * width + left);
      return [bytes[k]!, bytes[k + 1]!, bytes[k + 2]!];
    },
  };
}

/** The centre of what is bright around a place: `of` gives a pixel's brightness. */
export function centre({ at, width, height }: Pixels, left: number, top: number, radius: number, of: (colour: Colour) => number) {
  let [sum, x, y] = [0, 0, 0];
  for (let j = Math.max(0, Math.floor(top - radius)); j <= Math.min(height - 1, top + radius); ++j)
    for (let i = Math.max(0, Math.floor(left - radius)); i <= Math.min(width - 1, left + radius); ++i) {
      const weight = of(at(i, j));
      [sum, x, y] = [sum + weight, x + weight * (i + 0.5), y + weight * (j + 0.5)];
    }
  return { left: x / sum, top: y / sum };
}

/** A page with the stage alone, in dark colours. */
export const stagePage =
  '<style>body { margin: 0; --stage: #000; --clay: #000; --force: #000; --marble: #f00 } #stage canvas { display: block; width: 100%; height: 100% }</style><div id="stage"></div>';

/** A file of this folder with what it imports, as one script for the browser. */
export async function scriptOf(file: string): Promise<string> {
  const entry = fileURLToPath(new URL(file, import.meta.url));
  const built = (await build({
    configFile: false,
    logLevel: 'error',
    publicDir: false,
    build: { write: false, target: 'es2022', minify: false, lib: { entry, formats: ['iife'], name: 'scene' } },
  })) as Rollup.RollupOutput[];
  return built[0]!.output[0].code;
}
