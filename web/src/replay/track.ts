// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// One probe's way through a recording, at the rate of a page, in bounded memory.

/** What is kept of a tick: position (m) and written force (N) in the scene, and whether it touched, was paused, and its label. */
export interface Moment {
  x: number;
  y: number;
  z: number;
  fx: number;
  fy: number;
  fz: number;
  contact: boolean;
  paused: boolean;
  label: number;
}

const width = 8;
const firstRows = 4096;
/** Rows of a track: 36 minutes at 60 per second. Longer ones are thinned. */
const usualMost = 131_072;
const isContact = 1;
const isPaused = 2;

export class Track {
  private times = new Float64Array(firstRows);
  private values = new Float32Array(width * firstRows);
  private count = 0;
  private period = 1 / 60;

  constructor(private readonly most = usualMost) {}

  get rows(): number {
    return this.count;
  }
  get first(): number {
    return this.times[0] ?? NaN;
  }
  get last(): number {
    return this.count > 0 ? this.times[this.count - 1]! : NaN;
  }
  /** Seconds between two rows. */
  get spacing(): number {
    return this.period;
  }

  /** The next tick, at `t` (s, not before the last one). Of the ticks of a period the newest is kept, and a contact of any of them. */
  add(t: number, moment: Moment): void {
    const begins = this.count === 0 || t - this.times[this.count - 1]! >= this.period;
    if (begins) {
      if (this.count === this.most) this.thin();
      if (this.count === this.times.length) this.grow();
      this.times[this.count++] = t;
    }
    const at = width * (this.count - 1);
    const touched = moment.contact || (!begins && (this.values[at + 6]! & isContact) !== 0);
    this.values.set([moment.x, moment.y, moment.z, moment.fx, moment.fy, moment.fz, (touched ? isContact : 0) | (moment.paused ? isPaused : 0), moment.label], at);
  }

  /** The newest row that is not after `t`, and its time; null: there is none. */
  at(t: number): { time: number; moment: Moment } | null {
    let [low, high] = [0, this.count];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= t) low = middle + 1;
      else high = middle;
    }
    if (low === 0) return null;
    const [x, y, z, fx, fy, fz, flags, label] = this.values.subarray(width * (low - 1), width * low) as unknown as [number, number, number, number, number, number, number, number];
    return { time: this.times[low - 1]!, moment: { x, y, z, fx, fy, fz, contact: (flags & isContact) !== 0, paused: (flags & isPaused) !== 0, label } };
  }

  /** Half as many rows, of periods twice as long. */
  private thin(): void {
    const kept = Math.ceil(this.count / 2);
    for (let k = 0; k < kept; ++k) {
      const second = Math.min(2 * k + 1, this.count - 1);
      const touched = (this.values[width * 2 * k + 6]! | this.values[width * second + 6]!) & isContact;
      this.times[k] = this.times[2 * k]!;
      this.values.copyWithin(width * k, width * second, width * (second + 1));
      this.values[width * k + 6] = (this.values[width * k + 6]! & ~isContact) | touched;
    }
    this.count = kept;
    this.period *= 2;
  }

  private grow(): void {
    const size = Math.min(this.most, 2 * this.times.length);
    const [times, values] = [new Float64Array(size), new Float32Array(width * size)];
    times.set(this.times);
    values.set(this.values);
    [this.times, this.values] = [times, values];
  }
}
