// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Runs in the browser, without the program: the 3D view of a scene that is known to a hundredth of a millimetre, for depth.browser.ts.
import { Surface } from '../src/surface';
import type { Fit } from '../src/view/depth/fit';
import type { ScreenPoint } from '../src/view/depth/frustum';
import type { Registration } from '../src/view/depth/registration';
import { cornerOnScreen } from '../src/settings/screen_size';
import { plainLook, type Look } from '../src/view/view';
import type { SecondView } from '../src/view/second_view';
import { View3d } from '../src/view/view3d';

/** A disc or a square, level at a height, with a disc or a right half of its own colour; metres. */
export interface Mark {
  x: number;
  y: number;
  height: number;
  kind: 'disc' | 'edge';
  colour: [number, number, number];
}

/** The second picture: its discs have this colour, and are as much farther left, as a share of the width, as they are higher (per metre). */
export interface Second {
  colour: [number, number, number];
  shiftPerMetre: number;
}

export interface Shot {
  width: number;
  height: number;
  look: Partial<Look>;
  head: ScreenPoint;
  /** Where a hand feels the scene. */
  registration?: Registration;
}

export interface Taken {
  fit: Fit | null;
  /** Red, green, blue, opacity; row-major from the upper left corner, in base 64. */
  pixels: string;
  /** The CSS pixel of the screen at the stage's corner. */
  corner: { left: number; top: number };
}

declare global {
  interface Window {
    depthScene: { build(size: [number, number], marks: Mark[], marble: ScreenPoint, second?: Second): void; take(shot: Shot): Taken };
  }
}

const samplesPerMetre = 2000;
const texelsPerMetre = 10000;
const discRadius = 0.002;
const levelRadius = 0.004;

let view: View3d | null = null;
/** The view that was built. */
export const theView = () => view!;

window.depthScene = {
  build([sizeX, sizeY], marks, marble, second) {
    const raster = (perMetre: number) => ({ columns: Math.round(sizeX * perMetre), rows: Math.round(sizeY * perMetre) });
    const ground = raster(samplesPerMetre);
    const heights = new Float32Array(ground.columns * ground.rows);
    const picture = raster(texelsPerMetre);
    const rgb = new Uint8Array(3 * picture.columns * picture.rows);
    const each = ({ columns, rows }: { columns: number; rows: number }, set: (k: number, x: number, y: number) => void) => {
      for (let k = 0; k < columns * rows; ++k) set(k, (((k % columns) + 0.5) / columns - 0.5) * sizeX, (0.5 - (Math.floor(k / columns) + 0.5) / rows) * sizeY);
    };
    for (const mark of marks) {
      const level = mark.kind === 'disc' ? levelRadius : 3 * levelRadius;
      each(ground, (k, x, y) => {
        if (Math.max(Math.abs(x - mark.x), Math.abs(y - mark.y)) < level) heights[k] = mark.height;
      });
      each(picture, (k, x, y) => {
        const [dx, dy] = [x - mark.x, y - mark.y];
        const inside = mark.kind === 'disc' ? Math.hypot(dx, dy) < discRadius : dx > 0 && dx < level / 2 && Math.abs(dy) < level / 2;
        if (inside) rgb.set(mark.colour, 3 * k);
      });
    }
    const stage = document.getElementById('stage')!;
    view?.dispose();
    view = new View3d(stage);
    const surface = new Surface(ground.columns, ground.rows, heights, sizeX, sizeY);
    view.show(surface, { kind: 'picture', scene: 1, ...picture, rgb }, second && secondOf(surface, marks, picture, second));
    view.probes([{ ...marble, force: [0, 0, 0], number: 1, chosen: true }]);
  },

  take({ width, height, look, head, registration = undefined }) {
    const stage = document.getElementById('stage')!;
    stage.style.width = `${width}px`;
    stage.style.height = `${height}px`;
    view!.set(1, { ...plainLook, surface: 'unlit', tilt: 0, ...look });
    view!.resize();
    view!.head(head);
    view!.register(registration ?? null);
    view!.draw(0);
    return { fit: view!.fit, pixels: pixelsIn(view!.canvas, width, height), corner: cornerOnScreen(view!.canvas) };
  },
};

/** The picture of a second camera far away to the right of the first: rows alike, what is higher farther left. */
function secondOf({ columns, rows, heights, sizeX, sizeY }: Surface, marks: readonly Mark[], size: { columns: number; rows: number }, second: Second): SecondView {
  const rgb = new Uint8Array(3 * size.columns * size.rows);
  const inSecond = (mark: Mark) => mark.x - second.shiftPerMetre * mark.height * sizeX;
  for (let k = 0; k < size.columns * size.rows; ++k) {
    const [x, y] = [(((k % size.columns) + 0.5) / size.columns - 0.5) * sizeX, (0.5 - (Math.floor(k / size.columns) + 0.5) / size.rows) * sizeY];
    if (marks.some((mark) => mark.kind === 'disc' && Math.hypot(x - inSecond(mark), y - mark.y) < discRadius)) rgb.set(second.colour, 3 * k);
  }
  const shares = heights.map((height) => second.shiftPerMetre * height);
  return { picture: { kind: 'second', scene: 1, ...size, rgb }, shift: { kind: 'shift', scene: 1, columns, rows, shares } };
}

/** What a canvas shows, in base 64. */
export function pixelsIn(canvas: HTMLCanvasElement, width: number, height: number): string {
  const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true })!;
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, width, height);
  let text = '';
  for (let k = 0; k < data.length; k += 8192) text += String.fromCharCode(...data.subarray(k, k + 8192));
  return btoa(text);
}
