// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The one-file page: the same page with another entry, as one script and one style sheet, which scripts/one_file.mjs puts
// into one file.
import { defineConfig } from 'vite';

export default defineConfig({
  plugins: [
    {
      name: 'palpable-onefile-entry',
      transformIndexHtml: { order: 'pre', handler: (html) => html.replace('/src/home/main.ts', '/src/onefile/main.ts') },
    },
  ],
  build: {
    target: 'es2022',
    modulePreload: false,
    cssCodeSplit: false,
    chunkSizeWarningLimit: 900,
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
