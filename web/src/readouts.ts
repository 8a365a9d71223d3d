// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the page shows in figures: status, position, height, force and its plot, rates; and the banner for what went wrong.
import { element } from './controls';
import type { State } from './generated/protocol';
import { ForcePlot } from './plot';

const millimetres = (metres: number) => (metres * 1000).toFixed(1);

export class Readouts {
  private readonly plot = new ForcePlot(element<HTMLCanvasElement>('plot'));
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');
  private frames = 0;
  private since = performance.now();
  private device = '';
  private rate = 0;

  setDevice(device: string): void {
    this.device = device;
  }

  state(state: State): void {
    const force = Math.hypot(state.fx_N, state.fy_N, state.fz_N);
    this.plot.add(state.t_s, force);
    this.rate = state.rate_hz;
    element('read-position').textContent = `${millimetres(state.x_m)}, ${millimetres(state.y_m)}`;
    element('read-height').textContent = millimetres(state.surface_m);
    element('read-force').textContent = force.toFixed(2);
  }

  /** Nothing is known any more. */
  blank(): void {
    this.rate = 0;
    for (const id of ['read-position', 'read-height', 'read-force']) element(id).textContent = '–';
  }

  /** Once a frame. The plot creeps, so where motion is unwelcome it is drawn once a second. */
  frame(now: number): void {
    this.frames += 1;
    const second = now - this.since >= 1000;
    if (second || !this.calm.matches) this.plot.draw();
    if (!second) return;
    const shown = Math.round((this.frames * 1000) / (now - this.since));
    const parts = [`${shown} frames a second`, `force ${Math.round(this.rate)} times a second`, this.device];
    element('rates').textContent = parts.filter((part) => part !== '').join(' · ');
    element('rates').dataset.frames = String(shown);
    element('plot-words').textContent = `Greatest in the last ten seconds: ${this.plot.greatest().toFixed(2)} N.`;
    this.frames = 0;
    this.since = now;
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
