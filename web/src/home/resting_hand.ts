// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where a hand rests: the mean of its places in the last half second, if it moved little in it.
import type { ScreenPoint } from '../view/depth/frustum';

/** Milliseconds. */
const period = 500;

export class RestingHand {
  private places: { at: number; place: ScreenPoint }[] = [];

  forget(): void {
    this.places = [];
  }

  /** The program sends a place when it changes, and else once a second: so the last one before the period is the one at its beginning. */
  add(place: ScreenPoint, now: number): void {
    this.places.push({ at: now, place });
    this.drop(now);
  }

  /** Null: it moved farther than `most` from the mean, or is unknown. */
  place(most: number, now: number): ScreenPoint | null {
    this.drop(now);
    if (this.places.length === 0) return null;
    const mean = (of: (place: ScreenPoint) => number) => this.places.reduce((sum, { place }) => sum + of(place), 0) / this.places.length;
    const middle = { x: mean(({ x }) => x), y: mean(({ y }) => y), z: mean(({ z }) => z) };
    const strayed = Math.max(...this.places.map(({ place }) => Math.hypot(place.x - middle.x, place.y - middle.y, place.z - middle.z)));
    return strayed <= most ? middle : null;
  }

  private drop(now: number): void {
    while (this.places.length > 1 && this.places[1]!.at <= now - period) this.places.shift();
  }
}
