// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

export default defineConfig({
  // The network that finds faces: files of a package, which exports its library only.
  resolve: { alias: { 'head-model': fileURLToPath(new URL('node_modules/@vladmandic/human/models', import.meta.url)) } },
  build: {
    target: 'es2022',
    // The page may load only files of its own server: nothing goes inline.
    assetsInlineLimit: 0,
    modulePreload: false,
    chunkSizeWarningLimit: 900,
    rollupOptions: { input: ['index.html', 'shelf.html'] },
  },
});
