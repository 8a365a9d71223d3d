// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What typed letters select in the list of names. A browser's own search takes the first entry that begins with them, so that
// "line 1" may never be found behind "line 10", and begins anew after a second, which is too short for a slow hand.

export interface Entry {
  name: string;
  /** The name and more, as it is listed. */
  words: string;
}

/** Letters with a longer pause between them begin anew (ms). */
const patience = 2000;

const fold = (text: string) => text.normalize('NFD').replace(/\p{M}/gu, '').toLowerCase();

export class TypeAhead {
  private typed = '';
  private typedAt = -Infinity;

  /**
   * The index to select after one more letter; null: the letter selects nothing. An entry with exactly the typed name comes
   * first, then one that begins so, from the selected one on. A letter alone, and the same again, goes to the next one.
   */
  type(letter: string, now: number, entries: readonly Entry[], selected: number): number | null {
    if (now - this.typedAt > patience) this.typed = '';
    if (this.typed === '' && letter.trim() === '') return null;
    this.typedAt = now;
    this.typed += fold(letter);
    const isRepeated = [...this.typed].every((one) => one === this.typed[0]);
    const exact = entries.findIndex(({ name }) => fold(name) === this.typed);
    if (exact >= 0 && !isRepeated) return exact;
    const begins = (text: string, from: number): number | null => {
      for (let k = 0; k < entries.length; ++k) {
        const index = (from + k) % entries.length;
        if (fold(entries[index]!.words).startsWith(text)) return index;
      }
      return null;
    };
    if (this.typed.length === 1) return begins(this.typed, selected + 1);
    return begins(this.typed, Math.max(0, selected)) ?? (isRepeated ? begins(this.typed[0]!, selected + 1) : null);
  }
}
