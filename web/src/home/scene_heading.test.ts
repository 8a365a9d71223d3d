// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, test } from 'vitest';
import { shortForm } from './scene_heading';

describe('The short form of a description', () => {
  test('is the whole of a short one', () => {
    expect(shortForm('Seen from the south. Two towers.')).toEqual({ short: 'Seen from the south. Two towers.', rest: '' });
  });

  test('is the first sentence of a long one, and nothing is lost', () => {
    const text = `The town hall, seen from the south. ${'Its two towers are of different heights. '.repeat(4)}`.trim();
    const { short, rest } = shortForm(text);
    expect(short).toBe('The town hall, seen from the south.');
    expect(`${short} ${rest}`).toBe(text);
  });

  test('is never cut inside a sentence', () => {
    const text = 'a very long sentence without an end '.repeat(10);
    expect(shortForm(text)).toEqual({ short: text, rest: '' });
  });
});
