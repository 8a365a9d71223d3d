// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { disparityAngle } from './comfort';
import { eyeInScene, fitByHand, fitOf, type FitOptions } from './fit';
import { eyesOf, onScreen, type ScreenPoint } from './frustum';

const viewer = { distance: 0.6, eyeDistance: 0.063 };
const window = { width: 0.3, height: 0.2 };
const options: FitOptions = { before: 0.4, depth: 1, comfort: true, zoom: 1, headDistance: 0.6 };
const box = (x: number, y: number, z: number): ScreenPoint[] => [-x, x].flatMap((a) => [-y, y].flatMap((b) => [-z, z].map((c) => ({ x: a, y: b, z: c }))));

describe('a scene where a hand feels it', () => {
  const registration = { scale: 2, right: { x: 1, y: 0, z: 0 }, up: { x: 0, y: 1, z: 0 }, towards: { x: 0, y: 0, z: 1 }, origin: { x: 0.2, y: -0.1, z: 0.05 } };
  it('has its whole depth, and the disparities of its place', () => {
    const fit = fitByHand(box(0.03, 0.03, 0.04), viewer, registration);
    expect(fit).toMatchObject({ scale: 2, depth: 1, isByHand: true });
    expect(fit.nearest).toBeCloseTo(disparityAngle(0.13, viewer), 9);
    expect(fit.farthest).toBeCloseTo(disparityAngle(-0.03, viewer), 9);
  });
  it('has finite ones also beside the eyes', () => expect(fitByHand(box(0.03, 0.03, 0.5), viewer, registration).nearest).toBeGreaterThan(0));
});

describe('a scene on the screen', () => {
  it('is in the window, for both eyes', () => {
    for (const corners of [box(0.05, 0.03, 0.01), box(0.02, 0.06, 0.05), box(1, 1, 0.3)]) {
      const fit = fitOf(corners, window, viewer, options);
      for (const eye of eyesOf({ x: 0, y: 0, z: viewer.distance }, viewer.eyeDistance))
        for (const { x, y, z } of corners) {
          const at = onScreen({ x: x * fit.scale, y: y * fit.scale, z: (z - fit.plane) * fit.scale * fit.depth }, eye);
          expect(Math.abs(at.x)).toBeLessThanOrEqual(window.width / 2);
          expect(Math.abs(at.y)).toBeLessThanOrEqual(window.height / 2);
        }
    }
  });
  it('has no disparity of more than a degree, also magnified and from nearby, unless that is wanted', () => {
    for (const zoom of [0.5, 1, 12])
      for (const headDistance of [0.3, 0.6, 1.2])
        for (const before of [0, 0.4, 1])
          for (const depth of [0.1, 1, 2]) {
            const fit = fitOf(box(0.03, 0.03, 0.04), window, viewer, { ...options, zoom, headDistance, before, depth });
            expect(fit.nearest).toBeLessThan(1 + 1e-9);
            expect(fit.farthest).toBeGreaterThan(-1 - 1e-9);
            const seen = { ...viewer, distance: headDistance };
            expect(disparityAngle((0.04 - fit.plane) * fit.scale * fit.depth, seen)).toBeLessThan(1 + 1e-9);
          }
    expect(fitOf(box(0.03, 0.03, 0.04), window, viewer, { ...options, comfort: false, before: 1 }).nearest).toBeGreaterThan(1);
  });
  it('is of the same size wherever the head is', () => {
    const scales = [0.3, 0.6, 1.2].map((headDistance) => fitOf(box(0.05, 0.05, 0.03), window, viewer, { ...options, headDistance }).scale);
    expect(new Set(scales).size).toBe(1);
  });
  it('lies as far before the screen as wanted', () => {
    expect(fitOf(box(0.05, 0.05, 0.03), window, viewer, { ...options, before: 0 }).nearest).toBe(0);
    expect(fitOf(box(0.05, 0.05, 0.03), window, viewer, { ...options, before: 1 }).farthest).toBeCloseTo(0, 12);
  });
  it('is never nearer than half-way to the eyes', () => {
    const fit = fitOf(box(0.001, 0.001, 0.5), window, viewer, { ...options, comfort: false, depth: 2, zoom: 12 });
    expect((0.5 - fit.plane) * fit.scale * fit.depth).toBeLessThanOrEqual(0.3 + 1e-9);
  });
  it('with a share of its depth looks as from farther away', () => {
    const fit = fitOf(box(0.03, 0.03, 0.04), window, viewer, options);
    expect(fit.depth).toBeLessThan(1);
    const eye = { x: 0.1, y: -0.05, z: 0.6 };
    const from = eyeInScene(eye, fit);
    for (const z of [0.02, -0.03]) {
      const flattened = onScreen({ x: 0.01 * fit.scale, y: 0, z: z * fit.scale * fit.depth }, eye);
      const seen = onScreen({ x: 0.01, y: 0, z }, from);
      expect(seen.x * fit.scale).toBeCloseTo(flattened.x, 12);
      expect(seen.y * fit.scale).toBeCloseTo(flattened.y, 12);
    }
  });
});
