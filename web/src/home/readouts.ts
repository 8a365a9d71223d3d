// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the page shows in figures: status, position, height, force and its plot, rates; and the banner for what went wrong.
import { element } from '../dom';
import { figuresEvery, millimetreFigure } from '../figures';
import type { Stance } from '../probe/explorer';
import { newtons, type Felt } from '../felt';
import type { State } from '../generated/protocol';
import { ForcePlot } from './plot';

/** Milliseconds between two drawings of the plot. */
const plotEvery = 50;

export class Readouts {
  private readonly plot = new ForcePlot(element<HTMLCanvasElement>('plot'));
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');
  private frames = 0;
  private since = performance.now();
  private device = '';
  private rate = 0;
  private shown: Felt | null = null;
  private figuresAt = -Infinity;
  private plottedAt = -Infinity;

  setDevice(device: string): void {
    this.device = device;
  }

  /** `felt`: what the chosen probe feels. */
  state(state: State, felt: Felt): void {
    this.plot.add(state.t_s, newtons(felt));
    this.rate = state.rate_hz;
    this.shown = felt;
  }

  stance({ x, y, heading }: Stance): void {
    const facing = heading === 0 ? 'up' : `${Math.abs(heading)}° ${heading > 0 ? 'left' : 'right'}`;
    element('read-stance').textContent = `${millimetreFigure(x)}, ${millimetreFigure(y)}, facing ${facing}`;
  }

  /** Nothing is known any more. */
  blank(): void {
    this.rate = 0;
    this.shown = null;
    for (const id of ['read-position', 'read-height', 'read-force']) element(id).textContent = '–';
  }

  /** Once a frame. The plot creeps, so where motion is unwelcome it is drawn once a second. */
  frame(now: number): void {
    this.frames += 1;
    if (now - this.figuresAt >= figuresEvery) {
      this.figuresAt = now;
      this.figures();
    }
    if (now - this.plottedAt >= (this.calm.matches ? 1000 : plotEvery)) {
      this.plottedAt = now;
      this.plot.draw();
    }
    if (now - this.since < 1000) return;
    const shown = Math.round((this.frames * 1000) / (now - this.since));
    const parts = [`${shown} frames a second`, `force ${Math.round(this.rate)} times a second`, this.device];
    element('rates').textContent = parts.filter((part) => part !== '').join(' · ');
    element('rates').dataset.frames = String(shown);
    element('plot-words').textContent = `Greatest in the last ten seconds: ${this.plot.greatest().toFixed(2)} N.`;
    this.frames = 0;
    this.since = now;
  }

  private figures(): void {
    if (this.shown === null) return;
    const { x_m, y_m, surface_m } = this.shown;
    element('read-position').textContent = `${millimetreFigure(x_m)}, ${millimetreFigure(y_m)}`;
    element('read-height').textContent = millimetreFigure(surface_m);
    element('read-force').textContent = newtons(this.shown).toFixed(2);
  }

  status(state: 'running' | 'paused' | 'fault', words: string): void {
    element('status').textContent = words;
    element('status').dataset.state = state;
  }

  /** Shows a sentence that stays; screen readers are interrupted by it. */
  alert(sentence: string): void {
    const banner = element('banner');
    banner.textContent = sentence;
    banner.hidden = false;
  }
  allWell(): void {
    element('banner').hidden = true;
  }
}
