// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Surface } from '../surface';
import { clipType } from './clip';
import { fits, otherWords, Player, spokenTime } from './player';
import { crc32, readRecording, type Recording } from './recording';
import { Track } from './track';

interface Tick {
  t: number;
  x?: number;
  z?: number;
  force?: number;
  flags?: number;
  label?: number;
  probe?: number;
}

const text = (words: string) => new TextEncoder().encode(words);
function chunk(kind: string, payload: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(12 + payload.length);
  const view = new DataView(bytes.buffer);
  bytes.set(text(kind));
  view.setUint32(4, payload.length, true);
  view.setUint32(8, crc32(payload), true);
  bytes.set(payload, 12);
  return bytes;
}
function ticks(kind: 'TICK' | 'MORE', rows: readonly Tick[]): Uint8Array {
  const payload = new Uint8Array(192 * rows.length);
  const view = new DataView(payload.buffer);
  rows.forEach(({ t, x = 0, z = 0, force = 0, flags = 0, label = 0, probe = 0 }, k) => {
    const put = (offset: number, value: number) => view.setFloat64(192 * k + offset, value, true);
    put(8, t);
    put(24, NaN);
    put(48, x);
    put(64, z);
    put(96, x);
    put(112, z);
    put(160, force);
    view.setUint32(192 * k + 176, flags, true);
    view.setUint32(192 * k + 184, 7, true);
    view.setUint16(192 * k + 188, label, true);
    view.setUint8(192 * k + 191, probe);
  });
  return chunk(kind, payload);
}
const scene = (about: object) => chunk('PROG', new Uint8Array([7, 0, 0, 0, ...text(JSON.stringify(about))]));
const end = chunk('END ', new Uint8Array(8));
const file = (...parts: Uint8Array[]) => new Blob([text('PALPREC1'), chunk('HEAD', text('{}')), ...parts] as BlobPart[]);
/** `seconds` of ticks at 1000 Hz from `from` on. */
const thousand = (from: number, seconds: number, of: (t: number) => Partial<Tick> = () => ({})): Tick[] =>
  Array.from({ length: Math.round(1000 * seconds) }, (_, k) => ({ t: from + k / 1000, ...of(k / 1000) }));
const read = async (blob: Blob, mostRows?: number): Promise<Recording> => {
  const recording = await readRecording('touch.rec', blob, undefined, mostRows);
  if (typeof recording === 'string') throw new Error(recording);
  return recording;
};

describe('a recording', () => {
  it('is read at the rate of a page, with its probes and what was touched', async () => {
    const hand = thousand(5, 2, (t) => ({ x: 0.01 * t, force: t, flags: t < 1 ? 0 : 1, label: 3 }));
    const finger = thousand(5.5, 0.5, () => ({ x: 0.04, probe: 2 }));
    const recording = await read(file(scene({ depth: 2, scene_inputs: ['/home/me/boat.png', 7] }), ticks('TICK', hand), ticks('MORE', finger), end));
    expect(recording).toMatchObject({ begin: 5, inputs: ['/home/me/boat.png'], fault: null });
    expect(recording.end).toBeCloseTo(7, 1);
    const track = recording.tracks.get(0)!;
    expect(track.rows).toBeGreaterThan(100);
    expect(track.rows).toBeLessThan(125);
    const at = track.at(6.5)!;
    expect(at.moment.x).toBeCloseTo(0.015, 3);
    expect(at.moment).toMatchObject({ contact: true, paused: false, label: 3 });
    expect(track.at(5.5)!.moment.contact).toBe(false);
    expect(track.at(4.9)).toBeNull();
    expect([...recording.tracks.keys()]).toEqual([0, 2]);
  });

  it('of a touch shorter than a frame keeps its contact', async () => {
    const recording = await read(file(ticks('TICK', thousand(0, 1, (t) => ({ flags: Math.abs(t - 0.5) < 0.0005 ? 1 : 0 }))), end));
    const track = recording.tracks.get(0)!;
    const touching = Array.from({ length: 60 }, (_, k) => track.at(k / 60 + 0.001)!.moment.contact);
    expect(touching.filter(Boolean)).toHaveLength(1);
  });

  it('that was cut off or damaged is played to there', async () => {
    const first = ticks('TICK', thousand(0, 1));
    const second = ticks('TICK', thousand(1, 1));
    expect((await read(file(first, second))).fault).toMatch(/interrupted/);
    expect((await read(file(first, second.slice(0, -5)))).end).toBeLessThan(1);
    for (const spoil of [12, 12 + 192 * 500, 8]) {
      const spoiled = second.slice();
      spoiled[spoil]! ^= 1;
      const recording = await read(file(first, spoiled, end));
      expect(recording.fault).toMatch(/damaged/);
      expect(recording.end).toBeLessThan(1);
    }
    for (const wrong of [[{ t: NaN }], [{ t: 0.2 }], [{ t: 2, x: Infinity }], [{ t: 2, x: 1e30 }], [{ t: 1e300 }], [{ t: 2, probe: 10 }]])
      expect((await read(file(first, ticks('TICK', wrong), end))).fault).toMatch(/damaged/);
  });

  it('is refused in words if it is none, or empty', async () => {
    for (const blob of [new Blob([]), new Blob(['PALPREC']), new Blob(['PALPREC2 and more']), new Blob([new Uint8Array(4000)])])
      expect(await readRecording('x.rec', blob)).toBe('x.rec is not a recording of this version of Palpable.');
    expect(await readRecording('x.rec', file(end))).toBe('x.rec holds nothing that could be played.');
    const huge = chunk('TICK', new Uint8Array(0));
    new DataView(huge.buffer).setUint32(4, 0xffffffff, true);
    expect(await readRecording('x.rec', file(huge))).toBe('x.rec holds nothing that could be played.');
  });

  it('of any length takes bounded memory, over its whole length', async () => {
    const recording = await read(file(...Array.from({ length: 20 }, (_, k) => ticks('TICK', thousand(k, 1, (t) => ({ x: 0.001 * (k + t) })))), end), 256);
    const track = recording.tracks.get(0)!;
    expect(track.rows).toBeLessThanOrEqual(256);
    expect(track.spacing).toBeGreaterThan(1 / 60);
    for (const t of [0.5, 7.25, 19.5]) expect(Math.abs(track.at(t)!.moment.x - 0.001 * t)).toBeLessThan(0.001 * 3 * track.spacing);
  });
});

describe('a track that is thinned', () => {
  it('keeps every contact', () => {
    const track = new Track(16);
    const moment = { x: 0, y: 0, z: 0, fx: 0, fy: 0, fz: 0, paused: false, label: 0 };
    for (let k = 0; k < 100; ++k) track.add(k / 50, { ...moment, contact: k === 31 });
    const touching = Array.from({ length: 200 }, (_, k) => track.at(k / 100)?.moment.contact ?? false);
    expect(touching.some(Boolean)).toBe(true);
  });
});

describe('playing', () => {
  const plate = new Surface(2, 2, new Float32Array(4).fill(0.01), 0.1, 0.1);
  const recording = () => read(file(ticks('TICK', thousand(5, 2, (t) => ({ x: 0.01 * t, z: 0.009, force: 1.25, flags: 3 }))), ticks('MORE', thousand(5.5, 0.5, () => ({ probe: 1 }))), end));

  it('goes on with its speed, stops at the end, and begins again', async () => {
    const player = new Player(await recording());
    expect(player.advance(1)).toBe(false);
    player.play();
    player.speed = 0.5;
    expect(player.advance(1)).toBe(true);
    expect(player.time).toBeCloseTo(0.5, 9);
    player.speed = 4;
    expect(player.advance(1)).toBe(false);
    expect(player.time).toBe(player.length);
    expect(player.isPlaying).toBe(false);
    player.play();
    expect(player.time).toBe(0);
    player.seek(-3);
    expect(player.time).toBe(0);
  });

  it('gives the states that the program would send', async () => {
    const player = new Player(await recording());
    player.seek(1);
    const state = player.state(plate, 2);
    expect(state.t_s).toBeCloseTo(6, 9);
    expect(state.probes[0]).toMatchObject({ probe: 0, fz_N: 1.25, contact: true, surface_m: expect.closeTo(0.02, 6), x_m: expect.closeTo(0.01, 3) });
    // A probe that was lifted is gone.
    const count = (time: number) => {
      player.seek(time);
      return player.state(plate, 1).probes.length;
    };
    expect([0.2, 0.7, 1.9].map(count)).toEqual([1, 2, 1]);
  });

  it('is said as time, contact and force', async () => {
    const player = new Player(await recording());
    player.seek(1.26);
    expect(player.words()).toBe('1.3 seconds of 2 seconds, in contact, 1.25 newtons');
    expect([0.04, 1, 61, 120, 3725].map(spokenTime)).toEqual(['0 seconds', '1 second', '1 minute 1 second', '2 minutes', '62 minutes 5 seconds']);
  });

  it('tells a recording of another scene', async () => {
    expect(fits(await recording(), plate)).toBe(true);
    expect(fits(await recording(), new Surface(2, 2, new Float32Array(4).fill(0.02), 0.1, 0.1))).toBe(false);
    expect(fits({ contacts: [] }, plate)).toBe(true);
    expect(otherWords(['/home/me/left.png', 'right.png'], 'left.png and right.png')).toMatch(/another version of this scene/);
    expect(otherWords(['boat.png'], 'left.png and right.png')).toBe('It seems to be of another scene than this one. It was made on boat.png.');
    expect(otherWords([], 'boat.png')).toBe('It seems to be of another scene than this one.');
  });
});

describe('clips', () => {
  it('are said to be missing where the browser records none', () => expect(clipType()).toBeNull());
});
