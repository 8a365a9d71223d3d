// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Announcer, Importance } from './announcer';
import { History } from './history';
import { coarseStep, fineStep, keyRows, press, type KeyTarget } from './keys';
import { follow, pointerGain } from './marble';
import { niceTop } from './plot';
import { defaults, preferencesCookie, readPreferences } from './preferences';
import { Pace } from './pace';
import { ProbeHand } from './probe';
import { EdgeDetector, octaves, panOf, pitchOf, RisingEdge } from './sonify';
import { Surface } from './surface';

describe('sonification', () => {
  it('gives equal intervals for equal steps of height', () => {
    const pitches = [0, 0.25, 0.5, 0.75, 1].map((h) => pitchOf(h, 0, 1));
    for (let i = 1; i < 5; ++i) expect(pitches[i]! / pitches[i - 1]!).toBeCloseTo(2 ** (octaves / 4), 9);
  });
  it('stays in its range for heights outside and for a flat scene', () => {
    expect(pitchOf(-9, 0, 1)).toBe(pitchOf(0, 0, 1));
    expect(pitchOf(9, 0, 1)).toBe(pitchOf(1, 0, 1));
    expect(pitchOf(5, 5, 5)).toBe(pitchOf(0, 0, 1));
  });
  it('puts left left and right right', () => {
    expect(panOf(-0.05, 0.1)).toBeCloseTo(-0.8);
    expect(panOf(0, 0.1)).toBe(0);
    expect(panOf(1, 0.1)).toBeCloseTo(0.8);
  });
  it('sounds an edge once, however long the slope', () => {
    const edges = new EdgeDetector(0.8, 0.4);
    expect([0, 1, 1.2, 0.6, 1, 0.3, 1].map((slope) => edges.crossed(slope))).toEqual([false, true, false, false, false, false, true]);
  });
  it('clicks only when contact begins', () => {
    const contact = new RisingEdge();
    expect([false, true, true, false, true].map((now) => contact.rises(now))).toEqual([false, true, false, false, true]);
  });
});

describe('the announcer', () => {
  const said: string[] = [];
  const fresh = () => {
    said.length = 0;
    return new Announcer((text) => said.push(text));
  };
  it('speaks at once, then at most once a second, the newest of equals', () => {
    const announcer = fresh();
    for (let t = 0; t < 1000; t += 10) announcer.say(`${t}`, Importance.motion, t);
    expect(said).toEqual(['0']);
    announcer.tick(999);
    expect(said).toEqual(['0']);
    announcer.tick(1000);
    expect(said).toEqual(['0', '990']);
  });
  it('drops what is out of date', () => {
    const announcer = fresh();
    announcer.say('a', Importance.motion, 0);
    announcer.say('b', Importance.motion, 100, 300);
    announcer.tick(1000);
    expect(said).toEqual(['a']);
  });
  it('lets no motion push an answer aside, but a fault may', () => {
    const announcer = fresh();
    announcer.say('first', Importance.motion, 0);
    announcer.say('answer', Importance.answer, 10);
    announcer.say('motion', Importance.motion, 20);
    announcer.tick(1000);
    expect(said).toEqual(['first', 'answer']);
    announcer.say('answer', Importance.answer, 1010);
    announcer.say('fault', Importance.fault, 1020);
    announcer.tick(2000);
    expect(said).toEqual(['first', 'answer', 'fault']);
  });
  it('works its words out when it speaks, and says nothing if there is nothing to say any more', () => {
    const announcer = fresh();
    let height = 1;
    announcer.say('first', Importance.motion, 0);
    announcer.say(() => `height ${height}`, Importance.motion, 10);
    height = 2;
    announcer.tick(1000);
    announcer.say(() => null, Importance.motion, 2000);
    announcer.say('free', Importance.motion, 2001);
    expect(said).toEqual(['first', 'height 2', 'free']);
  });
});

describe('history', () => {
  it('undoes and redoes every step', () => {
    const history = new History(0);
    history.change(1, 'a', 0);
    history.change(2, 'b', 1);
    expect([history.undo(), history.now, history.undo(), history.now, history.undo()]).toEqual([true, 1, true, 0, false]);
    expect([history.redo(), history.redo(), history.redo(), history.now]).toEqual([true, true, false, 2]);
  });
  it('makes one step of a dragged slider, and two of two drags', () => {
    const history = new History(0);
    for (let i = 1; i <= 10; ++i) history.change(i, 'slider', i * 50);
    for (let i = 11; i <= 20; ++i) history.change(i, 'slider', 5000 + i * 50);
    history.undo();
    expect(history.now).toBe(10);
    history.undo();
    expect(history.now).toBe(0);
  });
  it('starts a new step after an undo, even of the same slider', () => {
    const history = new History(0);
    history.change(1, 'slider', 0);
    history.undo();
    history.change(2, 'slider', 10);
    history.undo();
    expect(history.now).toBe(0);
  });
  it('forgets what was undone when something else changes', () => {
    const history = new History(0);
    history.change(1, 'a', 0);
    history.undo();
    history.change(2, 'b', 5000);
    expect(history.canRedo).toBe(false);
  });
});

describe('preferences', () => {
  const jar = (text: string) => `other=1; palpable_page=${encodeURIComponent(text)}; more=2`;
  it('are the defaults when nothing is kept, or nonsense', () => {
    for (const cookies of ['', jar('{'), jar('7'), jar('null'), 'palpable_page=%', jar('{"volume":1e9,"theme":"neon","sound":1,"__proto__":{"tilt":3}}')])
      expect(readPreferences(cookies)).toEqual(defaults);
  });
  it('come back as they were kept', () => {
    const mine = { ...defaults, volume: 20, theme: 'dark' as const, sound: false };
    expect(readPreferences(preferencesCookie(mine).split('; ')[0]!)).toEqual(mine);
  });
  it('leave nothing behind when all is as at first', () => expect(preferencesCookie(defaults)).toContain('Max-Age=0'));
});

const slope = new Surface(11, 11, Float32Array.from({ length: 121 }, (_, k) => (k % 11) * 0.001), 0.11, 0.11);

describe('the surface', () => {
  it('knows heights and slopes of a ramp, and its rectangle', () => {
    expect(slope.heightAt({ x: 0, y: 0.02 })).toBeCloseTo(0.005, 9);
    expect(slope.heightAt({ x: 0.013, y: 0 })).toBeCloseTo(0.0063, 9);
    expect(slope.slopeAt({ x: 0, y: 0 }).x).toBeCloseTo(0.1, 6);
    expect(slope.slopeAt({ x: 0, y: 0 }).y).toBeCloseTo(0, 9);
    expect(slope.clamp({ x: 1, y: -1 })).toEqual({ x: 0.055, y: -0.055 });
  });
  it('is hit by a ray where the ray is as high as it', () => {
    const straight = slope.hit([0.02, 0.01, 1], [0, 0, -1], 1)!;
    expect(straight).toEqual({ x: 0.02, y: 0.01 });
    const slanted = slope.hit([0.02, -0.5, 0.5], [0, Math.SQRT1_2, -Math.SQRT1_2], 2)!;
    expect(slanted.y).toBeCloseTo(-2 * slope.heightAt(slanted), 3);
    expect(slope.hit([0, 0, 1], [0, 0, 1], 1)).toBeNull();
  });
});

describe('the marble', () => {
  it('lags uphill, hurries downhill, and arrives', () => {
    const after = (rise: number) => follow({ x: 0, y: 0 }, { x: 0.01, y: 0 }, { x: rise, y: 0 }, 0.016).x;
    expect(after(1)).toBeLessThan(after(0));
    expect(after(-1)).toBeGreaterThan(after(0));
    expect(pointerGain(0)).toBe(1);
    let marble = { x: 0, y: 0 };
    for (let i = 0; i < 200; ++i) marble = follow(marble, { x: 0.01, y: 0.01 }, { x: 2, y: 0 }, 0.016);
    expect(marble).toEqual({ x: 0.01, y: 0.01 });
  });
  it('is where a key puts it at once, within the scene', () => {
    const hand = new ProbeHand();
    expect(hand.step(fineStep, 0, 0, slope)).toBe(true);
    expect(hand.place).toEqual({ x: 0.001, y: 0 });
    expect(hand.step(1, 0, 0, slope)).toBe(false);
    expect(hand.place.x).toBe(0.055);
    expect(hand.advance(0.016, slope, 1)).toBe(true);
    expect(hand.advance(0.016, slope, 1)).toBe(false);
  });
});

describe('keys', () => {
  const calls: string[] = [];
  const target: KeyTarget = {
    move: ({ x, y, press: depth }) => calls.push(`move ${x} ${y} ${depth}`),
    describe: () => calls.push('describe'),
    where: () => calls.push('where'),
    recentre: () => calls.push('recentre'),
    walk: ({ ahead, left }) => calls.push(`walk ${ahead} ${left}`),
    stance: () => calls.push('stance'),
    choose: (probe) => calls.push(`choose ${probe}`),
    take: () => calls.push('take'),
    tellProbes: () => calls.push('tell probes'),
    pause: () => calls.push('pause'),
    mute: () => calls.push('mute'),
    help: () => calls.push('help'),
  };
  const type = (key: string, shiftKey = false, ctrlKey = false) => press({ key, shiftKey, ctrlKey, altKey: false, metaKey: false }, target);
  it('move by one millimetre, with Shift by five', () => {
    calls.length = 0;
    type('ArrowUp');
    type('ArrowLeft', true);
    expect(calls).toEqual([`move 0 ${fineStep} 0`, `move ${-coarseStep} 0 0`]);
  });
  it('walk and turn, farther with Shift', () => {
    calls.length = 0;
    type('w');
    type('S', true);
    type('a');
    type('F', true);
    type('e');
    expect(calls).toEqual(['walk 0.005 0', 'walk -0.02 0', 'walk 0 15', 'walk 0 -45', 'stance']);
  });
  it('choose the probe of their number, the tenth by 0', () => {
    calls.length = 0;
    for (const key of ['1', '9', '0', 'Delete', 'n']) type(key);
    expect(calls).toEqual(['choose 0', 'choose 8', 'choose 9', 'take', 'tell probes']);
  });
  it('leave the browser its own', () => {
    calls.length = 0;
    expect(type('d', false, true)).toBe(false);
    expect(type('Tab')).toBe(false);
    expect(type('D', true)).toBe(true);
    expect(calls).toEqual(['describe']);
  });
  it('stand for one thing each', () => {
    const all = keyRows.flatMap(({ keys }) => keys);
    expect(new Set(all).size).toBe(all.length);
  });
});

it('the plot ends at a round number above its greatest force', () => {
  expect([0, 0.3, 1, 1.2, 3, 7, 55, 5000].map(niceTop)).toEqual([1, 1, 1, 2, 4, 10, 60, 1000]);
});

it('the pace is too slow after a dozen late frames in a row, not after pauses', () => {
  const pace = new Pace();
  let now = 0;
  const frames = (count: number, gap: number) => Array.from({ length: count }, () => pace.drawn((now += gap))).includes(true);
  expect(frames(100, 16)).toBe(false);
  expect(frames(11, 60)).toBe(false);
  expect(frames(1, 16)).toBe(false);
  expect(frames(12, 60)).toBe(true);
  for (let i = 0; i < 50; ++i) {
    pace.rested();
    expect(pace.drawn((now += 500))).toBe(false);
  }
});
