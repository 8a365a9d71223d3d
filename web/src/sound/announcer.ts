// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Words for the live region: at most one utterance a second, the most important first, and nothing that is out of date.

/** What to say, worked out or asked for when its turn comes; null if there is nothing to say any more. */
export type Words = () => string | null | Promise<string | null>;

/** What is said where there is nothing to describe. */
export const noScene = 'There is no scene yet.';

export enum Importance {
  motion,
  news,
  answer,
  fault,
}

interface Waiting {
  words: Words;
  importance: Importance;
  until: number;
}

export class Announcer {
  /** By falling importance: what is less important here was said later than what is more important. */
  private waiting: Waiting[] = [];
  private spokeAt = -Infinity;

  constructor(
    private readonly speak: (text: string) => void,
    private readonly gap = 1000,
  ) {}

  /**
   * Says it now if a second has passed, else when it has, unless something as important comes or it grows old (ms).
   * What is more important and waits already is said first.
   */
  say(words: Words | string, importance: Importance, now: number, lifetime = 2500): void {
    const before = this.waiting.filter((entry) => entry.importance > importance && entry.until >= now);
    this.waiting = [...before, { words: typeof words === 'string' ? () => words : words, importance, until: now + lifetime }];
    this.tick(now);
  }

  /** When tick() has something to do (ms from `now`); null if nothing waits. */
  due(now: number): number | null {
    return this.waiting.length === 0 ? null : Math.max(0, this.spokeAt + this.gap - now);
  }

  /** Says what waits, if it is time. */
  tick(now: number): void {
    if (now - this.spokeAt < this.gap) return;
    this.waiting = this.waiting.filter((entry) => entry.until >= now);
    const next = this.waiting.shift();
    if (next === undefined) return;
    const text = next.words();
    if (text === null || text === '') return this.tick(now);
    this.spokeAt = now;
    if (typeof text === 'string') return this.speak(text);
    // What was asked for is said when it comes, unless something was said meanwhile.
    void text.then((answer) => answer && this.spokeAt === now && this.speak(answer));
  }
}
