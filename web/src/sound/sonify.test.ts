// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { contactStrength, directionOf, EdgeDetector, MotionMeter, octaves, pitchOf, RisingEdge } from './sonify';

describe('sonification', () => {
  it('gives equal intervals for equal steps of height', () => {
    const pitches = [0, 0.25, 0.5, 0.75, 1].map((h) => pitchOf(h, 0, 1));
    for (let i = 1; i < 5; ++i) expect(pitches[i]! / pitches[i - 1]!).toBeCloseTo(2 ** (octaves / 4), 9);
  });
  it('stays in its range for heights outside and for a flat scene', () => {
    expect(pitchOf(-9, 0, 1)).toBe(pitchOf(0, 0, 1));
    expect(pitchOf(9, 0, 1)).toBe(pitchOf(1, 0, 1));
    expect(pitchOf(5, 5, 5)).toBe(pitchOf(0, 0, 1));
  });
  it('places sounds on their side and height, at one distance, and never beside or behind the head', () => {
    const surface = { sizeX: 0.1, sizeY: 0.08 };
    for (const x of [-1, -0.05, -0.02, 0, 0.03, 9])
      for (const y of [-1, -0.01, 0, 0.04]) {
        const { x: right, y: up, z: back } = directionOf({ x, y }, surface);
        expect(Math.hypot(right, up, back)).toBeCloseTo(1, 9);
        expect([Math.sign(right), Math.sign(up)]).toEqual([Math.sign(x), Math.sign(y)]);
        expect(back).toBeLessThan(-0.4);
      }
    expect(directionOf({ x: 0.05, y: 0 }, surface).x).toBeCloseTo(Math.sin(Math.PI / 3), 9);
    expect(directionOf({ x: 0.05, y: 0 }, { sizeX: 0, sizeY: 0 })).toEqual({ x: 0, y: 0, z: -1 });
  });
  it('makes a contact louder with force and speed, and never louder than full', () => {
    expect(contactStrength(1, 0)).toBeGreaterThan(contactStrength(0.2, 0));
    expect(contactStrength(0.2, 0.05)).toBeGreaterThan(contactStrength(0.2, 0.01));
    expect(contactStrength(100, 9)).toBe(1);
    expect(contactStrength(0, 0)).toBeGreaterThan(0);
  });
  it('detects an edge once for a long slope', () => {
    const edges = new EdgeDetector(0.8, 0.4);
    expect([0, 1, 1.2, 0.6, 1, 0.3, 1].map((slope) => edges.crossed(slope))).toEqual([false, true, false, false, false, false, true]);
  });
  it('knocks only when contact begins', () => {
    const contact = new RisingEdge();
    expect([false, true, true, false, true].map((now) => contact.rises(now))).toEqual([false, true, false, false, true]);
  });
  it('measures speeds along and towards the surface, and none at first, after a pause, or in a repeated report', () => {
    const meter = new MotionMeter();
    const rest = { along: 0, towards: 0 };
    expect(meter.at(1, 0, 0, 0.01)).toEqual(rest);
    const moved = meter.at(1.02, 0.003, 0.004, 0.009);
    expect(moved.along).toBeCloseTo(0.25, 9);
    expect(moved.towards).toBeCloseTo(0.05, 9);
    expect(meter.at(1.02, 0.003, 0.004, 0.009)).toEqual(rest);
    expect(meter.at(1.04, 0.003, 0.004, 0.02).towards).toBe(0);
    expect(meter.at(3, 0.05, 0, 0)).toEqual(rest);
  });
});
