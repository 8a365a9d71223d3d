// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The relief in words, worked out from its heights: what stands where, and where the probe is.
import { Surface, type Place } from '../surface';

export interface Peak extends Place {
  height: number;
  /** How far one must go down before going up to anything higher, metres. */
  prominence: number;
}

const millimetres = (metres: number, digits = 0) => {
  const text = (metres * 1000).toFixed(digits);
  const clean = /^-0(\.0+)?$/.test(text) ? text.slice(1) : text;
  return `${clean} ${clean === '1' ? 'millimetre' : 'millimetres'}`;
};

/** What is said where there is nothing to describe. */
export const noScene = 'There is no scene yet.';

/** "upper left", "centre", …: which ninth of the rectangle a place is in. */
export function regionOf({ x, y }: Place, width: number, depth: number): string {
  const column = x < -width / 6 ? 'left' : x > width / 6 ? 'right' : '';
  const row = y > depth / 6 ? 'upper' : y < -depth / 6 ? 'lower' : '';
  if (row === '' && column === '') return 'centre';
  if (row === '') return `middle ${column}`;
  return column === '' ? `${row} middle` : `${row} ${column}`;
}

/** "32 millimetres left, 12 millimetres up"; "here" within half a millimetre. */
export function offsetWords(dx: number, dy: number): string {
  const part = (value: number, positive: string, negative: string) =>
    Math.abs(value) < 0.0005 ? [] : [`${millimetres(Math.abs(value))} ${value > 0 ? positive : negative}`];
  const parts = [...part(dx, 'right', 'left'), ...part(dy, 'up', 'down')];
  return parts.length > 0 ? parts.join(', ') : 'here';
}

const fromMiddle = (place: Place) => {
  const words = offsetWords(place.x, place.y);
  return words === 'here' ? 'at the middle' : `${words} from the middle`;
};

const compass = ['right', 'upper right', 'top', 'upper left', 'left', 'lower left', 'bottom', 'lower right'];

/** "rising to the upper right", with how steeply; "level" where it hardly does. */
export function slopeWords({ x, y }: Place): string {
  const steepness = Math.hypot(x, y);
  if (steepness < 0.03) return 'level';
  const direction = compass[(Math.round(Math.atan2(y, x) / (Math.PI / 4)) + 8) % 8];
  const how = steepness > 0.8 ? 'steeply ' : steepness < 0.15 ? 'gently ' : '';
  return `rising ${how}to the ${direction}`;
}

/** Every summit with its prominence, highest first: heights are flooded from the top, and basins meet at saddles. */
export function peaksOf(surface: Surface, leastProminence: number): Peak[] {
  const coarse = thinned(surface, 96);
  const { columns, rows, heights } = coarse;
  const order = Array.from(heights.keys()).sort((a, b) => heights[b]! - heights[a]! || a - b);
  const basin = new Int32Array(heights.length).fill(-1);
  const root = (cell: number): number => {
    let top = cell;
    while (basin[top] !== top) top = basin[top]!;
    while (basin[cell] !== top) [basin[cell], cell] = [top, basin[cell]!];
    return top;
  };
  const lowest = heights[order[order.length - 1]!]!;
  const peaks: Peak[] = [];
  const close = (summit: number, saddle: number) => {
    const prominence = heights[summit]! - saddle;
    if (prominence < leastProminence) return;
    const place = { x: coarse.xOf(summit % columns), y: coarse.yOf(Math.floor(summit / columns)) };
    peaks.push({ ...highestNear(surface, place, coarse.width / columns), prominence });
  };
  for (const cell of order) {
    basin[cell] = cell;
    const [column, row] = [cell % columns, Math.floor(cell / columns)];
    for (const [i, j] of [[column - 1, row], [column + 1, row], [column, row - 1], [column, row + 1]] as const) {
      const other = j * columns + i;
      if (i < 0 || j < 0 || i >= columns || j >= rows || basin[other] === -1) continue;
      const [a, b] = [root(cell), root(other)];
      if (a === b) continue;
      const [keeps, ends] = heights[a]! > heights[b]! || (heights[a]! === heights[b]! && a < b) ? [a, b] : [b, a];
      close(ends, heights[cell]!);
      basin[ends] = keeps;
    }
  }
  close(order[0]!, lowest);
  return peaks.sort((a, b) => b.height - a.height);
}

/** The highest sample of the whole raster within a distance along each axis. */
function highestNear(surface: Surface, { x, y }: Place, distance: number): Place & { height: number } {
  const column = Math.round((x / surface.width + 0.5) * surface.columns - 0.5);
  const row = Math.round((0.5 - y / surface.depth) * surface.rows - 0.5);
  const reach = Math.ceil((distance * surface.columns) / surface.width);
  let best = { x, y, height: -Infinity };
  for (let j = Math.max(0, row - reach); j <= Math.min(surface.rows - 1, row + reach); ++j)
    for (let i = Math.max(0, column - reach); i <= Math.min(surface.columns - 1, column + reach); ++i)
      if (surface.at(i, j) > best.height) best = { x: surface.xOf(i), y: surface.yOf(j), height: surface.at(i, j) };
  return best;
}

function thinned(surface: Surface, longest: number): Surface {
  const step = Math.ceil(Math.max(surface.columns, surface.rows) / longest);
  if (step === 1) return surface;
  const [columns, rows] = [Math.ceil(surface.columns / step), Math.ceil(surface.rows / step)];
  const heights = new Float32Array(columns * rows);
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const x = ((i + 0.5) / columns - 0.5) * surface.width;
      const y = (0.5 - (j + 0.5) / rows) * surface.depth;
      heights[j * columns + i] = surface.heightAt({ x, y });
    }
  return new Surface(columns, rows, heights, surface.width, surface.depth);
}

/** The highest sample itself, not of a thinned raster. */
export function highestOf(surface: Surface): Place & { height: number } {
  let best = 0;
  surface.heights.forEach((z, k) => {
    if (z > surface.heights[best]!) best = k;
  });
  const place = { x: surface.xOf(best % surface.columns), y: surface.yOf(Math.floor(best / surface.columns)) };
  return { ...place, height: surface.heights[best]! };
}

function meanHeight(surface: Surface, column: number, row: number): number {
  let [sum, count] = [0, 0];
  for (let j = Math.floor((row * surface.rows) / 3); j < Math.floor(((row + 1) * surface.rows) / 3); ++j)
    for (let i = Math.floor((column * surface.columns) / 3); i < Math.floor(((column + 1) * surface.columns) / 3); ++i) {
      sum += surface.at(i, j);
      ++count;
    }
  return count > 0 ? sum / count : surface.at(0, 0);
}

/** Means over the nine parts, as three sentences from top to bottom. */
function partsWords(surface: Surface, exaggeration: number): string {
  const rows = ['Upper', 'Middle', 'Lower'].map((title, row) => {
    const means = [0, 1, 2].map((column) => (meanHeight(surface, column, row) * exaggeration * 1000).toFixed(0));
    return `${title} third, left to right: ${means.join(', ')}.`;
  });
  return `Average heights in millimetres. ${rows.join(' ')}`;
}

/** All that D says: the scene, its summits, its parts, and the way from the probe to the highest point. */
export function sceneWords(surface: Surface, name: string, exaggeration: number, probe: Place): string {
  const { lowest, highest } = surface.range();
  const size = `${name}: ${millimetres(surface.width)} wide, ${millimetres(surface.depth)} from top to bottom`;
  const relief = (highest - lowest) * Math.abs(exaggeration);
  if (relief < 1e-5) return `${size}, flat at ${millimetres(highest * exaggeration, 1)}.`;
  const raised = exaggeration >= 0 ? surface : new Surface(surface.columns, surface.rows, surface.heights.map((z) => -z), surface.width, surface.depth);
  const scale = Math.abs(exaggeration);
  const top = highestOf(raised);
  const region = (place: Place) => regionOf(place, surface.width, surface.depth);
  const others = peaksOf(raised, 0.08 * (highest - lowest))
    .filter((peak) => Math.hypot(peak.x - top.x, peak.y - top.y) > 0.05 * Math.max(surface.width, surface.depth))
    .slice(0, 4)
    .map((peak) => `${region(peak)}, ${millimetres(peak.height * scale, 1)} high, ${fromMiddle(peak)}`);
  return [
    `${size}, heights from ${millimetres(Math.min(lowest * exaggeration, highest * exaggeration), 1)} to ${millimetres(top.height * scale, 1)}.`,
    `Highest point: ${region(top)}, ${fromMiddle(top)}.`,
    `From the probe: ${offsetWords(top.x - probe.x, top.y - probe.y)}.`,
    others.length > 0 ? `Further rises: ${others.join('; ')}.` : 'There is no second rise of note.',
    partsWords(surface, exaggeration),
  ].join(' ');
}

/** What P says: where the probe is, how high the surface is there and which way it rises. */
export function positionWords(probe: Place, height: number, slope: Place, label: string, surface: Surface): string {
  const region = regionOf(probe, surface.width, surface.depth);
  const where = `${region[0]!.toUpperCase()}${region.slice(1)}, ${fromMiddle(probe)}`;
  return `${where}. Height ${millimetres(height, 1)}, ${slopeWords(slope)}.${label === '' ? '' : ` ${label}.`}`;
}

/** Said while the probe moves: only what changes. */
export function motionWords(height: number, slope: Place, label: string): string {
  return `${label === '' ? '' : `${label}, `}${millimetres(height, 1)}, ${slopeWords(slope)}`;
}

/** One probe's share of what N says. */
export function probeWords(place: Place, height: number, force: number, label: string, surface: Surface): string {
  const named = label === '' ? '' : `, ${label}`;
  return `${regionOf(place, surface.width, surface.depth)}, ${fromMiddle(place)}, height ${millimetres(height, 1)}, force ${force.toFixed(2)} newtons${named}`;
}
