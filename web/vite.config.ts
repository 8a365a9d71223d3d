// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { defineConfig } from 'vite';

export default defineConfig({
  build: {
    target: 'es2022',
    // The page may load only files of its own server: nothing goes inline.
    assetsInlineLimit: 0,
    modulePreload: false,
    chunkSizeWarningLimit: 900,
    rollupOptions: { input: ['index.html', 'shelf.html'] },
  },
});
