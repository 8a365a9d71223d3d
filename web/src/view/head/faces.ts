// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Faces from the outputs of the BlazeFace network, and which part of the picture is searched next.
import type { FacePoints, ImagePoint } from './place';

/** The network's square picture, pixels. */
export const inputSide = 256;

/** A square of the camera's picture, pixels; it may exceed the picture. */
export interface Square {
  left: number;
  top: number;
  side: number;
}

export interface Face {
  points: FacePoints;
  /** The network's certainty, 0 to 1. */
  score: number;
}

/** The cells of the picture with their candidates: those of the first output, then those of the second. */
const grids = [
  { stride: 16, candidates: 2 },
  { stride: 32, candidates: 6 },
];
/** Of a candidate: its middle, its width and height, and six points, in pixels from the middle of its cell. */
const values = 16;
const pointCount = 6;
const leastScore = 0.5;
/** Candidates whose boxes overlap by this share of the better one's are of one face. */
const sameFace = 0.3;

export const candidateCount = grids.reduce((sum, { stride, candidates }) => sum + candidates * (inputSide / stride) ** 2, 0);

const cells: ImagePoint[] = grids.flatMap(({ stride, candidates }) => {
  const across = inputSide / stride;
  return Array.from({ length: across * across * candidates }, (_, k) => {
    const cell = Math.floor(k / candidates);
    return { x: stride * ((cell % across) + 0.5), y: stride * (Math.floor(cell / across) + 0.5) };
  });
});

/**
 * The faces in a square of the picture, the most certain first. `logits`: one a candidate; `boxes`: 16 values a candidate. The
 * points of a face are the average of its candidates, weighted by their scores.
 */
export function facesIn(logits: ArrayLike<number>, boxes: ArrayLike<number>, square: Square): Face[] {
  const found = cells
    .map((cell, k) => {
      const at = (value: number) => boxes[values * k + value]!;
      return { cell, at, score: 1 / (1 + Math.exp(-logits[k]!)), x: cell.x + at(0), y: cell.y + at(1), width: at(2), height: at(3) };
    })
    .filter(({ score }) => score >= leastScore)
    .sort((a, b) => b.score - a.score);
  const faces: Face[] = [];
  while (found.length > 0) {
    const best = found[0]!;
    const same = found.filter((one) => {
      const shared = Math.max(0, best.width - Math.abs(one.x - best.x)) * Math.max(0, best.height - Math.abs(one.y - best.y));
      return one === best || shared >= sameFace * best.width * best.height;
    });
    for (const one of same) found.splice(found.indexOf(one), 1);
    const total = same.reduce((sum, { score }) => sum + score, 0);
    const scale = square.side / inputSide;
    const points = Array.from({ length: pointCount }, (_, k) => {
      const mean = (value: number, of: 'x' | 'y') => same.reduce((sum, { cell, at, score }) => sum + (score / total) * (cell[of] + at(value)), 0);
      return { x: square.left + scale * mean(4 + 2 * k, 'x'), y: square.top + scale * mean(5 + 2 * k, 'y') };
    });
    faces.push({ points, score: best.score });
  }
  return faces;
}

const eyesOf = (points: FacePoints) => {
  const [a, b] = [points[0]!, points[1]!];
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) };
};

/** The face that is followed: the one nearest to the last place, at first the largest. */
export function followed(faces: readonly Face[], last: FacePoints | null): Face | null {
  const cost = ({ points }: Face) => {
    const { x, y, apart } = eyesOf(points);
    if (last === null) return -apart;
    const before = eyesOf(last);
    return Math.hypot(x - before.x, y - before.y);
  };
  return faces.reduce<Face | null>((best, face) => (best === null || cost(face) < cost(best) ? face : best), null);
}

/** The whole picture, with borders. */
export const wholeSquare = (width: number, height: number): Square => {
  const side = Math.max(width, height);
  return { left: (width - side) / 2, top: (height - side) / 2, side };
};

/** The square around a face where it is searched next: the points are as exact as its pixels are large. */
export function squareAround(points: FacePoints, width: number, height: number): Square {
  const { x, y, apart } = eyesOf(points);
  const side = Math.min(1.2 * Math.max(width, height), 5 * apart);
  return { left: x - side / 2, top: y + 0.3 * apart - side / 2, side };
}
