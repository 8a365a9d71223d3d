// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { defaults, preferencesCookie, ranges, readPreferences } from './preferences';

describe('preferences', () => {
  const jar = (text: string) => `other=1; palpable_page=${encodeURIComponent(text)}; more=2`;
  it('are the defaults for a missing or invalid cookie', () => {
    for (const cookies of ['', jar('{'), jar('7'), jar('null'), 'palpable_page=%', jar('{"volume":1e9,"theme":"neon","sound":1,"__proto__":{"tilt":3}}')])
      expect(readPreferences(cookies)).toEqual(defaults);
  });
  it('survive a round trip', () => {
    const mine = { ...defaults, volume: 20, theme: 'dark' as const, sound: false };
    expect(readPreferences(preferencesCookie(mine).split('; ')[0]!)).toEqual(mine);
  });
  it('are stored over the whole range of the sliders', () => {
    for (const [key, { min, max }] of Object.entries(ranges))
      for (const value of [min, max])
        expect(readPreferences(preferencesCookie({ ...defaults, [key]: value }).split('; ')[0]!)).toMatchObject({ [key]: value });
  });
  it('remove the cookie when all are the defaults', () => expect(preferencesCookie(defaults)).toContain('Max-Age=0'));
});
