// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Tracing a contour: a trace with its time, whether it is closed, its orientation, and its area error against another line
// (e = S'/S of "Design and implementation of a graphic-haptic display system", 2006: area between the lines over area
// inside).
import type { Place } from '../surface';

export interface TracePoint extends Place {
  /** Seconds since the first movement. */
  t: number;
}

/** A trace may close when it is closer than this to its start (m) … */
export const closeWithin = 0.002;
/** … and longer than this many times that distance. */
const leastLoop = 10;
/** Smaller movements count as rest (m). */
const leastStep = 0.0002;

/** Records a trace from the cue on; the clock starts with the first movement, as in the paper's study. */
export class Tracer {
  readonly points: TracePoint[] = [];
  private from: Place;
  private startedAt: number | null = null;
  private length = 0;

  constructor(at: Place) {
    this.from = { ...at };
  }

  /** The hand is at `place` at `now` (s). True when the trace has just closed. */
  add(place: Place, now: number): boolean {
    const step = Math.hypot(place.x - this.from.x, place.y - this.from.y);
    if (step < leastStep) return false;
    if (this.startedAt === null) {
      this.startedAt = now;
      this.points.push({ ...this.from, t: 0 });
    }
    this.length += step;
    this.from = { ...place };
    this.points.push({ x: place.x, y: place.y, t: now - this.startedAt });
    return this.isClosed();
  }

  isClosed(): boolean {
    const [first, last] = [this.points[0], this.points[this.points.length - 1]];
    if (first === undefined || last === undefined) return false;
    return this.length > leastLoop * closeWithin && Math.hypot(last.x - first.x, last.y - first.y) < closeWithin;
  }
  seconds(): number {
    return this.points[this.points.length - 1]?.t ?? 0;
  }
}

/** Area enclosed, positive counter-clockwise (x right, y up), m². */
export function signedArea(points: readonly Place[]): number {
  return points.reduce((sum, a, k) => {
    const b = points[(k + 1) % points.length]!;
    return sum + (a.x * b.y - b.x * a.y) / 2;
  }, 0);
}

export type Turn = 'clockwise' | 'counter-clockwise';
export function turnOf(points: readonly Place[]): Turn {
  return signedArea(points) < 0 ? 'clockwise' : 'counter-clockwise';
}

export interface Grid {
  columns: number;
  rows: number;
  /** Metres. */
  spacing: number;
  /** Middle of the upper left pixel. */
  left: number;
  top: number;
}

/** The inside of a closed line as a mask (1 inside, 0 outside), by the even-odd rule at pixel centres, top row first. */
export function maskOf(points: readonly Place[], grid: Grid): Uint8Array {
  const mask = new Uint8Array(grid.columns * grid.rows);
  for (let row = 0; row < grid.rows; ++row) {
    const y = grid.top - row * grid.spacing;
    const crossings: number[] = [];
    points.forEach((a, k) => {
      const b = points[(k + 1) % points.length]!;
      if (a.y > y !== b.y > y) crossings.push(a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y));
    });
    crossings.sort((p, q) => p - q);
    for (let k = 0; k + 1 < crossings.length; k += 2) {
      const begin = Math.max(0, Math.ceil((crossings[k]! - grid.left) / grid.spacing));
      const end = Math.min(grid.columns - 1, Math.ceil((crossings[k + 1]! - grid.left) / grid.spacing) - 1);
      if (end >= begin) mask.fill(1, row * grid.columns + begin, row * grid.columns + end + 1);
    }
  }
  return mask;
}

/** A grid over a rectangle centred on the origin. */
export function gridOver(sizeX: number, sizeY: number, spacing: number): Grid {
  const columns = Math.max(1, Math.round(sizeX / spacing));
  const rows = Math.max(1, Math.round(sizeY / spacing));
  return { columns, rows, spacing, left: (-(columns - 1) * spacing) / 2, top: ((rows - 1) * spacing) / 2 };
}

export interface Score {
  /** Area between the two lines divided by the area inside the nominal line. */
  error: number;
  seconds: number;
  /** Total turning angle divided by the length, degrees per millimetre: the smaller, the smoother. */
  roughness: number;
}

/** The score of a closed trace against the nominal line, on pixels of 0.1 mm; null if either encloses nothing. */
export function scoreOf(trace: readonly TracePoint[], nominal: readonly Place[], sizeX: number, sizeY: number): Score | null {
  const grid = gridOver(sizeX, sizeY, 0.0001);
  const [a, b] = [maskOf(trace, grid), maskOf(nominal, grid)];
  let [between, within] = [0, 0];
  for (let k = 0; k < a.length; ++k) {
    between += a[k]! ^ b[k]!;
    within += b[k]!;
  }
  if (within === 0 || !a.includes(1)) return null;
  return { error: between / within, seconds: trace[trace.length - 1]?.t ?? 0, roughness: roughnessOf(trace) };
}

export function roughnessOf(points: readonly Place[]): number {
  let [turned, length] = [0, 0];
  for (let k = 1; k + 1 < points.length; ++k) {
    const [p, q, r] = [points[k - 1]!, points[k]!, points[k + 1]!];
    const [ux, uy, vx, vy] = [q.x - p.x, q.y - p.y, r.x - q.x, r.y - q.y];
    turned += Math.abs(Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy));
    length += Math.hypot(ux, uy);
  }
  return length > 0 ? (turned * 180) / Math.PI / (length * 1000) : 0;
}
