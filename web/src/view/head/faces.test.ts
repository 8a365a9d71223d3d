// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { candidateCount, facesIn, followed, inputSide, squareAround, wholeSquare } from './faces';

/** Outputs of the network with faces at the given places of its picture: the cell's number, its logit and its middle. */
function outputs(...faces: { k: number; cell: { x: number; y: number }; logit: number; x: number; y: number }[]) {
  const logits = new Float32Array(candidateCount).fill(-20);
  const boxes = new Float32Array(16 * candidateCount);
  for (const { k, cell, logit, x, y } of faces) {
    logits[k] = logit;
    boxes.set([x - cell.x, y - cell.y, 60, 60], 16 * k);
    const points = [[-10, 0], [10, 0], [0, 9], [0, 20], [-20, 7], [20, 7]];
    boxes.set(points.flatMap(([right, down]) => [x + right! - cell.x, y + down! - cell.y]), 16 * k + 4);
  }
  return { logits, boxes };
}
// Of the fine grid the third cell of the second row, both candidates; of the coarse one the first cell of the last row.
const fine = { k: 2 * (16 + 2), cell: { x: 40, y: 24 } };
const coarse = { k: 512 + 6 * 56, cell: { x: 16, y: 240 } };

describe('the faces', () => {
  it('are found in the cells of both grids, and candidates of one face are one', () => {
    const { logits, boxes } = outputs(
      { ...fine, logit: 3, x: 50, y: 30 },
      { ...fine, k: fine.k + 1, logit: 2, x: 52, y: 30 },
      { ...coarse, logit: 1, x: 30, y: 220 },
    );
    const faces = facesIn(logits, boxes, { left: 100, top: 50, side: 2 * inputSide });
    expect(faces).toHaveLength(2);
    const weights = [3, 2].map((logit) => 1 / (1 + Math.exp(-logit)));
    const x = (50 * weights[0]! + 52 * weights[1]!) / (weights[0]! + weights[1]!);
    expect(faces[0]!.points[0]!.x).toBeCloseTo(100 + 2 * (x - 10), 4);
    expect(faces[0]!.points[3]!.y).toBeCloseTo(50 + 2 * 50, 4);
    expect(faces[1]!.points[1]!.x).toBeCloseTo(100 + 2 * 40, 4);
    expect(candidateCount).toBe(896);
  });
  it('are none where nothing is certain', () => {
    const { logits, boxes } = outputs({ ...fine, logit: -0.1, x: 50, y: 30 });
    expect(facesIn(logits, boxes, { left: 0, top: 0, side: 1 })).toEqual([]);
  });
  it('are followed by their place, at first by their size', () => {
    const at = (x: number, apart: number) => ({ points: [{ x, y: 0 }, { x: x + apart, y: 0 }], score: 1 });
    const [small, large] = [at(100, 20), at(300, 30)];
    expect(followed([small, large], null)).toBe(large);
    expect(followed([small, large], at(120, 25).points)).toBe(small);
    expect(followed([], null)).toBeNull();
  });
});

describe('the searched square', () => {
  it('holds the whole picture, or a face with room around it', () => {
    expect(wholeSquare(640, 480)).toEqual({ left: 0, top: -80, side: 640 });
    const { left, top, side } = squareAround([{ x: 300, y: 200 }, { x: 340, y: 200 }], 640, 480);
    expect([left, top, side]).toEqual([220, 112, 200]);
  });
});
