// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sound and vibration from the probes' motion and the servo's states.
import type { ProbeState } from '../generated/protocol';
import type { Preferences } from '../settings/preferences';
import { EdgeDetector, panOf, pitchOf, RisingEdge } from './sonify';
import { Sound } from './sound';
import type { Place, Surface } from '../surface';
import { vibrateGamepads, vibratePhone } from './vibration';

export class Feedback {
  readonly sound = new Sound();
  private readonly probes = new Map<number, { edges: EdgeDetector; contact: RisingEdge }>();
  private vibration = false;
  private gamepads = false;

  set({ sound, volume, vibration, gamepads }: Preferences): void {
    this.sound.set(sound, volume);
    this.vibration = vibration;
    this.gamepads = gamepads;
  }

  /** A probe has moved. */
  moved(probe: number, place: Place, surface: Surface, heightFactor: number): void {
    const { lowest, highest } = surface.range();
    const height = surface.heightAt(place);
    const pan = panOf(place.x, surface.sizeX);
    // The pitch follows the height in engraved scenes too.
    const [from, to] = heightFactor < 0 ? [-highest, -lowest] : [lowest, highest];
    this.sound.height(probe, pitchOf(heightFactor < 0 ? -height : height, from, to), pan);
    const slope = surface.slopeAt(place);
    if (!this.of(probe).edges.crossed(Math.hypot(slope.x, slope.y) * Math.abs(heightFactor))) return;
    this.sound.edge(pan);
    this.pulse(15, 0.4);
  }

  /** A state of a probe from the program. */
  reported({ probe, contact, x_m }: ProbeState, surface: Surface): void {
    if (!this.of(probe).contact.rises(contact)) return;
    this.sound.click(panOf(x_m, surface.sizeX));
    this.pulse(25, 0.8);
  }

  /** Drops the state of removed probes: of all but these. */
  removeProbesExcept(numbers: readonly number[]): void {
    for (const probe of this.probes.keys()) if (!numbers.includes(probe)) this.probes.delete(probe);
    this.sound.removeTonesExcept(numbers);
  }

  private pulse(milliseconds: number, strength: number): void {
    if (this.vibration) vibratePhone(milliseconds);
    if (this.gamepads) vibrateGamepads(milliseconds, strength);
  }

  private of(probe: number): { edges: EdgeDetector; contact: RisingEdge } {
    const known = this.probes.get(probe) ?? { edges: new EdgeDetector(), contact: new RisingEdge() };
    this.probes.set(probe, known);
    return known;
  }
}
