// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the page says of the chosen probe and of the scene, when asked and while the probe moves.
import type { ProbeState } from '../generated/protocol';
import type { Probes } from '../probe/probes';
import { motionWords, noScene, positionWords, sceneWords } from '../sound/describe';
import type { Place, Surface } from '../surface';
import type { SceneFrames } from './scene_frames';

export class Narrator {
  constructor(
    private readonly frames: SceneFrames,
    private readonly probes: Probes,
    private readonly exaggeration: () => number,
  ) {}

  /** What D says. */
  describe(): string {
    const { surface, scene } = this.frames;
    if (surface === null || scene === null) return noScene;
    return sceneWords(surface, scene.name, this.exaggeration(), this.place());
  }
  /** What P says. */
  where(): string {
    const { surface } = this.frames;
    if (surface === null) return noScene;
    const { height, slope } = this.ground(surface);
    return this.probes.named(positionWords(this.place(), height, slope, this.label(), surface));
  }
  /** What the surface is like under the chosen probe. */
  motion(): string {
    const { surface } = this.frames;
    if (surface === null) return '';
    const { height, slope } = this.ground(surface);
    return motionWords(height, slope, this.label());
  }
  press(): string {
    const { press } = this.probes.own.current;
    const depth = Math.abs(press * 1000).toFixed(1);
    return press >= 0 ? `Pressed ${depth} millimetres deep` : `Lifted by ${depth} millimetres`;
  }

  place(): Place {
    return this.probes.placeOf(this.probes.own.chosen);
  }
  /** Empty where the region has no name. */
  labelOf(state: ProbeState | undefined): string {
    return (state && this.frames.scene?.labels[state.label]) ?? '';
  }

  private label(): string {
    return this.labelOf(this.probes.chosen);
  }
  private ground(surface: Surface): { height: number; slope: Place } {
    const scale = this.exaggeration();
    const slope = surface.slopeAt(this.place());
    return { height: surface.heightAt(this.place()) * scale, slope: { x: slope.x * scale, y: slope.y * scale } };
  }
}
