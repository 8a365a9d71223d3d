// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sound and vibration from the probes' motion and the servo's states.
import type { ProbeState } from '../generated/protocol';
import type { Settings } from '../settings/settings';
import type { Place, Surface } from '../surface';
import { bodyOf, gripOf, plain, type SoundingMaterial } from './instrument/material_sound';
import { contactStrength, directionOf, EdgeDetector, MotionMeter, pitchOf, RisingEdge } from './sonify';
import { Sound } from './sound';
import { browserMotors, Vibrator, type Motors } from './vibration';

/** Speed along the surface below which a probe rests (m/s, on a scene of 0.1 m): a hand at rest trembles by less. */
const leastSpeed = 2e-3;
/** Least time between two sounds of a name, for borders that are crossed back and forth (ms). */
const leastNameGap = 300;

interface Probe {
  readonly edges: EdgeDetector;
  readonly contact: RisingEdge;
  readonly motion: MotionMeter;
  label: number | null;
  namedAt: number;
  /** What its instrument sounds like now. */
  material: SoundingMaterial | null;
}

export class Feedback {
  readonly sound: Sound;
  readonly vibrator: Vibrator;
  private readonly probes = new Map<number, Probe>();
  private materials: readonly SoundingMaterial[] = [];
  private names: readonly (string | null)[] = [];

  /** `tell`: for what the person must know about the outputs, each sentence once. */
  constructor(tell: (sentence: string) => void, motors: Motors = browserMotors) {
    this.sound = new Sound(tell);
    this.vibrator = new Vibrator(motors, tell);
  }

  set({ page, materials }: Pick<Settings, 'page' | 'materials'>): void {
    this.sound.set(page);
    this.vibrator.set(page.vibration, page.gamepads);
    this.materials = materials;
  }
  /** The names of the scene's labels; null: none. */
  setNames(names: readonly (string | null)[]): void {
    this.names = names;
  }

  /** A probe has moved. */
  moved(probe: number, place: Place, surface: Surface, heightFactor: number): void {
    const { lowest, highest } = surface.range();
    const height = surface.heightAt(place);
    const from = directionOf(place, surface);
    // The pitch follows the height in engraved scenes too.
    const [low, high] = heightFactor < 0 ? [-highest, -lowest] : [lowest, highest];
    this.sound.play(probe, { what: 'height', frequency: pitchOf(heightFactor < 0 ? -height : height, low, high) }, from);
    const slope = surface.slopeAt(place);
    if (!this.of(probe).edges.crossed(Math.hypot(slope.x, slope.y) * Math.abs(heightFactor))) return;
    this.sound.play(probe, { what: 'edge' }, from);
    this.vibrator.edge(performance.now());
  }

  /** A state of a probe from the program, at the program's time `t_s`. */
  reported(state: ProbeState, surface: Surface, t_s: number): void {
    const { probe, contact, x_m, y_m, z_m, fx_N, fy_N, fz_N, label } = state;
    const known = this.of(probe);
    const now = performance.now();
    const from = directionOf({ x: x_m, y: y_m }, surface);
    const force = Math.hypot(fx_N, fy_N, fz_N);
    const speed = known.motion.at(t_s, x_m, y_m, z_m);
    // As on a scene of 0.1 m, so that models of every size sound alike.
    const along = speed.along / surface.scale;
    const material = this.materials[label] ?? plain;
    if (contact) this.setMaterial(probe, known, material, surface.scale);
    if (known.contact.rises(contact)) {
      const strength = contactStrength(force, speed.towards / surface.scale);
      this.sound.play(probe, { what: 'contact', strength }, from);
      this.vibrator.contact(strength, now);
    } else if (contact && along > leastSpeed) {
      this.sound.play(probe, { what: 'slide', speed: along, force }, from);
      const { texture } = gripOf(material);
      if (texture.kind !== 'none') this.vibrator.texture(speed.along / texture.pitch, texture.depth, now);
    }
    this.soundName(probe, known, label, now);
  }

  /** Drops the state of removed probes: of all but these. */
  removeProbesExcept(numbers: readonly number[]): void {
    for (const probe of this.probes.keys()) if (!numbers.includes(probe)) this.probes.delete(probe);
    this.sound.removeProbesExcept(numbers);
  }

  /** The material under a probe, for examples of its sound. */
  materialUnder(probe: number): SoundingMaterial {
    return this.materials[this.probes.get(probe)?.label ?? 0] ?? plain;
  }

  private setMaterial(probe: number, known: Probe, material: SoundingMaterial, scale: number): void {
    if (known.material === material) return;
    known.material = material;
    const scaled = { ...material, pitch_m: material.pitch_m / scale };
    this.sound.play(probe, { what: 'material', body: bodyOf(material), grip: gripOf(scaled) });
  }

  /** A region with a name is entered: a bell from where it is, before the name is said. */
  private soundName(probe: number, known: Probe, label: number, now: number): void {
    const entered = known.label !== null && label !== known.label && (this.names[label] ?? null) !== null;
    known.label = label;
    if (!entered || now - known.namedAt < leastNameGap) return;
    known.namedAt = now;
    this.sound.play(probe, { what: 'name' });
  }

  private of(probe: number): Probe {
    const known = this.probes.get(probe) ?? {
      edges: new EdgeDetector(),
      contact: new RisingEdge(),
      motion: new MotionMeter(),
      label: null,
      namedAt: -Infinity,
      material: null,
    };
    this.probes.set(probe, known);
    return known;
  }
}
