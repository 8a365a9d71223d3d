// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The sound of sliding: noise through a low-pass filter that opens with the speed, louder with the force, and modulated by
// the texture that passes under the probe.
import { Smoothed } from './smoothed';

export interface SlidingTexture {
  /** The names of textures of the scene (grain, ridges, bumps, picture), or none. */
  kind: string;
  /** Metres from one form to the next. */
  pitch: number;
  /** How far the sound falls between two forms: 0 ... 1. */
  depth: number;
}

export interface Grip {
  /** How loud sliding is, with full force and speed: 0 ... 1; from friction. */
  roughness: number;
  /** Factor of the filter's frequency; from stiffness. */
  brightness: number;
  texture: SlidingTexture;
}

/** Forms per second above which they are heard as a steady noise. */
const fastestTexture = 800;
/** Speed (m/s) and force (N) at which sliding has half its loudness. */
const halfSpeed = 0.04;
const halfForce = 0.8;

/** The filter's frequency for a speed in m/s, Hz. */
export const cutoffOf = (speed: number, brightness: number) => Math.min(9000, (250 + 9000 * Math.min(1, speed / 0.25)) * brightness);
/** 0 ... 1, for a speed in m/s and a force in N. */
export const loudnessOf = (speed: number, force: number) => (speed / (speed + halfSpeed)) * Math.sqrt(force / (force + halfForce));

export class FrictionNoise {
  private readonly level: Smoothed;
  private readonly cutoff: Smoothed;
  private readonly rate: Smoothed;
  private readonly depth: Smoothed;
  /** What of the sound the texture lets through; smooth when one texture follows another. */
  private readonly passing: Smoothed;
  private grip: Grip = { roughness: 0.5, brightness: 1, texture: { kind: 'none', pitch: 1e-3, depth: 0 } };
  private motion = { speed: 0, force: 0 };
  /** State of the filter (a state-variable filter, which may be changed while it runs). */
  private band = 0;
  private low = 0;
  private coefficient = 0;
  private seed = 0x2f6e2b1;
  /** Place in the texture, in pitches; grain has a height of its own for each form. */
  private phase = 0;
  private grainFrom = 1;
  private grainTo = 1;
  private samples = 0;

  constructor(private readonly sampleRate: number) {
    this.level = new Smoothed(0, 0.012, sampleRate);
    this.cutoff = new Smoothed(cutoffOf(0, 1), 0.012, sampleRate);
    this.rate = new Smoothed(0, 0.012, sampleRate);
    this.depth = new Smoothed(0, 0.02, sampleRate);
    this.passing = new Smoothed(1, 2e-4, sampleRate);
  }

  setGrip(grip: Grip): void {
    this.grip = grip;
    this.aim();
  }
  /** `speed`: m/s along the surface; `force`: N. */
  slide(speed: number, force: number): void {
    this.motion = { speed, force };
    this.aim();
  }

  next(): number {
    const level = this.level.next();
    const cutoff = this.cutoff.next();
    const depth = this.depth.next();
    const rate = this.rate.next();
    if (level === 0) return 0;
    if ((this.samples & 15) === 0) this.coefficient = Math.tan((Math.PI * Math.min(cutoff, 0.4 * this.sampleRate)) / this.sampleRate);
    this.samples = (this.samples + 1) | 0;
    this.passing.target = 1 - depth * (1 - this.form(rate));
    return level * this.filtered(this.noise()) * this.passing.next();
  }

  private aim(): void {
    const { speed, force } = this.motion;
    const { roughness, brightness, texture } = this.grip;
    this.level.target = roughness * loudnessOf(speed, force);
    this.cutoff.target = cutoffOf(speed, brightness);
    this.rate.target = Math.min(fastestTexture, speed / Math.max(1e-5, texture.pitch));
    this.depth.target = texture.kind === 'none' ? 0 : texture.depth;
  }

  /** The texture's height under the probe: 0 ... 1, without a step. */
  private form(rate: number): number {
    this.phase += rate / this.sampleRate;
    if (this.phase >= 1) {
      this.phase -= 1;
      this.grainFrom = this.grainTo;
      this.grainTo = 0.5 + 0.5 * this.noise();
    }
    const wave = 0.5 - 0.5 * Math.cos(2 * Math.PI * this.phase);
    if (this.grip.texture.kind === 'ridges') return wave;
    if (this.grip.texture.kind === 'bumps') return wave * wave;
    return this.grainFrom + (this.grainTo - this.grainFrom) * (0.5 - 0.5 * Math.cos(Math.PI * this.phase));
  }

  /** -1 ... 1, equally often; the same for each instrument, so that a sound can be tested. */
  private noise(): number {
    this.seed ^= this.seed << 13;
    this.seed ^= this.seed >>> 17;
    this.seed ^= this.seed << 5;
    return this.seed / 0x80000000;
  }

  private filtered(value: number): number {
    const g = this.coefficient;
    const high = (value - (g + Math.SQRT2) * this.band - this.low) / (1 + g * (g + Math.SQRT2));
    const band = g * high + this.band;
    const low = g * band + this.low;
    this.band = g * high + band;
    this.low = g * band + low;
    return low;
  }
}
