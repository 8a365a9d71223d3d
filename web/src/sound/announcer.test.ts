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
  it('says where the probe is once an answer was said, when the probe moved after the question', () => {
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
  it('asks when its turn comes, and says the answer when it arrives', async () => {
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
  it('drops an answer that comes after something else was said', async () => {
    const announcer = fresh();
    let answer: (text: string) => void = () => undefined;
    announcer.say(() => new Promise<string>((resolve) => (answer = resolve)), Importance.answer, 0);
    announcer.say('fault', Importance.fault, 1100);
    answer('too late');
    await Promise.resolve();
    expect(said).toEqual(['fault']);
  });
});
