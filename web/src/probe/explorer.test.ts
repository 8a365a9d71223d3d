// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Explorer } from './explorer';
import { Surface } from '../surface';

const surface = new Surface(2, 2, new Float32Array(4), 0.1, 0.06);
const near = (place: { x: number; y: number }, x: number, y: number) => {
  expect(place.x).toBeCloseTo(x, 9);
  expect(place.y).toBeCloseTo(y, 9);
};

describe('an explorer', () => {
  it('walks in the direction of the heading', () => {
    const explorer = new Explorer();
    expect(explorer.walk(0.01, surface)).toBe(true);
    near(explorer.pose, 0, 0.01);
    explorer.turn(90);
    explorer.walk(0.02, surface);
    near(explorer.pose, -0.02, 0.01);
    explorer.turn(-180);
    explorer.walk(-0.005, surface);
    near(explorer.pose, -0.025, 0.01);
  });
  it('stays within the scene', () => {
    const explorer = new Explorer();
    expect(explorer.walk(0.05, surface)).toBe(false);
    near(explorer.pose, 0, 0.03);
  });
  it('has a heading from -180 to 180 degrees', () => {
    const explorer = new Explorer();
    for (let k = 0; k < 13; ++k) explorer.turn(15);
    expect(explorer.pose.heading).toBe(-165);
    for (let k = 0; k < 23; ++k) explorer.turn(-15);
    expect(explorer.pose.heading).toBe(-150);
  });
  it('moves the hand along while walking and turning', () => {
    const explorer = new Explorer();
    const { pose } = explorer;
    explorer.walk(0.01, surface);
    explorer.turn(90);
    // 4 mm to the right and 2 mm ahead of the feet, before and after.
    near(explorer.carried({ x: 0.004, y: 0.002 }, pose), -0.002, 0.014);
    near(explorer.inScene({ x: 0.004, y: 0.002 }), -0.002, 0.004);
  });
});
