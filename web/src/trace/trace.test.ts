// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Place } from '../surface';
import { gridOver, maskOf, roughnessOf, scoreOf, signedArea, Tracer, turnOf, type TracePoint } from './trace';
import { readLine, traceCsv, traceNrrd, traceSvg } from './trace_files';

const circle = (radius: number, x = 0, y = 0, count = 400): TracePoint[] =>
  Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return { x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle), t: k / 100 };
  });

describe('a trace', () => {
  const walked = (places: Place[]) => {
    const tracer = new Tracer(places[0]!);
    return { tracer, closedAt: places.findIndex((place, k) => tracer.add(place, 5 + k / 100)) };
  };
  it('starts its clock with the first movement after the cue', () => {
    const tracer = new Tracer({ x: 0, y: 0 });
    for (let k = 0; k < 100; ++k) tracer.add({ x: 0.0001 * (k % 2), y: 0 }, k);
    expect(tracer.points).toEqual([]);
    tracer.add({ x: 0.001, y: 0 }, 200);
    tracer.add({ x: 0.002, y: 0 }, 203);
    expect(tracer.seconds()).toBe(3);
    expect(tracer.points[0]).toEqual({ x: 0, y: 0, t: 0 });
  });
  it('closes at its start, but not while leaving it', () => {
    const { tracer, closedAt } = walked(circle(0.02));
    expect(closedAt).toBeGreaterThan(350);
    expect(tracer.isClosed()).toBe(true);
    expect(walked(circle(0.02).slice(0, 300)).closedAt).toBe(-1);
    expect(walked(circle(0.001)).closedAt).toBe(-1);
  });
  it('has an orientation', () => {
    expect(turnOf(circle(0.02))).toBe('counter-clockwise');
    expect(turnOf(circle(0.02).reverse())).toBe('clockwise');
    expect(signedArea(circle(0.02))).toBeCloseTo(Math.PI * 0.02 ** 2, 6);
  });
});

describe('the score', () => {
  it('is the area between the lines over the area inside', () => {
    const nominal = circle(0.02);
    expect(scoreOf(nominal, nominal, 0.1, 0.1)!.error).toBe(0);
    expect(scoreOf(circle(0.022), nominal, 0.1, 0.1)!.error).toBeCloseTo(1.1 ** 2 - 1, 2);
    expect(scoreOf(circle(0.018), nominal, 0.1, 0.1)!.error).toBeCloseTo(1 - 0.9 ** 2, 2);
    expect(scoreOf(circle(0.02, 0.03), circle(0.02, -0.03), 0.12, 0.1)!.error).toBeCloseTo(2, 2);
  });
  it('does not depend on a line\'s start or direction', () => {
    const shifted = [...circle(0.022).slice(100), ...circle(0.022).slice(0, 100)].reverse();
    expect(scoreOf(shifted, circle(0.02), 0.1, 0.1)!.error).toBe(scoreOf(circle(0.022), circle(0.02), 0.1, 0.1)!.error);
  });
  it('is null for lines that enclose nothing', () => {
    const line = [{ x: 0, y: 0, t: 0 }, { x: 0.01, y: 0, t: 1 }];
    expect(scoreOf(line, circle(0.02), 0.1, 0.1)).toBeNull();
    expect(scoreOf(circle(0.02), line, 0.1, 0.1)).toBeNull();
  });
  it('has a larger roughness for a trembling line', () => {
    const round = circle(0.02);
    const trembling = round.map(({ x, y, t }, k) => ({ x: x * (1 + 0.004 * (k % 2)), y: y * (1 + 0.004 * (k % 2)), t }));
    expect(roughnessOf(round)).toBeCloseTo(360 / (2 * Math.PI * 20), 1);
    expect(roughnessOf(trembling)).toBeGreaterThan(5 * roughnessOf(round));
  });
});

describe('files of a trace', () => {
  const square: TracePoint[] = [
    { x: -0.01, y: -0.01, t: 0 },
    { x: 0.01, y: -0.01, t: 1 },
    { x: 0.01, y: 0.01, t: 2 },
    { x: -0.01, y: 0.01, t: 3 },
  ];
  it('contain the points', () => {
    expect(traceCsv(square).split('\n').slice(0, 3)).toEqual(['t_s,x_m,y_m', '0.0000,-0.010000,-0.010000', '1.0000,0.010000,-0.010000']);
    expect(traceSvg(square, 0.1, 0.08)).toContain('d="M40 50 L60 50 L60 30 L40 30 Z"');
  });
  it('contain the inside as a label, upright and to scale', () => {
    const low: TracePoint[] = square.map(({ x, y, t }) => ({ x, y: y - 0.02, t }));
    const file = traceNrrd(low, 0.1, 0.08, 0.001);
    const text = new TextDecoder('latin1').decode(file);
    const begin = text.indexOf('\n\n') + 2;
    expect(text.slice(0, begin)).toContain('sizes: 100 80 1');
    const mask = file.slice(begin);
    expect(mask).toHaveLength(8000);
    expect(mask.reduce((sum, v) => sum + v, 0)).toBe(400);
    expect(mask[(40 + 20) * 100 + 50]).toBe(1);
    expect(mask[(40 - 20) * 100 + 50]).toBe(0);
  });
  it('exclude a loop within a loop', () => {
    const inner = square.map(({ x, y }) => ({ x: x / 2, y: y / 2 }));
    const ring = [...square, square[0]!, ...inner, inner[0]!];
    expect(maskOf(ring, gridOver(0.1, 0.1, 0.001)).reduce((sum, v) => sum + v, 0)).toBe(300);
  });
  it('read saved files back, and report errors of others', () => {
    const line = readLine(traceCsv(circle(0.02)));
    expect(line).toHaveLength(400);
    expect((line as Place[])[100]!.y).toBeCloseTo(0.02, 5);
    expect(readLine('x_px,y_px,x_m,y_m\r\n1,2,0.01,0.02\r\n1,2,0.02,0.02\r\n1,2,0.02,0.03\r\n')).toHaveLength(3);
    expect(readLine('a,b\n1,2\n')).toMatch(/no columns/);
    expect(readLine('x_m,y_m\n1,2\n')).toMatch(/3 to/);
    expect(readLine('x_m,y_m\n1,2\n,2\n3,4\n')).toMatch(/Line 3/);
  });
});
