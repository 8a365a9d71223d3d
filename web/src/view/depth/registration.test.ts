// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { ScreenPoint } from './frustum';
import { beneath, inScene, inScreen, mostResidual, registrationOf, type Registration, type Triple } from './registration';

const marks: Triple<ScreenPoint> = [{ x: 0.04, y: -0.2, z: 0 }, { x: 0.3, y: -0.2, z: 0 }, { x: 0.1, y: -0.04, z: 0 }];
const turnAbout = (axis: 'x' | 'y' | 'z', angle: number) => ({ x, y, z }: ScreenPoint): ScreenPoint => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  if (axis === 'x') return { x, y: c * y - s * z, z: s * y + c * z };
  if (axis === 'y') return { x: c * x + s * z, y, z: c * z - s * x };
  return { x: c * x - s * y, y: s * x + c * y, z };
};
/** The device's frame in the scene: turned, scaled, shifted. */
const felt = (point: ScreenPoint): ScreenPoint => {
  const { x, y, z } = turnAbout('z', -0.2)(turnAbout('y', 0.3)(turnAbout('x', 0.7)(point)));
  return { x: 0.4 * x + 0.01, y: 0.4 * y - 0.02, z: 0.4 * z + 0.005 };
};
const touched = marks.map(felt) as unknown as Triple<ScreenPoint>;
const far = (a: ScreenPoint, b: ScreenPoint) => Math.hypot(a.x - b.x, a.y - b.y, a.z - b.z);
const found = (from: Triple<ScreenPoint>): { registration: Registration; residual: number } => {
  const result = registrationOf(from, marks);
  if (typeof result === 'string') throw new Error(result);
  return result;
};

describe('three touched points', () => {
  it('place every point of the scene where the hand feels it', () => {
    const { registration, residual } = found(touched);
    expect(registration.scale).toBeCloseTo(2.5, 9);
    expect(residual).toBeLessThan(1e-12);
    for (const point of [{ x: 0.1, y: -0.1, z: 0.07 }, { x: 0.2, y: -0.3, z: -0.05 }]) {
      expect(far(inScreen(felt(point), registration), point)).toBeLessThan(1e-12);
      expect(far(inScene(point, registration), felt(point))).toBeLessThan(1e-12);
    }
  });

  it('that tremble by a millimetre are still placed within a few', () => {
    const trembling = touched.map((point, k) => ({ x: point.x + [4, -4, 2][k]! * 1e-4, y: point.y + [-2, 3, 4][k]! * 1e-4, z: point.z + [3, -2, -4][k]! * 1e-4 }));
    const { registration, residual } = found(trembling as unknown as Triple<ScreenPoint>);
    expect(residual).toBeGreaterThan(0);
    expect(residual).toBeLessThan(0.0015);
    expect(far(inScreen(felt({ x: 0.15, y: -0.12, z: 0.03 }), registration), { x: 0.15, y: -0.12, z: 0.03 })).toBeLessThan(0.003);
  });

  it('are refused where they were exchanged, are nearly on a line or one was missed', () => {
    const [a, b, c] = touched;
    expect(registrationOf([b, a, c], marks)).toBe('apart');
    expect(registrationOf([a, c, b], marks)).toBe('apart');
    expect(registrationOf([a, b, { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, z: (a.z + b.z) / 2 }], marks)).toBe('line');
    expect(registrationOf([a, a, a], marks)).toBe('line');
    expect(registrationOf([a, b, { ...c, x: c.x + (4 * mostResidual) / 2.5 }], marks)).toBe('apart');
  });

  it('are refused where the scene would be seen from behind', () => {
    const behind = marks.map(turnAbout('y', Math.PI)) as unknown as Triple<ScreenPoint>;
    expect(registrationOf(behind, marks)).toBe('behind');
  });

  it('keep a hand at its place on the screen while the scene is moved beneath it', () => {
    const { registration } = found(touched);
    const hand = felt({ x: 0.15, y: -0.12, z: 0.03 });
    const device = { x: 0.03, y: -0.01, z: 0.004 };
    const inMovedScene = { x: hand.x + device.x, y: hand.y + device.y, z: hand.z + device.z };
    expect(far(inScreen(inMovedScene, beneath(registration, device)), { x: 0.15, y: -0.12, z: 0.03 })).toBeLessThan(1e-9);
    expect(far(inScreen(hand, beneath(registration, device)), { x: 0.15, y: -0.12, z: 0.03 })).toBeGreaterThan(0.01);
  });

  it('may lie so that the scene stands like a table before the screen', () => {
    const table = marks.map(turnAbout('x', Math.PI / 2)) as unknown as Triple<ScreenPoint>;
    expect(typeof registrationOf(table, marks)).toBe('object');
  });
});
