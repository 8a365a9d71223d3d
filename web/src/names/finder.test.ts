// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Words as Answer } from '../generated/protocol';
import type { Words } from '../sound/announcer';
import type { Feedback } from '../sound/feedback';
import { Surface, type Place } from '../surface';
import { Finder } from './finder';
import { problemOf } from './name_form';

const target = { x: 0.04, y: 0.02 };

/** A finder whose program leads to `target`, on a scene of 0.1 m. */
function setUp() {
  const place: Place = { x: 0, y: 0 };
  const said: string[] = [];
  const pulses: { at: number; frequency: number; side: number }[] = [];
  const other: string[] = [];
  const surface = new Surface(2, 2, new Float32Array(4), 0.1, 0.1);
  const feedback = {
    sound: {
      play: (_: number, command: { what: string; frequency?: number }, from: { x: number } | null = null) =>
        command.what === 'find' ? pulses.push({ at: performance.now(), frequency: command.frequency ?? 0, side: from?.x ?? NaN }) : other.push(command.what),
    },
  } as unknown as Feedback;
  const way = (): Promise<Answer | null> => {
    const there = Math.hypot(place.x - target.x, place.y - target.y) < 0.003;
    return Promise.resolve({ type: 'words', serial: 0, text: there ? 'Here: gate.' : 'Gate: somewhere.', x_m: there ? null : target.x, y_m: there ? null : target.y });
  };
  let [ended, found] = [0, 0];
  const say = (words: Words | string) => void Promise.resolve(typeof words === 'string' ? words : words()).then((text) => text && said.push(text));
  const finder = new Finder({ surface: () => surface, probe: () => 0, place: () => ({ ...place }), way, say, ended: () => (ended += 1), found: () => (found += 1) }, feedback);
  return { finder, place, said, pulses, other, ended: () => ended, found: () => found };
}

describe('finding a name', () => {
  beforeEach(() => void vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout', 'performance'] }));
  afterEach(() => void vi.useRealTimers());

  it('begins with the way in words, and pulses from the side of the name', async () => {
    const { finder, said, pulses } = setUp();
    finder.begin('gate');
    await vi.advanceTimersByTimeAsync(100);
    expect(said).toEqual(['Looking for gate. Gate: somewhere.']);
    expect(pulses).toHaveLength(1);
    expect(pulses[0]!.side).toBeGreaterThan(0.5);
    expect(pulses[0]!.frequency).toBeGreaterThan(660);
  });

  it('pulses quicker the nearer the probe is', async () => {
    const far = setUp();
    far.finder.begin('gate');
    await vi.advanceTimersByTimeAsync(3000);
    const slow = far.pulses.length;
    const near = setUp();
    Object.assign(near.place, { x: 0.035, y: 0.02 });
    near.finder.begin('gate');
    await vi.advanceTimersByTimeAsync(3000);
    expect(near.pulses.length).toBeGreaterThan(2 * slow);
  });

  it('is silent after a quarter of a minute without a movement, and goes on with the next one', async () => {
    const { finder, pulses, place } = setUp();
    finder.begin('gate');
    await vi.advanceTimersByTimeAsync(60_000);
    const before = pulses.length;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(pulses.length).toBe(before);
    place.x = 0.01;
    finder.moved(true);
    expect(pulses.length).toBe(before + 1);
  });

  it('ends at the name, with its bell', async () => {
    const { finder, place, said, pulses, other, ended } = setUp();
    finder.begin('gate');
    await vi.advanceTimersByTimeAsync(100);
    Object.assign(place, target);
    finder.moved(false);
    await vi.advanceTimersByTimeAsync(100);
    expect(said[said.length - 1]).toBe('Here: gate.');
    expect(finder.isLeading).toBe(false);
    expect(ended()).toBe(1);
    expect(other).toEqual(['name']);
    const before = pulses.length;
    await vi.advanceTimersByTimeAsync(5000);
    expect(pulses.length).toBe(before);
  });

  it('does not end at a name that keys pass by, and then says where the probe has come to', async () => {
    const { finder, place, said } = setUp();
    finder.begin('gate');
    await vi.advanceTimersByTimeAsync(100);
    for (const x of [0.04, 0.045, 0.05]) {
      Object.assign(place, { x, y: target.y });
      finder.moved(true);
      void Promise.resolve(finder.words()()).then((text) => text && said.push(text));
      expect(finder.isFollowedByKeys).toBe(true);
      await vi.advanceTimersByTimeAsync(50);
    }
    await vi.advanceTimersByTimeAsync(1000);
    expect(finder.isLeading).toBe(true);
    expect(said).not.toContain('Here: gate.');
    Object.assign(place, target);
    finder.moved(true);
    void Promise.resolve(finder.words()()).then((text) => text && said.push(text));
    await vi.advanceTimersByTimeAsync(1000);
    expect(said[said.length - 1]).toBe('Here: gate.');
    expect(finder.isLeading || finder.isFollowedByKeys).toBe(false);
  });
});

describe('a name', () => {
  it('has at least one character that can be seen', () => {
    for (const empty of ['', '  ', '\u202e', '\u200b\t']) expect(problemOf(empty)).not.toBeNull();
    for (const name of ['a', 'בית', '<b>', '1']) expect(problemOf(name)).toBeNull();
  });
});
