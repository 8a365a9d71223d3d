// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene's block for three.js: its surface, its sides and its picture.
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  SRGBColorSpace,
  type Mesh,
  type MeshBasicMaterial,
} from 'three';
import type { PictureFrame } from '../codec';
import type { Surface } from '../surface';

/** Of a scene of 0.1 m; metres. */
export const baseThickness = 0.002;

/** The scene's longer side in units of 0.1 m, which scales marbles, lines and the camera's range. */
export function sizeOf({ sizeX, sizeY }: Surface): number {
  return Math.max(sizeX, sizeY) / 0.1;
}

/** Frees what a mesh has on the graphics processor. */
export function discard(mesh: Mesh | null): void {
  mesh?.geometry.dispose();
  (mesh?.material as MeshBasicMaterial | undefined)?.dispose();
}

export function textureOf({ columns, rows, rgb }: PictureFrame, anisotropy: number): DataTexture {
  const rgba = new Uint8Array(columns * rows * 4);
  // Rows go upwards in a texture.
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const from = 3 * (j * columns + i);
      rgba.set([rgb[from]!, rgb[from + 1]!, rgb[from + 2]!, 255], 4 * ((rows - 1 - j) * columns + i));
    }
  const texture = new DataTexture(rgba, columns, rows);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = anisotropy;
  texture.needsUpdate = true;
  return texture;
}

export function groundOf(surface: Surface, heightFactor: number): BufferGeometry {
  const { columns, rows } = surface;
  const position = new Float32Array(columns * rows * 3);
  const uv = new Float32Array(columns * rows * 2);
  const index = new Uint32Array((columns - 1) * (rows - 1) * 6);
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const k = j * columns + i;
      position.set([surface.xOf(i), surface.yOf(j), surface.at(i, j) * heightFactor], 3 * k);
      uv.set([(i + 0.5) / columns, 1 - (j + 0.5) / rows], 2 * k);
    }
  let at = 0;
  for (let j = 0; j + 1 < rows; ++j)
    for (let i = 0; i + 1 < columns; ++i) {
      const k = j * columns + i;
      index.set([k, k + columns, k + 1, k + 1, k + columns, k + columns + 1], at);
      at += 6;
    }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('uv', new BufferAttribute(uv, 2));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeVertexNormals();
  return geometry;
}

/** The sides of the block, from the surface's rim down to the base. */
export function wallsOf(surface: Surface, heightFactor: number): BufferGeometry {
  const { columns, rows } = surface;
  const rim: [number, number][] = [];
  for (let i = 0; i < columns - 1; ++i) rim.push([i, rows - 1]);
  for (let j = rows - 1; j > 0; --j) rim.push([columns - 1, j]);
  for (let i = columns - 1; i > 0; --i) rim.push([i, 0]);
  for (let j = 0; j < rows; ++j) rim.push([0, j]);
  const { lowest, highest } = surface.range();
  const floor = Math.min(lowest * heightFactor, highest * heightFactor) - baseThickness * sizeOf(surface);
  const position = new Float32Array(rim.length * 6);
  const index: number[] = [];
  rim.forEach(([i, j], k) => {
    const [x, y] = [surface.xOf(i), surface.yOf(j)];
    position.set([x, y, surface.at(i, j) * heightFactor, x, y, floor], 6 * k);
    if (k > 0) index.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k, 2 * k - 1, 2 * k + 1);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  return geometry;
}
