// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { beforeEach, describe, expect, it } from 'vitest';
import type { ProbeState, State } from '../generated/protocol';
import { Probes } from './probes';
import { Surface } from '../surface';

const ramp = new Surface(11, 11, new Float32Array(121).map((_, k) => 0.001 * (k % 11)), 0.11, 0.11);
const middle = { x: 0, y: 0 };
const right = { x: 0.03, y: 0.01 };
let probes: Probes;
beforeEach(() => {
  probes = new Probes();
  probes.own.set(3, true);
});

describe('pointers and probes', () => {
  it('a single pointer moves the first probe and leaves it in place', () => {
    const { own } = probes;
    expect(own.movedBy(7)).toBe(0);
    expect(own.press(7, right)).toEqual({ probe: 0, isNew: false });
    expect(own.release(7)).toBe(null);
    expect(own.numbers).toEqual([0]);
  });
  it('each additional finger has its own probe until it is lifted', () => {
    const { own } = probes;
    own.press(1, middle);
    expect(own.press(2, right)).toEqual({ probe: 1, isNew: true });
    expect(own.press(3, middle)).toEqual({ probe: 2, isNew: true });
    expect(own.at(1)!.place).toEqual(right);
    expect([1, 2, 3].map((pointer) => own.movedBy(pointer))).toEqual([0, 1, 2]);
    expect(own.press(4, middle)).toBe(null);
    expect(own.movedBy(4)).toBe(null);
    expect(own.release(2)).toBe(1);
    expect(own.release(2)).toBe(null);
    expect(own.numbers).toEqual([0, 2]);
    expect(own.press(4, middle)).toEqual({ probe: 1, isNew: true });
  });
  it('lifting the first finger leaves the first probe, which the next finger moves again', () => {
    const { own } = probes;
    own.press(1, middle);
    own.press(2, right);
    expect(own.release(1)).toBe(null);
    expect(own.press(3, middle)).toEqual({ probe: 0, isNew: false });
    expect(own.numbers).toEqual([0, 1]);
  });
  it('a pointer does not move the device\'s probe but its own one', () => {
    const { own } = probes;
    own.set(3, false);
    expect(own.movedBy(7)).toBe(null);
    expect(own.press(7, right)).toEqual({ probe: 1, isNew: true });
    expect(own.advance(0.016, ramp, 1)).toEqual([1]);
  });
  it('fingers and keys leave the probes of several devices alone', () => {
    const { own } = probes;
    own.set(4, false, 2);
    expect(own.numbers).toEqual([0, 1]);
    expect([0, 1, 2].map((probe) => own.movable(probe))).toEqual([false, false, true]);
    expect(own.press(7, right)).toEqual({ probe: 2, isNew: true });
    expect(own.choose(1, right)).toBe(true);
    expect(own.movedBy(9)).toBe(null);
    expect(own.remove(1)).toBe(false);
    expect(own.press(8, right)).toEqual({ probe: 3, isNew: true });
    expect(own.press(9, right)).toBe(null);
    expect(own.release(7)).toBe(2);
    expect(own.numbers).toEqual([0, 1, 3]);
  });
});

describe('keys and probes', () => {
  it('add a probe, move it alone, and remove it', () => {
    const { own } = probes;
    own.advance(0.016, ramp, 1);
    expect(own.choose(2, right)).toBe(true);
    expect(own.free()).toBe(1);
    expect(own.current.place).toEqual(right);
    own.current.step(0.001, 0, 0, ramp, 0);
    expect(own.advance(0.016, ramp, 1)).toEqual([2]);
    expect(own.at(0)!.place).toEqual(middle);
    expect(own.remove(2)).toBe(true);
    expect(own.chosen).toBe(0);
    expect(own.remove(0)).toBe(false);
  });
  it('select none beyond the program\'s limit', () => {
    expect(probes.own.choose(3, right)).toBe(false);
    expect(probes.own.numbers).toEqual([0]);
  });
  it('a probe that keys have added stays after a pointer moved it', () => {
    const { own } = probes;
    own.choose(1, right);
    expect(own.press(5, middle)).toEqual({ probe: 1, isNew: false });
    expect(own.release(5)).toBe(null);
    expect(own.numbers).toEqual([0, 1]);
  });
});

const noDevice = { x_m: 0, y_m: 0, z_m: 0, turned_deg: 0 };

describe('what probes feel', () => {
  const first: ProbeState = { probe: 0, page: null, x_m: 0, y_m: 0, z_m: 0.004, surface_m: 0.005, fx_N: 0, fy_N: 0, fz_N: 0.5, contact: true, label: 1 };
  const third: ProbeState = { probe: 2, page: 7, x_m: 0.03, y_m: 0.01, z_m: 0.007, surface_m: 0.008, fx_N: 0.3, fy_N: 0, fz_N: 0.4, contact: true, label: 0 };
  const state: State = { type: 'state', t_s: 1, rate_hz: 1000, probes: [first, third], device: noDevice };
  it('is stored by number', () => {
    probes.receive(state, 0);
    expect(probes.stateOf(2)).toMatchObject({ x_m: 0.03, fx_N: 0.3, contact: true });
  });
  it('is shown in one row per probe, also for those of other pages', () => {
    probes.receive(state, 0);
    const views = probes.views(ramp, 1);
    expect(views.map(({ number, chosen }) => [number, chosen])).toEqual([[1, true], [3, false]]);
    expect(views[1]).toMatchObject({ x: 0.03, y: 0.01, z: 0.008, force: [0.3, 0, 0.4] });
    probes.forget();
    expect(probes.numbers).toEqual([0]);
  });
  it('is named only if there are several', () => {
    expect(probes.named('level')).toBe('level');
    probes.own.choose(1, right);
    expect(probes.named('level')).toBe('Probe 2: level');
  });
});

describe('a probe that two pages move', () => {
  const at = (page: number | null, x_m: number): State => ({
    type: 'state', t_s: 1, rate_hz: 1000,
    probes: [{ probe: 0, page, x_m, y_m: 0, z_m: 0, surface_m: 0, fx_N: 0, fy_N: 0, fz_N: 0, contact: false, label: 0 }],
    device: noDevice,
  });
  beforeEach(() => {
    probes.page = 2;
  });
  it('has the other page\'s place, and a key steps from there', () => {
    expect(probes.receive(at(1, 0.02), 1000)).toBeNull();
    expect(probes.own.current.place.x).toBe(0.02);
    expect(probes.own.advance(0.016, ramp, 1)).toEqual([]);
    probes.own.current.step(0.001, 0, 0, ramp, 1000);
    expect(probes.own.current.place.x).toBeCloseTo(0.021, 9);
  });
  it('keeps this page\'s recent place despite delayed states', () => {
    probes.own.current.step(0.01, 0, 0, ramp, 1000);
    expect(probes.receive(at(1, 0.02), 1100)).toBeNull();
    expect(probes.own.current.place.x).toBeCloseTo(0.01, 9);
  });
  it('is announced once when another page takes it', () => {
    probes.receive(at(2, 0.01), 1000);
    expect(probes.receive(at(1, 0.02), 2000)).toBe(0);
    expect(probes.receive(at(1, 0.03), 2100)).toBeNull();
  });
  it('has this page\'s place until somebody moves it', () => {
    probes.receive(at(null, 0), 1000);
    expect(probes.own.advance(0.016, ramp, 1)).toEqual([0]);
  });
});

describe('the size of the scene', () => {
  it('makes a probe press less deep on a small one, and no deeper on a large one', () => {
    const press = (scale: number) => {
      const own = new Probes().own;
      own.setScale(scale);
      return own.current.press;
    };
    expect(press(0.5)).toBeCloseTo(0.5 * press(1), 12);
    expect(press(0.05)).toBeCloseTo(0.2 * press(1), 12);
    expect(press(100)).toBe(press(1));
  });
});

describe("a guest's page", () => {
  it('moves its own probe alone, with keys and one finger', () => {
    const { own } = probes;
    own.set(10, false);
    own.setGuest(8);
    expect(own.numbers).toEqual([8]);
    expect(own.chosen).toBe(8);
    expect(own.several).toBe(false);
    expect([0, 7, 8].map((probe) => own.movable(probe))).toEqual([false, false, true]);
    expect(own.press(1, right)).toEqual({ probe: 8, isNew: false });
    expect(own.press(2, middle)).toBe(null);
    expect(own.choose(0, middle)).toBe(false);
    expect(own.remove(8)).toBe(false);
  });
  it('sends its probe again when it comes back, since it was lifted', () => {
    const { own } = probes;
    own.setGuest(8);
    expect(own.advance(0.01, ramp, 1)).toEqual([8]);
    expect(own.advance(0.01, ramp, 1)).toEqual([]);
    own.comeBack();
    expect(own.advance(0.01, ramp, 1)).toEqual([8]);
  });
  it('moves nothing if it only looks', () => {
    const { own } = probes;
    own.setGuest(null);
    expect(own.movable()).toBe(false);
    expect(own.press(1, right)).toBe(null);
    expect(own.advance(0.01, ramp, 1)).toEqual([]);
  });
});
