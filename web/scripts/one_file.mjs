// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Puts the built page and the touch's WebAssembly into one file: node scripts/one_file.mjs FOLDER TOUCH.wasm OUT.html
// `palpable export` replaces the marks that stand for a scene (src/palpable/onefile/page_template.hpp).
import { createHash } from 'node:crypto';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const [folder, wasm, out] = process.argv.slice(2).map((path) => resolve(path));
// Where emscripten could not compile it, there is no page.
if (statSync(wasm).size === 0) {
  writeFileSync(out, '');
  process.exit();
}
const built = readFileSync(join(folder, 'index.html'), 'utf8');

function only(pattern, what) {
  const found = [...built.matchAll(pattern)];
  if (found.length !== 1) throw new Error(`one_file.mjs: the built page has ${found.length} ${what}, not one`);
  return found[0];
}
const script = only(/<script type="module"[^>]*src="([^"]+)"[^>]*><\/script>/g, 'scripts');
const style = only(/<link rel="stylesheet"[^>]*href="([^"]+)"[^>]*>/g, 'style sheets');
const icon = only(/<link rel="icon"[^>]*>/g, 'icons');
const fileAt = (path) => readFileSync(join(folder, path), 'utf8');

const css = fileAt(style[1]).trim();
// The parser of HTML must not find an end in it.
const app = fileAt(script[1]).trim().replaceAll('</script', '<\\/script');
const watch = readFileSync(join(here, '..', 'src', 'onefile', 'watch.js'), 'utf8').replace(/^\/\/.*\n/gm, '').trim();
const picture = `data:image/svg+xml;base64,${readFileSync(join(here, '..', 'public', 'favicon.svg')).toString('base64')}`;

const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
// 'strict-dynamic' for the audio worklet: what these two scripts load themselves runs too, but nothing that markup names.
const policy = [
  "default-src 'none'",
  `script-src ${hash(watch)} ${hash(app)} 'strict-dynamic' 'wasm-unsafe-eval'`,
  `style-src ${hash(css)}`,
  'img-src data: blob:',
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');
const data = (id, text) => `<script type="text/plain" id="${id}">${text}</script>\n`;

const page = built
  .replace(script[0], '')
  .replace(style[0], () => `<style>${css}</style>\n    <script>${watch}</script>`)
  .replace(icon[0], `<link rel="icon" href="${picture}" type="image/svg+xml">`)
  .replace('<meta charset="utf-8">', () => `<meta charset="utf-8">\n    <meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace(/<title>[^<]*<\/title>/, '<title>%PALPABLE_TITLE%</title>')
  .replaceAll('src="/favicon.svg"', `src="${picture}"`)
  .replace(
    '</body>',
    () =>
      `<noscript><p>This page needs JavaScript: it touches the scene in your browser.</p></noscript>\n` +
      `<script type="module">${app}</script>\n` +
      data('data-touch', gzipSync(readFileSync(wasm), { level: 9 }).toString('base64')) +
      data('data-scene', '%PALPABLE_SCENE%') +
      data('data-picture', '%PALPABLE_PICTURE%') +
      data('data-second', '%PALPABLE_SECOND%') +
      // The last thing in the file: whoever finds it has the whole file.
      '<i id="data-end" hidden></i>\n  </body>',
  );
const addresses = /(?:src|href)="(?!data:|#)[^"]*"/.exec(page.slice(0, page.indexOf('<script type="module">')));
if (addresses) throw new Error(`one_file.mjs: the page refers to ${addresses[0]}`);
writeFileSync(out, page);
