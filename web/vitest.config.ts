// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from 'vitest/config';

export default defineConfig({
  server: { host: '127.0.0.1' }, // by number: a bare system need not know the name localhost
  test: { include: ['src/**/*.test.ts'], environment: 'node' },
});
