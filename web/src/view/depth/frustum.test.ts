// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { PerspectiveCamera, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { eyesOf, offAxis, onScreen, type ScreenPoint } from './frustum';

const window = { width: 0.3, height: 0.2 };
/** Where a camera at the eye draws a point, in metres on the screen. */
function drawn(point: ScreenPoint, eye: ScreenPoint): { x: number; y: number } {
  const { left, right, top, bottom, near, far } = offAxis(eye, window, 0.01, 9);
  const camera = new PerspectiveCamera();
  camera.position.set(eye.x, eye.y, eye.z);
  camera.projectionMatrix.makePerspective(left, right, top, bottom, near, far);
  camera.updateMatrixWorld();
  const at = new Vector3(point.x, point.y, point.z).project(camera);
  return { x: (at.x * window.width) / 2, y: (at.y * window.height) / 2 };
}

describe('an off-axis frustum', () => {
  const eyes = [{ x: 0, y: 0, z: 0.6 }, { x: 0.2, y: -0.1, z: 0.4 }, { x: -0.3, y: 0.3, z: 1.1 }];
  it.each(eyes)('draws points of the screen where they are, from $x, $y, $z', (eye) => {
    for (const [x, y] of [[0, 0], [0.15, 0.1], [-0.1, 0.04]] as const) {
      const at = drawn({ x, y, z: 0 }, eye);
      expect(at.x).toBeCloseTo(x, 12);
      expect(at.y).toBeCloseTo(y, 12);
    }
  });
  it.each(eyes)('draws other points where the line of sight meets the screen, from $x, $y, $z', (eye) => {
    for (const point of [{ x: 0.05, y: 0.02, z: 0.07 }, { x: -0.1, y: 0.08, z: -0.2 }]) {
      const [at, wanted] = [drawn(point, eye), onScreen(point, eye)];
      expect(at.x).toBeCloseTo(wanted.x, 12);
      expect(at.y).toBeCloseTo(wanted.y, 12);
    }
  });
  it('has the eyes on both sides of the head', () => {
    const [left, right] = eyesOf({ x: 0.1, y: 0.2, z: 0.5 }, 0.063);
    expect(left).toEqual({ x: 0.1 - 0.0315, y: 0.2, z: 0.5 });
    expect(right.x - left.x).toBeCloseTo(0.063, 12);
  });
});
