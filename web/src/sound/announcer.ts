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
  private waiting: Waiting | null = null;
  private spokeAt = -Infinity;

  constructor(
    private readonly speak: (text: string) => void,
    private readonly gap = 1000,
  ) {}

  /** Says it now if a second has passed, else when it has, unless something as important comes or it grows old (ms). */
  say(words: Words | string, importance: Importance, now: number, lifetime = 2500): void {
    const entry = { words: typeof words === 'string' ? () => words : words, importance, until: now + lifetime };
    if (this.waiting === null || this.waiting.until < now || importance >= this.waiting.importance) this.waiting = entry;
    this.tick(now);
  }

  /** When tick() has something to do (ms from `now`); null if nothing waits. */
  due(now: number): number | null {
    return this.waiting === null ? null : Math.max(0, this.spokeAt + this.gap - now);
  }

  /** Says what waits, if it is time. */
  tick(now: number): void {
    if (this.waiting === null || now - this.spokeAt < this.gap) return;
    const { words, until } = this.waiting;
    this.waiting = null;
    if (until < now) return;
    const text = words();
    if (text === null || text === '') return;
    this.spokeAt = now;
    if (typeof text === 'string') return this.speak(text);
    // What was asked for is said when it comes, unless something was said meanwhile.
    void text.then((answer) => answer && this.spokeAt === now && this.speak(answer));
  }
}
