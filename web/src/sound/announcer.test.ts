// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { Announcer, Importance } from './announcer';

describe('the announcer', () => {
  const said: string[] = [];
  const fresh = () => {
    said.length = 0;
    return new Announcer((text) => said.push(text));
  };
  it('speaks at once, then at most once per second, the newest of equal importance', () => {
    const announcer = fresh();
    for (let t = 0; t < 1000; t += 10) announcer.say(`${t}`, Importance.motion, t);
    expect(said).toEqual(['0']);
    announcer.tick(999);
    expect(said).toEqual(['0']);
    announcer.tick(1000);
    expect(said).toEqual(['0', '990']);
  });
  it('drops expired sentences', () => {
    const announcer = fresh();
    announcer.say('a', Importance.motion, 0);
    announcer.say('b', Importance.motion, 100, 300);
    announcer.tick(1000);
    expect(said).toEqual(['a']);
  });
  it('does not replace an answer by a motion, but by a fault', () => {
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
  it('says a later motion after an answer', () => {
    const announcer = fresh();
    announcer.say('opening', Importance.news, 0);
    announcer.say('in the middle', Importance.answer, 10);
    announcer.say('a step to the right', Importance.motion, 20);
    announcer.tick(1000);
    expect(announcer.due(1000)).toBe(1000);
    announcer.tick(2000);
    expect(said).toEqual(['opening', 'in the middle', 'a step to the right']);
    expect(announcer.due(2000)).toBe(null);
  });
  it('computes a sentence when it speaks, and skips an obsolete one', () => {
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
  it('requests a sentence when its turn comes, and says it when it arrives', async () => {
    const announcer = fresh();
    announcer.say('first', Importance.motion, 0);
    let asked = 0;
    announcer.say(() => Promise.resolve(`answer ${(asked += 1)}`), Importance.answer, 100);
    announcer.tick(900);
    expect(asked).toBe(0);
    announcer.tick(1000);
    await Promise.resolve();
    expect(said).toEqual(['first', 'answer 1']);
  });
  it('keeps less important sentences back until a requested one arrives, but not for ever', async () => {
    const announcer = fresh();
    let answer: (text: string) => void = () => undefined;
    announcer.say(() => new Promise<string>((resolve) => (answer = resolve)), Importance.news, 0);
    announcer.say('a name', Importance.motion, 1500);
    expect(said).toEqual([]);
    expect(announcer.due(1500)).toBe(3500);
    answer('opening');
    await Promise.resolve();
    expect(said).toEqual(['opening']);
    announcer.say(() => new Promise<string>((resolve) => (answer = resolve)), Importance.news, 3000);
    announcer.say('another name', Importance.motion, 7000);
    announcer.tick(8000);
    answer('too late');
    await Promise.resolve();
    expect(said).toEqual(['opening', 'another name']);
  });
  it('says an answer also after a page that was busy for seconds', () => {
    const announcer = fresh();
    announcer.say('reading', Importance.answer, 0);
    announcer.say('read', Importance.answer, 300);
    announcer.tick(5000);
    expect(said).toEqual(['reading', 'read']);
  });
  it('drops an answer that arrives after another sentence', async () => {
    const announcer = fresh();
    let answer: (text: string) => void = () => undefined;
    announcer.say(() => new Promise<string>((resolve) => (answer = resolve)), Importance.answer, 0);
    announcer.say('fault', Importance.fault, 1100);
    answer('too late');
    await Promise.resolve();
    expect(said).toEqual(['fault']);
  });
});
