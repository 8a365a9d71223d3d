// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Turns the probe's motion and the servo's states into sound and vibration.
import type { State } from './generated/protocol';
import type { Preferences } from './preferences';
import { EdgeDetector, panOf, pitchOf, RisingEdge } from './sonify';
import { Sound } from './sound';
import type { Place, Surface } from './surface';
import { pulse } from './vibration';

export class Feedback {
  readonly sound = new Sound();
  private readonly edges = new EdgeDetector();
  private readonly contact = new RisingEdge();
  private vibration = false;

  set({ sound, volume, vibration }: Preferences): void {
    this.sound.set(sound, volume);
    this.vibration = vibration;
  }

  /** The probe has come to another place. */
  moved(place: Place, surface: Surface, exaggeration: number): void {
    const { lowest, highest } = surface.range();
    const height = surface.heightAt(place);
    const pan = panOf(place.x, surface.width);
    // Engraved scenes sound low where they are deep, as raised ones do.
    const [from, to] = exaggeration < 0 ? [-highest, -lowest] : [lowest, highest];
    this.sound.height(pitchOf(exaggeration < 0 ? -height : height, from, to), pan);
    const slope = surface.slopeAt(place);
    if (!this.edges.crossed(Math.hypot(slope.x, slope.y) * Math.abs(exaggeration))) return;
    this.sound.edge(pan);
    if (this.vibration) pulse(15, 0.4);
  }

  state(state: State, surface: Surface): void {
    if (!this.contact.rises(state.contact)) return;
    this.sound.click(panOf(state.x_m, surface.width));
    if (this.vibration) pulse(25, 0.8);
  }
}
