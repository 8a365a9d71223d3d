// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A probe that this page moves: its target, and the marble that follows it.
import { follow } from './marble';
import type { Place, Surface } from '../surface';

const usualPress = 0.0015;
const deepest = 0.004;
const highest = -0.02;

export class PageProbe {
  private target: Place;
  private marblePlace: Place;
  private pressDepth = usualPress;
  private changed = true;

  constructor(place: Place = { x: 0, y: 0 }) {
    this.target = { ...place };
    this.marblePlace = { ...place };
  }

  get place(): Place {
    return this.marblePlace;
  }
  /** Metres below the surface (positive), or above it. */
  get press(): number {
    return this.pressDepth;
  }

  /** By pointer: the marble follows in its own time. */
  aim(place: Place, surface: Surface): void {
    this.target = surface.clamp(place);
  }

  /** A pen's pressure, 0 to 1, presses deeper. */
  penPressure(pressure: number): void {
    this.setPress(0.0005 + 0.003 * pressure);
  }

  /** By key: there at once, so that a step is a step. False at the rim. */
  step(dx: number, dy: number, press: number, surface: Surface): boolean {
    const wanted = { x: this.target.x + dx, y: this.target.y + dy };
    this.target = surface.clamp(wanted);
    this.marblePlace = { ...this.target };
    if (press !== 0) this.setPress(this.pressDepth + press);
    this.changed = true;
    return Math.hypot(this.target.x - wanted.x, this.target.y - wanted.y) < 1e-9;
  }

  recentre(): void {
    this.target = { x: 0, y: 0 };
    this.marblePlace = { x: 0, y: 0 };
    this.setPress(usualPress);
  }

  /** Its place is sent again, wherever it is. */
  resend(): void {
    this.changed = true;
  }

  /** Moves the marble on; true if its place has to be sent. */
  advance(seconds: number, surface: Surface, exaggeration: number): boolean {
    const slope = surface.slopeAt(this.marblePlace);
    const before = this.marblePlace;
    this.marblePlace = follow(before, this.target, { x: slope.x * exaggeration, y: slope.y * exaggeration }, seconds);
    const moved = this.changed || before.x !== this.marblePlace.x || before.y !== this.marblePlace.y;
    this.changed = false;
    return moved;
  }

  private setPress(depth: number): void {
    this.pressDepth = Math.min(deepest, Math.max(highest, depth));
    this.changed = true;
  }
}
