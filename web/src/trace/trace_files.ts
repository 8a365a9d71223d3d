// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A trace as files: a table (CSV), a drawing (SVG), and a label for medical viewers (NRRD: ITK-SNAP, 3D Slicer).
import { t } from '../language';
import type { Place } from '../surface';
import { gridOver, maskOf, type Grid, type TracePoint } from './trace';

export function traceCsv(points: readonly TracePoint[]): string {
  const rows = points.map(({ t, x, y }) => `${t.toFixed(4)},${x.toFixed(6)},${y.toFixed(6)}`);
  return ['t_s,x_m,y_m', ...rows, ''].join('\n');
}

/** Most points of a line. */
const mostPoints = 100_000;

/** The line in a table with the columns x_m and y_m (scene frame, metres), or an error message. */
export function readLine(csv: string): Place[] | string {
  const [head = '', ...rows] = csv.replace(/^\uFEFF/, '').split(/\r?\n/).filter((row) => row.trim() !== '');
  const columns = head.split(',').map((name) => name.trim());
  const [x, y] = [columns.indexOf('x_m'), columns.indexOf('y_m')];
  if (x < 0 || y < 0) return t('The file has no columns x_m and y_m.');
  if (rows.length < 3 || rows.length > mostPoints) return t('A line has 3 to {mostPoints} points; this one has {length}.', { mostPoints, length: rows.length });
  const points = rows.map((row) => row.split(',')).map((cells) => ({ x: Number(cells[x]?.trim() || NaN), y: Number(cells[y]?.trim() || NaN) }));
  const wrong = points.findIndex((point) => !Number.isFinite(point.x) || !Number.isFinite(point.y));
  return wrong < 0 ? points : t('Line {wrong} of the file holds no number.', { wrong: wrong + 2 });
}

/** An SVG in millimetres, y downwards, over the scene's rectangle (m). */
export function traceSvg(points: readonly TracePoint[], sizeX: number, sizeY: number): string {
  const mm = (metres: number) => Number((metres * 1000).toFixed(3));
  const [w, h] = [mm(sizeX), mm(sizeY)];
  const path = points.map(({ x, y }, k) => `${k === 0 ? 'M' : 'L'}${mm(x + sizeX / 2)} ${mm(sizeY / 2 - y)}`).join(' ');
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${w}mm" height="${h}mm" viewBox="0 0 ${w} ${h}">`,
    `<path d="${path} Z" fill="none" stroke="black" stroke-width="0.3"/>`,
    '</svg>',
    '',
  ].join('\n');
}

/** The inside as label 1, one slice, spacing in millimetres; rows go downwards, as pictures and LPS axes do. */
export function traceNrrd(points: readonly TracePoint[], sizeX: number, sizeY: number, spacing: number): Uint8Array<ArrayBuffer> {
  const grid: Grid = gridOver(sizeX, sizeY, spacing);
  const mm = spacing * 1000;
  const header = [
    'NRRD0004',
    'type: unsigned char',
    'dimension: 3',
    'space: left-posterior-superior',
    `sizes: ${grid.columns} ${grid.rows} 1`,
    `space directions: (${mm},0,0) (0,${mm},0) (0,0,1)`,
    `space origin: (${grid.left * 1000},${-grid.top * 1000},0)`,
    'encoding: raw',
    '',
    '',
  ].join('\n');
  const head = new TextEncoder().encode(header);
  const mask = maskOf(points, grid);
  const file = new Uint8Array(head.length + mask.length);
  file.set(head);
  file.set(mask, head.length);
  return file;
}
