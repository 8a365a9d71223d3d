// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The displayed figures: status, position, height, force and its plot, rates; and the banner for errors.
import { fixed, t } from '../language';
import { element } from '../dom';
import { figuresEvery, millimetreFigure } from '../figures';
import type { ProbeState, State } from '../generated/protocol';
import type { ExplorerPose } from '../probe/explorer';
import { newtons } from '../probe/probes';
import { setSent } from '../sent_language';
import type { Place } from '../surface';
import { ForcePlot } from './plot';

/** Milliseconds between two drawings of the plot; and with reduced motion. */
const plotEvery = 100;
const calmPlotEvery = 1000;

export class Readouts {
  private readonly plot = new ForcePlot(element<HTMLCanvasElement>('plot'));
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');
  private device = '';
  /** Of the surface. */
  scale = 1;
  private middle: Place = { x: 0, y: 0 };
  private rate = 0;
  private shown: ProbeState | null = null;
  private renewing = false;
  private plottedAt = -Infinity;

  constructor() {
    new ResizeObserver(() => this.plot.draw()).observe(element('plot'));
  }

  setDevice(device: string): void {
    this.device = device;
  }

  /** Positions are told from there, as in words. */
  setMiddle(middle: Place): void {
    this.middle = middle;
  }

  /** Names the coordinate towards the person: of an upright solid it is not a height. */
  setUpright(upright: boolean): void {
    for (const id of ['read-height-name', 'probe-height-name']) write(id, upright ? t('Towards you, mm') : t('Height, mm'));
  }

  /** Takes a new tick; `probe`: the selected one. Shown a little later, at a readable rate. */
  state(state: State, probe: ProbeState | undefined): void {
    if (probe === undefined) return;
    this.plot.add(state.t_s, newtons(probe));
    this.rate = state.rate_hz;
    this.shown = probe;
    if (this.renewing) return;
    this.renewing = true;
    setTimeout(() => {
      this.renewing = false;
      this.renew(performance.now());
    }, figuresEvery);
  }

  /** What comes does not follow what was shown. */
  jump(): void {
    this.plot.forget();
  }

  /** Redraws in the current colours. */
  redraw(): void {
    this.plot.draw();
  }

  pose({ x, y, heading }: ExplorerPose): void {
    const facing = heading === 0 ? t('up') : heading > 0 ? t('{heading}° left', { heading }) : t('{heading}° right', { heading: -heading });
    write('read-pose', t('{x}, {y}, facing {facing}', { x: millimetreFigure(x), y: millimetreFigure(y), facing }));
  }

  /** Clears all figures. */
  blank(): void {
    this.rate = 0;
    this.shown = null;
    this.plot.forget();
    for (const id of ['read-position', 'read-height', 'read-force']) write(id, '–');
    write('rates', this.device);
    write('plot-words', t('No force.'));
    this.plot.draw();
  }

  status(state: 'running' | 'paused' | 'fault', words: string): void {
    write('status', words);
    element('status').dataset.state = state;
  }

  /** Shows a persistent sentence, which interrupts screen readers. */
  alert(sentence: string): void {
    const banner = element('banner');
    if (banner.textContent !== sentence) setSent(banner, sentence);
    banner.hidden = false;
  }
  allWell(): void {
    element('banner').hidden = true;
  }

  private renew(now: number): void {
    if (this.shown === null) return;
    const { x_m, y_m, surface_m } = this.shown;
    write('read-position', t('{x}, {y}', { x: millimetreFigure(x_m - this.middle.x, this.scale), y: millimetreFigure(y_m - this.middle.y, this.scale) }));
    write('read-height', millimetreFigure(surface_m, this.scale));
    write('read-force', fixed(newtons(this.shown), 2));
    // Rounded, so that it changes rarely: each change is drawn.
    const parts = [this.rate > 0 ? t('Force {rate} times a second', { rate: 10 * Math.round(this.rate / 10) }) : '', this.device];
    write('rates', parts.filter((part) => part !== '').join(' · '));
    write('plot-words', t('Greatest in the last ten seconds: {greatest} N.', { greatest: fixed(this.plot.greatest(), 2) }));
    if (now - this.plottedAt < (this.calm.matches ? calmPlotEvery : plotEvery) || this.plot.isLevel()) return;
    this.plottedAt = now;
    this.plot.draw();
  }
}

/** Writes only differences: a change costs a layout and moves a reading cursor. */
function write(id: string, text: string): void {
  const target = element(id);
  if (target.textContent !== text) target.textContent = text;
}
