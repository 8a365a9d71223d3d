// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The head's path from single measurements: a Gaussian average over the last ones (Gomez, chapter 11), and the head's
// velocity, by which the average's lag and the camera's are made up for.
import type { ScreenPoint } from '../depth/frustum';

export interface Sample {
  /** When the picture was taken, milliseconds. */
  time: number;
  place: ScreenPoint;
}

export interface SmoothOptions {
  /** Standard deviations of the Gaussians over the samples' ages, for the place and for the velocity, milliseconds. */
  width: number;
  velocityWidth: number;
  /** Below the first speed nothing is predicted, above the second all; metres per second. */
  still: number;
  moving: number;
  /** No further is predicted, milliseconds. */
  farthest: number;
}

/** Chosen on synthetic heads (smooth.test.ts). */
export const smoothing: SmoothOptions = { width: 100, velocityWidth: 100, still: 0.03, moving: 0.09, farthest: 200 };

const axes = ['x', 'y', 'z'] as const;
/** Beyond so many standard deviations a sample counts nothing. */
const reach = 3;

export class HeadSmoother {
  private samples: Sample[] = [];

  constructor(private readonly options: SmoothOptions = smoothing) {}

  /** `time` increases. */
  add(sample: Sample): void {
    const { width, velocityWidth } = this.options;
    this.samples = this.samples.filter(({ time }) => sample.time - time < reach * Math.max(width, velocityWidth));
    this.samples.push(sample);
  }

  /** The average, and how much older than the last sample it is (milliseconds); null without samples. */
  average(): { place: ScreenPoint; lag: number } | null {
    const last = this.samples.at(-1);
    if (last === undefined) return null;
    const place = { x: 0, y: 0, z: 0 };
    let [sum, lag] = [0, 0];
    for (const { time, place: at } of this.samples) {
      const weight = gaussian(last.time - time, this.options.width);
      sum += weight;
      lag += weight * (last.time - time);
      for (const axis of axes) place[axis] += weight * at[axis];
    }
    for (const axis of axes) place[axis] /= sum;
    return { place, lag: lag / sum };
  }

  /** Metres per second: the slope of the line through the last samples (weighted least squares). */
  velocity(): ScreenPoint {
    const last = this.samples.at(-1);
    const slope = { x: 0, y: 0, z: 0 };
    if (last === undefined) return slope;
    const weights = this.samples.map(({ time }) => gaussian(last.time - time, this.options.velocityWidth));
    const sum = weights.reduce((a, b) => a + b, 0);
    const mean = this.samples.reduce((total, { time }, k) => total + weights[k]! * time, 0) / sum;
    const square = this.samples.reduce((total, { time }, k) => total + weights[k]! * (time - mean) ** 2, 0);
    if (square === 0) return slope;
    this.samples.forEach(({ time, place }, k) => {
      for (const axis of axes) slope[axis] += (1000 * weights[k]! * (time - mean) * place[axis]) / square;
    });
    return slope;
  }

  /** Where the head is at a time, if it goes on as it moved; a head that is almost still is not predicted. */
  at(time: number): ScreenPoint | null {
    const average = this.average();
    if (average === null) return null;
    const { still, moving, farthest } = this.options;
    const ahead = Math.min(farthest, average.lag + Math.max(0, time - this.samples.at(-1)!.time)) / 1000;
    const velocity = this.velocity();
    const { place } = average;
    for (const axis of axes) {
      const share = (Math.abs(velocity[axis]) - still) / (moving - still);
      place[axis] += ahead * velocity[axis] * Math.min(1, Math.max(0, share));
    }
    return place;
  }
}

const gaussian = (age: number, width: number) => (age > reach * width ? 0 : Math.exp(-0.5 * (age / width) ** 2));
