// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The force over the last seconds, as a line.

import { rounded, t } from '../language';

const seconds = 10;

export class ForcePlot {
  private samples: { t: number; force: number }[] = [];
  private top = 1;
  private drawnLevel = false;

  constructor(private readonly canvas: HTMLCanvasElement) {}

  add(t: number, force: number): void {
    const last = this.samples[this.samples.length - 1];
    if (last && t < last.t) this.samples = [];
    this.samples.push({ t, force });
    while (this.samples.length > 0 && this.samples[0]!.t < t - seconds) this.samples.shift();
  }

  forget(): void {
    this.samples = [];
  }

  /** Whether the line is constant and already drawn. */
  isLevel(): boolean {
    const first = this.samples[0]?.force ?? 0;
    const level = this.samples.every(({ force }) => Math.abs(force - first) < 0.005);
    const known = level && this.drawnLevel;
    this.drawnLevel = level && this.samples.length > 0;
    return known;
  }

  greatest(): number {
    return this.samples.reduce((most, { force }) => Math.max(most, force), 0);
  }

  draw(): void {
    const ratio = window.devicePixelRatio;
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    const pen = this.canvas.getContext('2d');
    if (pen === null) return;
    const style = getComputedStyle(this.canvas);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    this.top = niceTop(this.greatest());
    const left = 34;
    const [right, floor, ceiling] = [width - 6, height - 18, 8];
    const y = (force: number) => floor - ((floor - ceiling) * force) / this.top;
    pen.font = `12px ${style.fontFamily}`;
    pen.fillStyle = style.color;
    pen.strokeStyle = style.getPropertyValue('--line');
    pen.lineWidth = 1;
    pen.textBaseline = 'middle';
    pen.textAlign = 'right';
    for (const tick of [0, this.top / 2, this.top]) {
      pen.fillText(rounded(tick, 3), left - 6, y(tick));
      pen.beginPath();
      pen.moveTo(left, y(tick));
      pen.lineTo(right, y(tick));
      pen.stroke();
    }
    pen.textBaseline = 'alphabetic';
    pen.textAlign = 'left';
    pen.fillText(t('{seconds} s ago', { seconds }), left, height - 3);
    pen.textAlign = 'right';
    pen.fillText(t('now'), right, height - 3);
    this.line(pen, style.getPropertyValue('--accent'), (t) => right - ((right - left) * t) / seconds, y);
  }

  private line(pen: CanvasRenderingContext2D, colour: string, x: (age: number) => number, y: (force: number) => number): void {
    const now = this.samples[this.samples.length - 1]?.t;
    if (now === undefined) return;
    pen.beginPath();
    this.samples.forEach(({ t, force }, k) => pen[k === 0 ? 'moveTo' : 'lineTo'](x(now - t), y(force)));
    pen.strokeStyle = colour;
    pen.lineWidth = 2;
    pen.stroke();
  }
}

/** The next round number of newtons, at least 1. */
export function niceTop(force: number): number {
  const steps = [1, 2, 4, 6, 10, 20, 40, 60, 100, 200, 400, 1000];
  return steps.find((step) => force <= step) ?? 1000;
}
