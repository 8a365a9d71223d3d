// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { readMessage, readRaster, writeMessage } from './codec';
import { fromPageSpecs, raster, toPageSpecs } from './generated/protocol';

const probe = { probe: 2, page: null, x_m: 0.01, y_m: 0, z_m: 0, surface_m: 0.01, fx_N: 0, fy_N: 0, fz_N: 0.5, contact: true, label: 0 };
const state = { type: 'state', t_s: 1, rate_hz: 1000, probes: [{ ...probe, probe: 0, page: 3 }, probe], device: { x_m: 0, y_m: 0.01, z_m: -0.02, turned_deg: 90 } };
const withProbe = (change: object) => JSON.stringify({ ...state, probes: [{ ...probe, ...change }] });

function frame(words: number[], payload: Uint8Array): ArrayBuffer {
  const bytes = new Uint8Array(4 * words.length + payload.length);
  const view = new DataView(bytes.buffer);
  words.forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.set(payload, 4 * words.length);
  return bytes.buffer;
}

describe('reading messages', () => {
  it('accepts a valid message', () => expect(readMessage(JSON.stringify(state))).toEqual(state));
  it.each([
    ['not JSON', '{'],
    ['no object', '[]'],
    ['null', 'null'],
    ['no type', '{}'],
    ['a type from the prototype', '{"type":"constructor"}'],
    ['a message of the other direction', '{"type":"recentre"}'],
    ['a missing field', JSON.stringify({ ...state, rate_hz: undefined })],
    ['a field too many', JSON.stringify({ ...state, more: 1 })],
    ['a text for a number', JSON.stringify({ ...state, t_s: '1' })],
    ['null for a number that has to be set', JSON.stringify({ ...state, t_s: null })],
    ['an object for a list', JSON.stringify({ ...state, probes: probe })],
    ['a number for an object', JSON.stringify({ ...state, probes: [7] })],
    ['a missing field of an object', withProbe({ fz_N: undefined })],
    ['a field too many of an object', withProbe({ more: 1 })],
    ['a number beyond its limit', withProbe({ fz_N: 1e9 })],
    ['a probe beyond the last', withProbe({ probe: 10 })],
    ['more probes than there can be', JSON.stringify({ ...state, probes: Array.from({ length: 11 }, () => probe) })],
    ['a fraction for a whole number', withProbe({ label: 0.5 })],
  ])('refuses %s with an error message', (_, text) => expect(readMessage(text)).toBeTypeOf('string'));
  it('counts the bytes of a text, not its letters', () => {
    const notice = (text: string) => JSON.stringify({ type: 'notice', level: 'info', text, probe: null });
    expect(readMessage(notice('ä'.repeat(500)))).toBeTypeOf('object');
    expect(readMessage(notice('ä'.repeat(501)))).toBeTypeOf('string');
  });
});

describe('writing messages', () => {
  it('writes messages that match their definitions', () => {
    const message = { type: 'pointer', probe: 1, x_m: 0.01, y_m: -0.02, press_m: 0.001 } as const;
    expect(readMessage(writeMessage(message), fromPageSpecs)).toEqual(message);
  });
  it('has no message name in both directions', () => {
    expect(Object.keys(fromPageSpecs).filter((name) => name in toPageSpecs)).toEqual([]);
  });
});

describe('reading rasters', () => {
  const heights = new Uint8Array(new Float32Array([1, 2, 3, 4, 5, 6]).buffer);
  it('accepts heights', () => {
    const read = readRaster(frame([raster.magic, 1, 7, 3, 2], heights));
    expect(read).toMatchObject({ kind: 'heights', scene: 7, columns: 3, rows: 2 });
    expect(Array.from((read as { heights: Float32Array }).heights)).toEqual([1, 2, 3, 4, 5, 6]);
  });
  it('accepts a picture', () =>
    expect(readRaster(frame([raster.magic, 2, 7, 2, 1], new Uint8Array([1, 2, 3, 4, 5, 6])))).toMatchObject({ kind: 'picture' }));
  it('accepts cells', () =>
    expect(readRaster(frame([raster.magic, 3, 7, 2, 1], new Uint8Array([1, 2, 3, 4, 5, 6])))).toMatchObject({ kind: 'cells' }));
  it.each([
    ['a short header', frame([raster.magic, 1, 7, 3], new Uint8Array())],
    ['another magic', frame([1, 1, 7, 3, 2], heights)],
    ['another kind', frame([raster.magic, 3, 7, 3, 2], heights)],
    ['a size that does not fit', frame([raster.magic, 1, 7, 3, 3], heights)],
    ['a size that overflows', frame([raster.magic, 1, 7, 0xffffffff, 0xffffffff], heights)],
    ['no pixels', frame([raster.magic, 1, 7, 0, 0], new Uint8Array())],
    ['a height that is no number', frame([raster.magic, 1, 7, 1, 1], new Uint8Array(new Float32Array([NaN]).buffer))],
  ])('refuses %s', (_, buffer) => expect(readRaster(buffer)).toBeTypeOf('string'));
});
