// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sonification as numbers; sound.ts plays it.
import type { Place, Surface } from '../surface';

export const lowestPitch = 196;
export const octaves = 2.5;

/** Hertz for a height between the scene's lowest and highest: equal steps of height are equal intervals. */
export function pitchOf(height: number, lowest: number, highest: number): number {
  const span = highest - lowest;
  const part = span > 0 ? Math.min(1, Math.max(0, (height - lowest) / span)) : 0;
  return lowestPitch * 2 ** (octaves * part);
}

/** Where a sound comes from, at a distance of 1 from the listener's head: x right, y up, z back (the axes of Web Audio). */
export interface Direction {
  x: number;
  y: number;
  z: number;
}

/** Angles to the sides and up at the scene's borders: never fully on one side, for people who hear with one ear. */
const widest = Math.PI / 3;
const uppermost = Math.PI / 6;

/** From a listener before the middle of the scene, who looks at it. */
export function directionOf({ x, y }: Place, { sizeX, sizeY }: Pick<Surface, 'sizeX' | 'sizeY'>): Direction {
  const part = (value: number, size: number) => (size > 0 ? Math.min(1, Math.max(-1, (2 * value) / size)) : 0);
  const [side, up] = [widest * part(x, sizeX), uppermost * part(y, sizeY)];
  return { x: Math.sin(side) * Math.cos(up), y: Math.sin(up), z: -Math.cos(side) * Math.cos(up) };
}

/** The pulses that lead to a place: Hz, higher if the place is above (`up`: -1 ... 1, half the scene's height). */
export function findPitch(up: number): number {
  return 660 * 2 ** Math.min(1, Math.max(-1, up));
}

/** Seconds between two pulses: `away`: the distance as a share of the scene's longer side. */
export function findInterval(away: number): number {
  return Math.min(1.2, 0.15 + 1.5 * Math.max(0, away));
}

/** Strength of the sound of a contact, 0 ... 1: force in N, speed of the approach in m/s. */
export function contactStrength(force: number, speed: number): number {
  return Math.min(1, 0.2 + 0.3 * Math.sqrt(Math.max(0, force)) + 0.5 * Math.min(1, Math.max(0, speed) / 0.1));
}

/** Detects edges with hysteresis: the slope exceeds one limit, and must fall below another before the next edge. */
export class EdgeDetector {
  private steep = false;
  constructor(
    readonly onset = 0.8,
    readonly release = 0.4,
  ) {}

  /** `slope`: steepness under the probe. True once per edge. */
  crossed(slope: number): boolean {
    if (this.steep) {
      this.steep = slope > this.release;
      return false;
    }
    this.steep = slope > this.onset;
    return this.steep;
  }
}

/** True when a condition changes from false to true. */
export class RisingEdge {
  private before = false;
  rises(now: boolean): boolean {
    const rose = now && !this.before;
    this.before = now;
    return rose;
  }
}

/** A probe's motion from the program's reports of it. */
export class MotionMeter {
  private last: { t: number; x: number; y: number; z: number } | null = null;

  /** Speed along the surface and towards it (m/s), from the last two reports; t in s, places in m. 0 after a pause of half a second. */
  at(t: number, x: number, y: number, z: number): { along: number; towards: number } {
    const { last } = this;
    if (last !== null && t === last.t) return { along: 0, towards: 0 };
    this.last = { t, x, y, z };
    const passed = last === null ? 0 : t - last.t;
    if (last === null || !(passed > 0) || passed > 0.5) return { along: 0, towards: 0 };
    return { along: Math.hypot(x - last.x, y - last.y) / passed, towards: Math.max(0, (last.z - z) / passed) };
  }
}
