// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The pair's second picture as what the right eye sees: it is projected onto the surface from where its camera was (view-dependent
// texture: Debevec, Yu & Borshukov 1998), so it fits wherever the eyes are. What the second camera did not see has the first picture.
import { BufferAttribute, Mesh, type BufferGeometry, type Material, type MeshBasicMaterial, type MeshStandardMaterial, type Texture } from 'three';
import type { PictureFrame, ShiftFrame } from '../codec';
import type { Surface } from '../surface';

export interface SecondView {
  picture: PictureFrame;
  shift: ShiftFrame;
}

/** Layers of three.js, as its headsets use them: what each eye alone sees. */
export const leftEye = 1;
export const rightEye = 2;

/** Half the width of a vertex's cell, in cells, by which something nearer must be before it to hide it. */
const hiding = 1.5;

/** The shares by which the second picture shows the surface's vertices farther left; bilinear, constant beyond the border. */
function sharesOf({ columns, rows }: Surface, shift: ShiftFrame): Float32Array {
  const shares = new Float32Array(columns * rows);
  const at = (i: number, j: number) => shift.shares[Math.min(shift.rows - 1, Math.max(0, j)) * shift.columns + Math.min(shift.columns - 1, Math.max(0, i))]!;
  for (let j = 0; j < rows; ++j) {
    const v = ((j + 0.5) / rows) * shift.rows - 0.5;
    for (let i = 0; i < columns; ++i) {
      const u = ((i + 0.5) / columns) * shift.columns - 0.5;
      const [a, b] = [Math.floor(u), Math.floor(v)];
      const [s, t] = [u - a, v - b];
      shares[j * columns + i] = (at(a, b) * (1 - s) + at(a + 1, b) * s) * (1 - t) + (at(a, b + 1) * (1 - s) + at(a + 1, b + 1) * s) * t;
    }
  }
  return shares;
}

/**
 * For each vertex of the surface, row by row: where the second picture shows it (a share of its width from the left), and
 * whether it does (1 or 0): it may be beyond its border, or hidden by what is nearer.
 */
export function seenBySecond(surface: Surface, shift: ShiftFrame): { across: Float32Array; seen: Float32Array } {
  const { columns, rows } = surface;
  const shares = sharesOf(surface, shift);
  const across = shares.map((share, k) => ((k % columns) + 0.5) / columns - share);
  const seen = new Float32Array(columns * rows);
  const nearest = new Float32Array(columns);
  for (let row = 0; row < rows; ++row) {
    const first = row * columns;
    nearest.fill(-Infinity);
    // The front sides between neighbours: a back side is not seen.
    for (let k = first; k + 1 < first + columns; ++k) {
      const [from, to] = [across[k]! * columns - 0.5, across[k + 1]! * columns - 0.5];
      for (let column = Math.max(0, Math.ceil(from)); column <= Math.min(columns - 1, to); ++column) {
        const along = to > from ? (column - from) / (to - from) : 0;
        nearest[column] = Math.max(nearest[column]!, shares[k]! + along * (shares[k + 1]! - shares[k]!));
      }
    }
    for (let k = first; k < first + columns; ++k) {
      const column = Math.round(across[k]! * columns - 0.5);
      if (column >= 0 && column < columns && nearest[column]! - shares[k]! < hiding / columns) seen[k] = 1;
    }
  }
  return { across, seen };
}

/** The right eye's own mesh on the same surface; `ground` becomes the left eye's. */
export function rightEyeMesh(ground: Mesh<BufferGeometry, Material>, surface: Surface, view: SecondView, texture: Texture): Mesh {
  const { across, seen } = seenBySecond(surface, view.shift);
  ground.geometry.setAttribute('secondAcross', new BufferAttribute(across, 1));
  ground.geometry.setAttribute('secondSeen', new BufferAttribute(seen, 1));
  const material = ground.material.clone() as MeshBasicMaterial | MeshStandardMaterial;
  material.customProgramCacheKey = () => 'second view';
  material.onBeforeCompile = (shader) => {
    shader.uniforms.second = { value: texture };
    shader.vertexShader = shader.vertexShader
      .replace('void main() {', 'attribute float secondAcross, secondSeen; varying vec3 secondAt;\nvoid main() { secondAt = vec3(secondAcross, uv.y, secondSeen);');
    shader.fragmentShader = shader.fragmentShader
      .replace('void main() {', 'uniform sampler2D second; varying vec3 secondAt;\nvoid main() {')
      .replace('#include <map_fragment>', 'diffuseColor *= mix(texture2D(map, vMapUv), texture2D(second, secondAt.xy), clamp(secondAt.z, 0.0, 1.0));');
  };
  const mesh = new Mesh(ground.geometry, material);
  ground.layers.set(leftEye);
  mesh.layers.set(rightEye);
  return mesh;
}
