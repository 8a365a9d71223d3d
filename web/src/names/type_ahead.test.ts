// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { TypeAhead } from './type_ahead';

const names = ['line 10', 'line 2', 'line 1', 'Übergang', 'bench', 'bench', 'l'];
const entries = names.map((name) => ({ name, words: `${name}, here` }));

/** What is selected after each letter, typed `pause` ms apart. */
function typed(text: string, pause = 300, from = 0): number[] {
  const search = new TypeAhead();
  let selected = from;
  return [...text].map((letter, k) => (selected = search.type(letter, 1000 + k * pause, entries, selected) ?? selected));
}

describe('letters in the list of names', () => {
  it('prefer the very name to a longer one', () => {
    expect(typed('line 1').at(-1)).toBe(2);
    expect(typed('line 10').at(-1)).toBe(0);
    expect(typed('LINE 2').at(-1)).toBe(1);
    expect(typed('ub').at(-1)).toBe(3);
  });
  it('wait for a slow hand', () => {
    expect(typed('line 1', 1900).at(-1)).toBe(2);
    // "1" alone begins no name.
    expect(typed('line 1', 2100)).toEqual([1, 1, 1, 1, 1, 1]);
  });
  it('go from one to the next by one letter', () => {
    expect(typed('lll')).toEqual([1, 2, 6]);
    expect(typed('bb', 300, 4)).toEqual([5, 4]);
  });
  it('leave what is selected where nothing fits', () => {
    expect(typed('bx')).toEqual([4, 4]);
    expect(typed(' ')).toEqual([0]);
    expect(new TypeAhead().type('a', 0, [], -1)).toBeNull();
  });
});
