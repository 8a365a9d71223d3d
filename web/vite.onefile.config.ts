// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The one-file page: the same page with another entry, as one script and one style sheet, which scripts/one_file.mjs puts
// into one file.
import { dirname, join } from 'node:path';
import { build, defineConfig, type Plugin, type Rollup } from 'vite';

const inside = '\0worklet inside ';

/** Audio worklets are loaded from an address: here from one that holds their text, since there is no other file. */
const workletsInside: Plugin = {
  name: 'palpable-onefile-worklets',
  enforce: 'pre',
  resolveId(source, importer) {
    const [file, query] = source.split('?');
    return query === 'worker&url' ? `${inside}${join(dirname(importer!), file!)}` : null;
  },
  async load(id) {
    if (!id.startsWith(inside)) return null;
    const file = id.slice(inside.length);
    const lib = { entry: file, formats: ['iife' as const], name: 'worklet' };
    const built = (await build({ configFile: false, logLevel: 'error', publicDir: false, build: { write: false, target: 'es2022', minify: true, lib } })) as Rollup.RollupOutput[];
    const code = JSON.stringify(built[0]!.output[0].code);
    // Of a page from disk a browser loads no worklet from blob:.
    return `export default 'data:text/javascript,' + encodeURIComponent(${code});`;
  },
};

export default defineConfig({
  plugins: [
    workletsInside,
    {
      name: 'palpable-onefile-entry',
      transformIndexHtml: { order: 'pre', handler: (html) => html.replace('/src/home/main.ts', '/src/onefile/main.ts').replace(/ *<!-- head-camera -->[^]*<!-- \/head-camera -->\n/, '') },
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
