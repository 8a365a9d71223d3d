// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A probe that this page moves: its target, and the marble that follows it.
import type { Place, Surface } from '../surface';
import { follow } from './marble';

/** Metres, on a scene of a tenth of a metre or more. */
const usualPress = 0.0015;
const deepest = 0.004;
const highest = -0.02;

/** Less deep on small scenes, but deep enough to be felt. */
export const pressScale = (scale: number) => Math.min(1, Math.max(0.2, scale));

export class PageProbe {
  private target: Place;
  private marblePlace: Place;
  private pressDepth = usualPress;
  private changed = false;
  private scale = 1;
  /** When this page moved it last (ms). */
  movedAt = -Infinity;
  private ledByKeys = false;

  constructor(place: Place = { x: 0, y: 0 }) {
    this.target = { ...place };
    this.marblePlace = { ...place };
  }

  /** The surface's scale; on small scenes the probe presses less deep. */
  setScale(scale: number): void {
    const press = this.pressDepth / pressScale(this.scale);
    this.scale = scale;
    this.pressDepth = press * pressScale(scale);
  }
  /** Whether it is still moving, or its place must be sent. */
  get pending(): boolean {
    return this.changed || this.target.x !== this.marblePlace.x || this.target.y !== this.marblePlace.y;
  }

  /** Whether keys moved it last, not a pointer. */
  get isByKeys(): boolean {
    return this.ledByKeys;
  }
  get place(): Place {
    return this.marblePlace;
  }
  /** Metres below the surface (positive), or above it. */
  get press(): number {
    return this.pressDepth;
  }

  /** Moves by pointer: the marble follows with a delay. */
  aim(place: Place, surface: Surface, now: number): void {
    this.target = surface.clamp(place);
    this.ledByKeys = false;
    this.movedAt = now;
  }

  /** A pen's pressure, 0 to 1, presses deeper. */
  penPressure(pressure: number): void {
    this.setPress((0.0005 + 0.003 * pressure) * pressScale(this.scale));
  }

  /** Moves by key: at once, so that each step is exact. False at the rim. */
  step(dx: number, dy: number, press: number, surface: Surface, now: number): boolean {
    const wanted = { x: this.target.x + dx, y: this.target.y + dy };
    this.put(surface.clamp(wanted));
    if (press !== 0) this.setPress(this.pressDepth + press);
    this.changed = true;
    this.ledByKeys = true;
    this.movedAt = now;
    return Math.hypot(this.target.x - wanted.x, this.target.y - wanted.y) < 1e-9;
  }

  /** Goes to a place at once, with the usual press. */
  jump(place: Place, now: number): void {
    this.put(place);
    this.setPress(usualPress * pressScale(this.scale));
    this.ledByKeys = true;
    this.movedAt = now;
  }

  /** Another page moved it: takes its place, with nothing to send. */
  adopt(place: Place): void {
    this.put(place);
    this.changed = false;
  }

  /** Requests that its place is sent again. */
  resend(): void {
    this.changed = true;
  }

  /** Advances the marble; true if its place must be sent. */
  advance(seconds: number, surface: Surface, heightFactor: number): boolean {
    const slope = surface.slopeAt(this.marblePlace);
    const before = this.marblePlace;
    this.marblePlace = follow(before, this.target, { x: slope.x * heightFactor, y: slope.y * heightFactor }, seconds);
    const moved = this.changed || before.x !== this.marblePlace.x || before.y !== this.marblePlace.y;
    this.changed = false;
    return moved;
  }

  private put(place: Place): void {
    this.target = { ...place };
    this.marblePlace = { ...place };
  }

  private setPress(press: number): void {
    const scale = pressScale(this.scale);
    this.pressDepth = Math.min(deepest * scale, Math.max(highest * Math.max(1, this.scale), press));
    this.changed = true;
  }
}
