// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The panel for tracing contours: cue, clock, picture of the trace, score and files.
import { fixed, t } from '../language';
import { element } from '../dom';
import { download } from '../download';
import type { Place } from '../surface';
import { gridOver, maskOf, scoreOf, Tracer, turnOf, type TracePoint, type Turn } from './trace';
import { readLine, traceCsv, traceNrrd, traceSvg } from './trace_files';

export interface TraceSetting {
  /** The selected probe's place. */
  place(): Place;
  say(words: string): void;
  /** Draws the trace on the scene. */
  overlay(points: readonly Place[]): void;
}

/** Size of a label's pixels (m). */
const labelSpacing = 0.0002;
const redrawEvery = 50;

const turnWords: Record<Turn, string> = { clockwise: t('clockwise'), 'counter-clockwise': t('counter-clockwise') };

export class TracePanel {
  private readonly canvas = element<HTMLCanvasElement>('trace-picture');
  private tracer: Tracer | null = null;
  private trace: readonly TracePoint[] = [];
  private nominal: readonly Place[] = [];
  private size = { x: 0.1, y: 0.1 };
  private drawnAt = -Infinity;

  constructor(private readonly setting: TraceSetting) {
    element('trace-start').addEventListener('click', () => (this.tracer ? this.finish() : this.begin()));
    element('trace-nominal').addEventListener('click', () => this.compareWithThis());
    element('trace-load').addEventListener('change', ({ target }) => void this.load(target as HTMLInputElement));
    element('trace-overlay').addEventListener('change', () => this.draw());
    const save = (id: string, file: string, type: string, content: () => string | Uint8Array<ArrayBuffer>) =>
      element(id).addEventListener('click', () => download(file, new Blob([content()], { type })));
    save('trace-csv', 'trace.csv', 'text/csv', () => traceCsv(this.trace));
    save('trace-svg', 'trace.svg', 'image/svg+xml', () => traceSvg(this.trace, this.size.x, this.size.y));
    element('trace-png').addEventListener('click', () => void maskPicture(this.trace, this.size.x, this.size.y).then((png) => png && download('trace.png', png)));
    save('trace-nrrd', 'trace.nrrd', 'application/octet-stream', () =>
      traceNrrd(this.trace, this.size.x, this.size.y, labelSpacing),
    );
  }

  /** Only scenes of contours are traced. */
  scene(kind: string, sizeX: number, sizeY: number): void {
    this.size = { x: sizeX, y: sizeY };
    element('trace').hidden = kind !== 'contours';
    this.canvas.style.aspectRatio = `${sizeX} / ${sizeY}`;
  }

  get running(): boolean {
    return this.tracer !== null;
  }

  /** Once a frame while a trace runs. */
  frame(now: number): void {
    if (this.tracer === null) return;
    if (this.tracer.add(this.setting.place(), now / 1000)) return this.finish();
    if (now - this.drawnAt < redrawEvery) return;
    this.drawnAt = now;
    this.trace = this.tracer.points;
    element('trace-words').textContent = t('{seconds} s', { seconds: fixed(this.tracer.seconds(), 1) });
    this.draw();
  }

  private begin(): void {
    this.tracer = new Tracer(this.setting.place());
    this.trace = [];
    element('trace-start').textContent = t('Stop trace');
    this.enable(false);
    this.setting.say(t('Go.'));
    this.draw();
  }

  private finish(): void {
    if (this.tracer === null) return;
    const closed = this.tracer.isClosed();
    this.trace = [...this.tracer.points];
    this.tracer = null;
    element('trace-start').textContent = t('Start trace');
    this.enable(this.trace.length > 1);
    const words = this.words(closed);
    element('trace-words').textContent = words;
    this.setting.say(words);
    this.draw();
  }

  private words(closed: boolean): string {
    const last = this.trace[this.trace.length - 1];
    if (last === undefined) return t('The trace is empty.');
    const turn = turnOf(this.trace);
    const wanted = element<HTMLSelectElement>('trace-turn').value;
    const seconds = fixed(last.t, 1);
    const parts = [closed ? t('Closed, {turn}, {seconds} seconds', { turn: turnWords[turn], seconds }) : t('Not closed, {seconds} seconds', { seconds })];
    if (closed && wanted !== 'either' && wanted !== turn) parts.push(t('in the opposite direction to the requested one ({wanted})', { wanted: turnWords[wanted as Turn] }));
    const score = closed && this.nominal.length > 2 ? scoreOf(this.trace, this.nominal, this.size.x, this.size.y) : null;
    if (score) parts.push(t('error {error} percent, roughness {roughness} degrees a millimetre', { error: fixed(100 * score.error, 1), roughness: fixed(score.roughness, 1) }));
    return `${parts.join('; ')}.`;
  }

  private compareWithThis(): void {
    this.nominal = this.trace;
    this.setting.say(t('Further traces are compared with this one.'));
    this.draw();
  }

  /** Reads a nominal line drawn by an expert. */
  private async load(input: HTMLInputElement): Promise<void> {
    const file = input.files?.[0];
    if (file === undefined) return;
    const line = readLine(await file.text());
    if (typeof line === 'string') return this.setting.say(line);
    this.nominal = line;
    this.setting.say(t('Traces are compared with {name}.', { name: file.name }));
    this.draw();
  }

  private enable(there: boolean): void {
    for (const id of ['trace-nominal', 'trace-csv', 'trace-svg', 'trace-png', 'trace-nrrd']) element<HTMLButtonElement>(id).disabled = !there;
  }

  private draw(): void {
    this.setting.overlay(element<HTMLInputElement>('trace-overlay').checked ? this.trace : []);
    const ratio = window.devicePixelRatio;
    const { clientWidth, clientHeight } = this.canvas;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    const pen = this.canvas.getContext('2d');
    if (pen === null || clientWidth === 0) return;
    const style = getComputedStyle(this.canvas);
    const scale = this.canvas.width / this.size.x;
    const line = (points: readonly Place[], colour: string, width: number) => {
      pen.beginPath();
      points.forEach(({ x, y }, k) => pen[k === 0 ? 'moveTo' : 'lineTo']((x + this.size.x / 2) * scale, (this.size.y / 2 - y) * scale));
      pen.lineWidth = width * ratio;
      pen.strokeStyle = colour;
      pen.stroke();
    };
    line(this.nominal, style.color, 1);
    line(this.trace, style.getPropertyValue('--accent'), 2);
  }
}

/** The inside white on black. */
function maskPicture(trace: readonly Place[], sizeX: number, sizeY: number): Promise<Blob | null> {
  const grid = gridOver(sizeX, sizeY, labelSpacing);
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [grid.columns, grid.rows];
  const pen = canvas.getContext('2d');
  if (pen === null) return Promise.resolve(null);
  const pixels = pen.createImageData(grid.columns, grid.rows);
  maskOf(trace, grid).forEach((inside, k) => pixels.data.set([255 * inside, 255 * inside, 255 * inside, 255], 4 * k));
  pen.putImageData(pixels, 0, 0);
  return new Promise((resolve) => canvas.toBlob(resolve, 'image/png'));
}
