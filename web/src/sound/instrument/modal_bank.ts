// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Modal synthesis: a struck body as a sum of decaying sinusoids, one resonator for each mode (van den Doel & Pai 1998).

export interface Mode {
  /** Hz. */
  frequency: number;
  /** Time constant: its amplitude falls by 1/e in this time (s). */
  decay: number;
  /** Its part of the amplitude. */
  gain: number;
}

/** What is struck. */
export interface Body {
  modes: readonly Mode[];
  /** How long a hard blow of full strength touches (s): the longer, the duller. */
  contactTime: number;
}

export const mostModes = 8;

/**
 * Each mode is a complex number that turns and shrinks; the sound is the sum of the imaginary parts. A blow is a raised
 * cosine of force, added to the real parts. So neither a blow nor a change of the modes makes a step in the sound.
 */
export class ModalBank {
  private readonly real = new Float64Array(mostModes);
  private readonly imaginary = new Float64Array(mostModes);
  private readonly cosine = new Float64Array(mostModes);
  private readonly sine = new Float64Array(mostModes);
  private readonly gain = new Float64Array(mostModes);
  private count = 0;
  private contactTime = 1e-3;
  /** The blow: samples that have passed, its length, and its whole impulse. */
  private passed = 0;
  private length = 0;
  private impulse = 0;

  constructor(private readonly sampleRate: number) {}

  /**
   * At most `mostModes`. What sounds goes on with the new frequencies; a mode that the new body lacks rings out. Modes at
   * or above nine tenths of half the sample rate are not struck.
   */
  setBody({ modes, contactTime }: Body): void {
    this.gain.fill(0);
    modes.slice(0, mostModes).forEach(({ frequency, decay, gain }, i) => {
      const highest = 0.45 * this.sampleRate;
      const shrink = Math.exp(-1 / (Math.max(1e-3, decay) * this.sampleRate));
      const angle = (2 * Math.PI * Math.min(frequency, highest)) / this.sampleRate;
      this.cosine[i] = shrink * Math.cos(angle);
      this.sine[i] = shrink * Math.sin(angle);
      this.gain[i] = frequency < highest ? gain : 0;
    });
    this.count = Math.max(this.count, Math.min(mostModes, modes.length));
    this.contactTime = contactTime;
  }

  /** `strength`: 0 ... 1. Gentle blows touch longer, so they are duller too (Hertz: as speed to the power -1/5). */
  strike(strength: number): void {
    if (!(strength > 0)) return;
    this.length = Math.max(8, Math.round(this.contactTime * strength ** -0.2 * this.sampleRate));
    this.passed = 0;
    this.impulse = strength;
  }

  next(): number {
    let blow = 0;
    if (this.passed < this.length) {
      this.passed += 1;
      blow = (this.impulse / this.length) * (1 - Math.cos((2 * Math.PI * this.passed) / this.length));
    }
    let sum = 0;
    for (let i = 0; i < this.count; ++i) {
      const re = this.real[i]! + this.gain[i]! * blow;
      const im = this.imaginary[i]!;
      this.real[i] = re * this.cosine[i]! - im * this.sine[i]!;
      this.imaginary[i] = re * this.sine[i]! + im * this.cosine[i]!;
      sum += this.imaginary[i]!;
    }
    return sum;
  }

  /** Once for each block: values that cannot be heard are set to zero, since denormal numbers are slow. */
  settle(): void {
    for (let i = 0; i < mostModes; ++i) {
      if (i < this.count && Math.abs(this.real[i]!) + Math.abs(this.imaginary[i]!) > 1e-9) continue;
      this.real[i] = this.imaginary[i] = 0;
    }
  }
}
