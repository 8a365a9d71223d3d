// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Announcements for the live region: at most one per second, the most important first, and none that is out of date.

/** A sentence that is computed or requested when its turn comes; null if it is obsolete. */
export type Words = () => string | null | Promise<string | null>;

/** The sentence when there is no scene. */
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
  /** In order of decreasing importance: less important sentences here are newer than more important ones. */
  private waiting: Waiting[] = [];
  private spokeAt = -Infinity;

  constructor(
    private readonly speak: (text: string) => void,
    private readonly gap = 1000,
  ) {}

  /**
   * Says it now if a second has passed, else later, unless a sentence of equal importance replaces it or it
   * expires (ms). More important waiting sentences come first.
   */
  say(words: Words | string, importance: Importance, now: number, lifetime = 2500): void {
    const before = this.waiting.filter((entry) => entry.importance > importance && entry.until >= now);
    this.waiting = [...before, { words: typeof words === 'string' ? () => words : words, importance, until: now + lifetime }];
    this.tick(now);
  }

  /** The time until tick() must be called (ms); null if nothing waits. */
  due(now: number): number | null {
    return this.waiting.length === 0 ? null : Math.max(0, this.spokeAt + this.gap - now);
  }

  /** Says the next waiting sentence if it is time. */
  tick(now: number): void {
    if (now - this.spokeAt < this.gap) return;
    this.waiting = this.waiting.filter((entry) => entry.until >= now);
    const next = this.waiting.shift();
    if (next === undefined) return;
    const text = next.words();
    if (text === null || text === '') return this.tick(now);
    this.spokeAt = now;
    if (typeof text === 'string') return this.speak(text);
    // A requested sentence is said when it arrives, unless something else was said meanwhile.
    void text.then((answer) => answer && this.spokeAt === now && this.speak(answer));
  }
}
