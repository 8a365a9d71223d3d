// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Puts the files of the built page into a C++ source: node scripts/embed.mjs FOLDER OUT.cpp
import { readdirSync, statSync, writeFileSync } from 'node:fs';
import { extname, join, relative, resolve } from 'node:path';

const mediaTypes = {
  '.html': 'text/html; charset=utf-8', '.js': 'text/javascript; charset=utf-8', '.css': 'text/css; charset=utf-8',
  '.svg': 'image/svg+xml', '.png': 'image/png', '.txt': 'text/plain; charset=utf-8',
  '.json': 'application/json', '.wasm': 'application/wasm', '.bin': 'application/octet-stream',
};
const [folder, out] = process.argv.slice(2).map((path) => resolve(path));

function filesIn(dir) {
  return readdirSync(dir).sort().flatMap((name) => {
    const path = join(dir, name);
    return statSync(path).isDirectory() ? filesIn(path) : [path];
  });
}

const assets = filesIn(folder).map((file, i) => {
  const type = mediaTypes[extname(file)];
  if (type === undefined) throw new Error(`embed.mjs: no media type is known for ${file}`);
  return { file, type, path: `/${relative(folder, file)}`, symbol: `palpable_page_asset_${i}` };
});
const asm = assets.map(({ file, symbol }) =>
  [`".globl ${symbol}, ${symbol}_end\\n"`, `"${symbol}:\\n"`, `".incbin ${JSON.stringify(JSON.stringify(file)).slice(1, -1)}\\n"`,
   `"${symbol}_end:\\n"`, '".byte 0\\n"'].map((line) => `    ${line}`).join('\n')).join('\n');
const externs = assets.map(({ symbol }) => `extern const char ${symbol}[];\nextern const char ${symbol}_end[];`).join('\n');
const entries = assets.map(({ path, type, symbol }) =>
  `    {"${path}", "${type}", {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}},`).join('\n');

writeFileSync(out, `// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Made from the built page by web/scripts/embed.mjs.
#include "palpable/page/assets.hpp"

#include <cstddef>

// The assembler takes the files in as they are: no compiler has to read a megabyte of numbers.
asm(".pushsection .rodata\\n"
${asm}
    ".popsection\\n");
extern "C" {
${externs}
}

namespace palpable::page {

const Asset* find_asset(std::string_view path) {
  static const Asset kAssets[] = {
${entries}
  };
  if (path == "/") path = "/index.html";
  for (const Asset& asset : kAssets)
    if (asset.path == path) return &asset;
  return nullptr;
}

}  // namespace palpable::page
`);
