// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The tone whose pitch is the height under the probe.
import { Smoothed } from './smoothed';

/** The tone fades out after the probe has rested this long (s): silence means no motion. */
export const restTime = 1.2;
/** Amplitudes of the first partials: a pure tone could not be placed by ear. */
const partials = [1, 0.3, 0.12];

export class HeightTone {
  /** Octaves above 1 Hz: equal steps of it are heard as equal. */
  private readonly octave: Smoothed;
  private readonly level: Smoothed;
  private readonly fade: Smoothed;
  private phase = 0;
  private rested = 0;
  private sounds = false;

  constructor(private readonly sampleRate: number) {
    this.octave = new Smoothed(Math.log2(220), 0.015, sampleRate);
    this.level = new Smoothed(0, 0.02, sampleRate);
    this.fade = new Smoothed(0, 0.15, sampleRate);
  }

  /** `frequency`: Hz. */
  play(frequency: number): void {
    const octave = Math.log2(Math.min(8000, Math.max(20, frequency)));
    if (this.sounds) this.octave.target = octave;
    else this.octave.jump(octave);
    this.level.target = 1;
    if (!this.sounds) this.fade.jump(1);
    this.fade.target = 1;
    this.sounds = true;
    this.rested = 0;
  }
  stop(): void {
    this.level.target = 0;
  }

  next(): number {
    if (!this.sounds) return 0;
    this.rested += 1;
    if (this.rested > restTime * this.sampleRate) this.fade.target = 0;
    const level = this.level.next() * this.fade.next();
    // Inaudible: the next tone begins at its own pitch.
    if (level < 1e-6 && this.fade.target * this.level.target === 0) {
      this.sounds = false;
      this.level.jump(0);
    }
    this.phase += 2 ** this.octave.next() / this.sampleRate;
    if (this.phase >= 1) this.phase -= 1;
    let sum = 0;
    for (let k = 0; k < partials.length; ++k) sum += partials[k]! * Math.sin(2 * Math.PI * (k + 1) * this.phase);
    return level * sum;
  }
}
