// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A sentence that changes with every step of something, and is said once, when it has settled.

export class SettledWords {
  private said = '';
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `quiet`: without a change for this long (ms) it is said. */
  constructor(
    private readonly say: (words: string) => void,
    private readonly quiet = 1500,
  ) {}

  /** The sentence is this one now; empty: there is nothing to say. */
  set(words: string): void {
    clearTimeout(this.timer);
    if (words === this.said) return;
    this.timer = setTimeout(() => {
      this.said = words;
      if (words !== '') this.say(words);
    }, this.quiet);
  }

  /** The person has heard it in another way. */
  heard(words: string): void {
    clearTimeout(this.timer);
    this.said = words;
  }
}
