// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { ProbeState } from '../generated/protocol';
import { defaults, type Preferences } from '../settings/preferences';
import { Surface } from '../surface';
import { Feedback } from './feedback';
import type { Command } from './instrument/instrument';
import type { Direction } from './sonify';

beforeEach(() => void vi.stubGlobal('navigator', {}));
afterEach(() => vi.unstubAllGlobals());

const surface = new Surface(2, 2, new Float32Array([0, 0, 0.01, 0.01]), 0.1, 0.1);
const still = { probe: 0, x_m: 0, y_m: 0, z_m: 0, fx_N: 0, fy_N: 0, fz_N: 1, contact: false, label: 0 } as ProbeState;

/** What the browser was asked for during a contact with these preferences. */
function contactWith(preferences: Partial<Preferences>) {
  const asked = { phone: 0, gamepads: 0, rumbles: 0 };
  const playEffect = () => {
    asked.rumbles += 1;
    return Promise.resolve('complete');
  };
  vi.stubGlobal('navigator', {
    vibrate: () => (asked.phone += 1) > 0,
    getGamepads: () => {
      asked.gamepads += 1;
      return [null, { vibrationActuator: { playEffect } }];
    },
  });
  const feedback = new Feedback(() => undefined);
  feedback.set({ page: { ...defaults, sound: false, ...preferences }, materials: [] });
  for (const contact of [false, true, true]) feedback.reported({ ...still, contact }, surface, 1);
  return asked;
}

it('vibrates the phone at a contact, and does not ask for gamepads, which the browser would then poll', () =>
  expect(contactWith({})).toEqual({ phone: 1, gamepads: 0, rumbles: 0 }));
it('vibrates gamepads if that is chosen', () => expect(contactWith({ gamepads: true, vibration: false })).toEqual({ phone: 0, gamepads: 1, rumbles: 1 }));

describe('the sounds of a probe', () => {
  /** A feedback whose sounds are written down. */
  function listening() {
    const feedback = new Feedback(() => undefined);
    const heard: [Command, Direction | null][] = [];
    feedback.sound.play = (_probe, command, from = null) => void heard.push([command, from]);
    const whats = () => heard.splice(0).map(([{ what }]) => what);
    return { feedback, heard, whats };
  }

  it('a contact has its material, its strength and its place', () => {
    const { feedback, heard } = listening();
    feedback.reported({ ...still, z_m: 0.01 }, surface, 1);
    feedback.reported({ ...still, x_m: 0.04, contact: true }, surface, 1.05);
    expect(heard.map(([{ what }]) => what)).toEqual(['material', 'contact']);
    const [{ strength }, from] = heard[1] as unknown as [{ strength: number }, Direction];
    expect(strength).toBe(1);
    expect(from.x).toBeGreaterThan(0.5);
  });
  it('sliding is heard in contact and in motion only, as on a scene of a tenth of a metre', () => {
    const { feedback, heard, whats } = listening();
    const slide = (x_m: number, contact: boolean, t: number, scene = surface) => feedback.reported({ ...still, x_m, contact }, scene, t);
    slide(0, true, 1);
    whats();
    slide(0.002, true, 1.02);
    expect(heard[0]![0]).toMatchObject({ what: 'slide', force: 1 });
    expect((heard[0]![0] as { speed: number }).speed).toBeCloseTo(0.1, 9);
    whats();
    slide(0.002, true, 1.04);
    slide(0.004, false, 1.06);
    expect(whats()).toEqual([]);
    const large = new Surface(2, 2, new Float32Array(4), 1, 1);
    slide(0.004, true, 1.08, large);
    heard.length = 0;
    slide(0.024, true, 1.1, large);
    expect((heard.find(([{ what }]) => what === 'slide')![0] as { speed: number }).speed).toBeCloseTo(0.1, 9);
  });
  it('a named region rings when it is entered, not when the touch begins there, and not for ever back and forth', () => {
    const { feedback, whats } = listening();
    feedback.setNames([null, 'lake', 'wood']);
    const into = (label: number) => feedback.reported({ ...still, label }, surface, 1);
    into(1);
    expect(whats()).toEqual([]);
    into(2);
    expect(whats()).toEqual(['name']);
    for (const label of [1, 2, 1, 2]) into(label);
    expect(whats()).toEqual([]);
    into(0);
    expect(whats()).toEqual([]);
  });
  it('the material is sent once, and again when it has changed', () => {
    const { feedback, whats } = listening();
    const stone = { stiffness_N_per_m: 900, damping_Ns_per_m: 0, friction: 0.2, stickiness: 0, texture: 'none', pitch_m: 1e-3, height_m: 0, angle_deg: 0, name: 'stone' };
    const press = () => feedback.reported({ ...still, contact: true }, surface, 1);
    feedback.set({ page: defaults, materials: [stone] });
    press();
    press();
    expect(whats()).toEqual(['material', 'contact']);
    feedback.set({ page: defaults, materials: [{ ...stone, friction: 1 }] });
    press();
    expect(whats()).toEqual(['material']);
  });
});

it('says once that sound waits for a user action, when something would be heard', () => {
  const said: string[] = [];
  const feedback = new Feedback((sentence) => said.push(sentence));
  feedback.set({ page: { ...defaults, vibration: false }, materials: [] });
  [0, 0.001, 0.002, 0.003].forEach((x_m, i) => feedback.reported({ ...still, x_m, contact: true }, surface, 1 + 0.02 * i));
  expect(said).toEqual(['Sound waits for a key press or a click on this page.']);
});
it('says once that the browser plays no sound', async () => {
  const said: string[] = [];
  const feedback = new Feedback((sentence) => said.push(sentence));
  feedback.set({ page: defaults, materials: [] });
  await feedback.sound.wake();
  await feedback.sound.wake();
  expect(said).toEqual(['This browser plays no sound: height and edges are told by words only.']);
});
it('says once that there is no output, and goes on without', async () => {
  const said: string[] = [];
  vi.stubGlobal('AudioContext', class {
    constructor() {
      throw new DOMException('no device', 'NotSupportedError');
    }
  });
  const feedback = new Feedback((sentence) => said.push(sentence));
  feedback.set({ page: defaults, materials: [] });
  await feedback.sound.wake();
  await feedback.sound.wake();
  feedback.moved(0, { x: 0, y: 0 }, surface, 1);
  expect(said).toEqual(['Sound does not start: no audio output was found. Height and edges are told by words.']);
});
