// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { niceTop } from './plot';

it('the plot has a round upper limit above its greatest force', () => {
  expect([0, 0.3, 1, 1.2, 3, 7, 55, 5000].map(niceTop)).toEqual([1, 1, 1, 2, 4, 10, 60, 1000]);
});
