// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Announcements for the live region: at most one per second, the most important first, and none that is out of date.

import { t } from '../language';

/** A sentence that is computed or requested when its turn comes; null if it is obsolete. */
export type Words = () => string | null | Promise<string | null>;

/** The sentence when there is no scene. */
export const noScene = t('There is no scene yet.');

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

/** How long a sentence may wait (ms). What says where a probe is, is soon untrue; the rest is late on a busy machine only. */
const lifetimeOf = (importance: Importance): number => (importance === Importance.motion ? 2500 : 10_000);
/** How long less important sentences wait for a requested one (ms). */
const patience = 5000;

export class Announcer {
  /** In order of decreasing importance: less important sentences here are newer than more important ones. */
  private waiting: Waiting[] = [];
  private spokeAt = -Infinity;
  /** The sentence that was requested and has not arrived. */
  private requested: { importance: Importance; until: number } | null = null;

  constructor(
    private readonly speak: (text: string) => void,
    private readonly gap = 1000,
  ) {}

  /**
   * Says it now if a second has passed, else later, unless a sentence of equal importance replaces it or it
   * expires (ms). More important waiting sentences come first.
   */
  say(words: Words | string, importance: Importance, now: number, lifetime = lifetimeOf(importance)): void {
    const before = this.waiting.filter((entry) => entry.importance > importance && entry.until >= now);
    this.waiting = [...before, { words: typeof words === 'string' ? () => words : words, importance, until: now + lifetime }];
    this.tick(now);
  }

  /** The time until tick() must be called (ms); null if nothing waits. */
  due(now: number): number | null {
    const [next] = this.waiting;
    if (next === undefined) return null;
    const free = this.mustWait(next, now) ? this.requested!.until : this.spokeAt + this.gap;
    return Math.max(0, free - now);
  }

  /** Says the next waiting sentence if it is time. */
  tick(now: number): void {
    if (now - this.spokeAt < this.gap) return;
    this.waiting = this.waiting.filter((entry) => entry.until >= now);
    const [next] = this.waiting;
    if (next === undefined || this.mustWait(next, now)) return;
    this.waiting.shift();
    const text = next.words();
    if (text === null || text === '') return this.tick(now);
    this.spokeAt = now;
    this.requested = null;
    if (typeof text === 'string') return this.speak(text);
    // A requested sentence is said when it arrives, unless another of its importance was said meanwhile.
    const request = (this.requested = { importance: next.importance, until: now + patience });
    void text.then((answer) => {
      if (this.requested !== request) return;
      this.requested = null;
      if (answer) this.speak(answer);
    });
  }

  /** A more important sentence was requested, and is still to come. */
  private mustWait({ importance }: Waiting, now: number): boolean {
    return this.requested !== null && importance < this.requested.importance && now < this.requested.until;
  }
}
