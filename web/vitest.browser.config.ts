// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The tests in a real browser, against the real program: PALPABLE names it (docs/page.md).
import { defineConfig } from 'vitest/config';

export default defineConfig({
  server: { host: '127.0.0.1' }, // by number: a bare system need not know the name localhost
  test: {
    include: ['test/**/*.browser.ts'],
    environment: 'node',
    // Each file has its own program and browser. They wait more than they compute, so three run at a time.
    poolOptions: { forks: { minForks: 1, maxForks: 3 } },
    // A busy machine delays a browser past the time that a key press or a pointer's movement counts.
    retry: 1,
    testTimeout: 300_000,
    hookTimeout: 300_000,
  },
});
