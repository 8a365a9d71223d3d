// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { formsOf } from './forms';

describe('what a scene can be saved as', () => {
  it('a page for a phone comes first', () => expect(formsOf(['scene', 'swell', 'phone']).map(({ form }) => form)).toEqual(['phone', 'swell', 'scene']));
  it('only what the program offers', () => expect(formsOf(['print', 'of a newer program']).map(({ form }) => form)).toEqual(['print']));
  it('drawings have a paper', () => expect(formsOf(['phone', 'swell', 'braille']).map(({ onPaper }) => onPaper)).toEqual([false, true, true]));
});
