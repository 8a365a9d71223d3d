// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Surface, type Place } from '../surface';
import { Guide, type GuideView } from './guide';
import { noProgress, progressCookie, readProgress, type Progress } from './memory';
import { meant, sentenceOf, stepNames, stepsOf, type Situation } from './steps';
import { wayWords } from '../way_words';

const side = 101;
/** A plate of 100 mm with a block of 10 mm, from x = 20 mm on. */
const block = new Surface(side, side, Float32Array.from({ length: side * side }, (_, k) => (k % side >= 70 ? 0.01 : 0)), 0.1, 0.1);
const level = new Surface(side, side, new Float32Array(side * side), 0.1, 0.1);

function setUp(surface = block, progress: Progress = noProgress) {
  const said: string[] = [];
  const kept: Progress[] = [];
  const shown: { view: GuideView | null } = { view: null };
  const place: Place = { x: 0, y: 0 };
  const state = { listens: true };
  const guide = new Guide(
    {
      situation: () => ({ input: 'keys', kind: 'relief', sound: true }),
      surface: () => surface,
      heightFactor: () => 1,
      place: () => ({ ...place }),
      say: (words, heard) => {
        if (!state.listens) return;
        said.push(words);
        heard();
      },
      show: (view) => (shown.view = view),
      keep: (one) => kept.push(one),
    },
    progress,
  );
  const go = (x: number, y = place.y) => {
    const steps = Math.max(1, Math.ceil(Math.hypot(x - place.x, y - place.y) / 0.001));
    const from = { ...place };
    for (let k = 1; k <= steps; ++k) {
      place.x = from.x + ((x - from.x) * k) / steps;
      place.y = from.y + ((y - from.y) * k) / steps;
      guide.moved({ ...place });
    }
  };
  const step = () => /Step (\d+)/.exec(shown.view?.title ?? '')?.[1] ?? 'none';
  return { guide, said, kept, shown, go, step, state };
}

describe('the guided start', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it('waits for each step to be done on the scene, and for nothing less', () => {
    const { guide, go, step, said, kept } = setUp();
    guide.begin('ears');
    vi.advanceTimersByTime(0);
    expect(said).toEqual([expect.stringMatching(/^Step 1 of 9: Press Page Down/)]);
    const stays = (deed: () => void) => {
      const before = step();
      deed();
      expect(step()).toBe(before);
    };
    const goesOn = (deed: () => void) => {
      const before = Number(step());
      deed();
      expect(step()).toBe(String(before + 1));
      vi.advanceTimersByTime(2000);
    };
    stays(() => guide.did('touched'));
    goesOn(() => guide.did('pressed'));
    // An edge: not the level ground, nor standing still.
    stays(() => go(0.01));
    goesOn(() => go(0.019));
    // Along it: neither away from it, nor across.
    stays(() => go(0.001));
    stays(() => go(0.019));
    goesOn(() => go(0.019, 0.02));
    stays(() => go(-0.01));
    goesOn(() => go(0.03));
    stays(() => guide.did('touched'));
    goesOn(() => guide.did('asked where'));
    goesOn(() => guide.listed(3));
    stays(() => guide.did('asked where'));
    goesOn(() => guide.did('found'));
    goesOn(() => guide.did('undid'));
    stays(() => guide.did('undid'));
    guide.leave();
    expect(guide.isRunning).toBe(false);
    expect(kept[kept.length - 1]).toEqual({ offered: true, eyes: 0, ears: stepNames.length });
  });

  it('is taken up where it was left, also in another visit', () => {
    const first = setUp();
    first.guide.begin('ears');
    for (let k = 0; k < 4; ++k) first.guide.skip();
    first.guide.leave();
    expect(first.shown.view).toBeNull();
    const cookie = progressCookie(first.kept[first.kept.length - 1]!).split('; ')[0]!;
    const { guide, said, step } = setUp(block, readProgress(`other=1; ${cookie}`));
    expect(guide.isToBeOffered).toBe(false);
    expect(guide.stepOf('ears')).toBe(5);
    expect(guide.stepOf('eyes')).toBe(0);
    guide.begin('ears');
    vi.advanceTimersByTime(0);
    expect(said[0]).toMatch(/^You left it here\. Step 5 of 9: Press P/);
    guide.leave();
    guide.begin('eyes');
    expect(step()).toBe('1');
  });

  it('says a step after the answer to what was done, again until it is heard, and on asking', () => {
    const { guide, said, state } = setUp();
    guide.begin('ears');
    // What is done before the sentence does not count.
    for (const deed of ['touched', 'pressed'] as const) guide.did(deed);
    vi.advanceTimersByTime(0);
    expect(said).toEqual([expect.stringMatching(/^Step 1/)]);
    state.listens = false;
    guide.did('touched');
    guide.did('pressed');
    vi.advanceTimersByTime(1900);
    state.listens = true;
    expect(said).toHaveLength(1);
    state.listens = false;
    vi.advanceTimersByTime(200);
    state.listens = true;
    vi.advanceTimersByTime(3600);
    expect(said[1]).toMatch(/^Good\. Step 2 of 9: Find an edge.*The nearest one is \d+ millimetres right\.$/);
    vi.advanceTimersByTime(60_000);
    expect(said).toHaveLength(2);
    guide.again();
    vi.advanceTimersByTime(0);
    expect(said[2]).toMatch(/^Step 2 of 9/);
  });

  it('says nothing after it was left, and does nothing when it does not run', () => {
    const { guide, said, kept } = setUp();
    for (const act of [() => guide.skip(), () => guide.again(), () => guide.leave(), () => guide.did('pressed'), () => guide.moved({ x: 0, y: 0 })]) act();
    guide.begin('eyes');
    guide.leave();
    vi.advanceTimersByTime(60_000);
    expect(said).toEqual([]);
    expect(kept).toHaveLength(1);
  });

  it('leaves out what a scene does not have', () => {
    const { guide, said, step } = setUp(level);
    guide.begin('ears');
    guide.skip();
    vi.advanceTimersByTime(0);
    expect(said[said.length - 1]).toMatch(/^Step 2 of 7: Heights are tones/);
    guide.skip();
    guide.skip();
    vi.advanceTimersByTime(0);
    guide.listed(0);
    vi.advanceTimersByTime(3000);
    expect(said[said.length - 1]).toMatch(/^Good\. Nothing has a name here yet\. Step 5 of 6: Every change/);
    expect(step()).toBe('5');
  });

  it('outlines what is meant for the eyes, and marks places', () => {
    const { guide, shown } = setUp();
    guide.begin('eyes');
    guide.skip();
    expect(shown.view).toMatchObject({ meant: meant.edge, at: { x: expect.closeTo(0.019, 2) } });
    guide.begin('ears');
    expect(shown.view).toMatchObject({ meant: [], at: null });
  });
});

describe('its steps', () => {
  const situations: Situation[] = (['eyes', 'ears'] as const).flatMap((way) =>
    (['keys', 'fingers', 'device'] as const).flatMap((input) =>
      ['relief', 'contours', 'distance-field'].flatMap((kind) => [true, false].map((sound) => ({ way, input, kind, sound, hasEdges: true, hasNames: true }))),
    ),
  );
  it('have a sentence in every situation, and name no key where there are only fingers', () => {
    for (const situation of situations)
      for (const step of stepNames) {
        const sentence = sentenceOf(step, situation, '3 millimetres up');
        expect(sentence).toMatch(/^[A-Z“].*\.$/);
        // An edge that is here is said, too.
        if (step === 'edge') expect([sentence, sentenceOf(step, situation, ''), sentenceOf(step, situation)].map((one) => /nearest one is ([^.]*)\./.exec(one)?.[1])).toEqual(['3 millimetres up', 'where you are', undefined]);
        if (situation.input === 'fingers') expect(sentence).not.toMatch(/Press (?:[A-Z]\b|Escape|End|Control)|arrow keys/);
        if (situation.input === 'device') expect(sentence).not.toMatch(/arrow keys|End takes/);
      }
  });
  it('are fewer without edges and names', () => {
    expect(stepsOf({ kind: 'relief', hasEdges: true, hasNames: null })).toEqual(stepNames);
    expect(stepsOf({ kind: 'contours', hasEdges: true, hasNames: null })).toEqual(['edge', 'follow', 'where', 'list', 'find', 'undo', 'leave']);
    expect(stepsOf({ kind: 'relief', hasEdges: false, hasNames: false })).toEqual(['surface', 'height', 'where', 'list', 'undo', 'leave']);
  });
  it('say the way in millimetres', () => {
    expect(wayWords(0.012, -0.001)).toBe('12 millimetres right, 1 millimetre down');
    expect(wayWords(0, 0.0003)).toBe('');
  });
});

describe('the progress', () => {
  it('is none for a missing or invalid cookie', () => {
    for (const cookies of ['', 'palpable_guide=', 'palpable_guide=9', 'palpable_guide=99.0', 'palpable_guide=1.x', 'palpable_guide=-1.0'])
      expect(readProgress(cookies)).toEqual(noProgress);
  });
});
