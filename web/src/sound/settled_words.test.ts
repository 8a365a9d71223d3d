// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { SettledWords } from './settled_words';

describe('a sentence that changes', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());
  const said: string[] = [];
  const words = () => new SettledWords((text) => said.push(text), 1000);
  beforeEach(() => void said.splice(0));

  it('is said once, when it has settled', () => {
    const depth = words();
    for (const percent of [90, 80, 70]) {
      depth.set(`${percent} %`);
      vi.advanceTimersByTime(600);
    }
    expect(said).toEqual([]);
    vi.advanceTimersByTime(600);
    depth.set('70 %');
    vi.advanceTimersByTime(5000);
    expect(said).toEqual(['70 %']);
  });
  it('is not said if it is again what was said, was heard otherwise, or is empty', () => {
    const depth = words();
    depth.heard('100 %');
    depth.set('90 %');
    depth.set('100 %');
    vi.advanceTimersByTime(5000);
    depth.set('80 %');
    depth.heard('80 %');
    vi.advanceTimersByTime(5000);
    depth.set('');
    vi.advanceTimersByTime(5000);
    expect(said).toEqual([]);
  });
});
