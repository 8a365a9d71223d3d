// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Checks imports between rooms: rooms.json is the rule, docs/page.md repeats it. Files at the level of src/ may be imported
// by every room and import none. The C++ side has the same rule in cmake/Layers.cmake.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join, posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import rooms from './rooms.json';

type Table = Record<string, { holds: string; may_use: string[] }>;
/** Maps a file to its imports; paths are relative to src/. */
type Imports = Record<string, string[]>;

const src = dirname(fileURLToPath(import.meta.url));
const generated = 'generated';
/** Data beside src/, as the catalogues. */
const outside = '..';
const folderOf = (path: string) => (path.includes('/') ? path.slice(0, path.indexOf('/')) : '');

function importsIn(folder: string): Imports {
  const files = readdirSync(join(src, folder), { withFileTypes: true });
  const here = files.filter((file) => file.isFile() && file.name.endsWith('.ts')).map((file) => posix.join(folder, file.name));
  const below = files.filter((file) => file.isDirectory() && file.name !== generated).map((file) => importsIn(posix.join(folder, file.name)));
  const own = here.map((path) => {
    const text = readFileSync(join(src, path), 'utf8');
    const relative = [...text.matchAll(/(?:from|import)\s*\(?\s*'(\.[^']*)'/g)].map(([, to]) => posix.join(dirname(path), to!));
    return [path, relative] as const;
  });
  return Object.assign(Object.fromEntries(own), ...below) as Imports;
}

/** Every violation of the table, as a sentence. */
function breaches(imports: Imports, table: Table): string[] {
  const found: string[] = [];
  const names = Object.keys(table);
  const used = new Set<string>();
  for (const [path, targets] of Object.entries(imports)) {
    const room = folderOf(path);
    if (room !== '' && !names.includes(room)) found.push(`${path}: ${room} is not a room of rooms.json`);
    for (const to of targets.map(folderOf)) {
      if (to === room || to === '' || to === generated || to === outside) continue;
      if (table[room]?.may_use.includes(to)) {
        if (!path.endsWith('.test.ts')) used.add(`${room} ${to}`);
      } else if (!path.endsWith('.test.ts') || room === '') {
        found.push(`${path}: ${room || 'the level of src/'} may not import ${to}`);
      }
    }
  }
  names.forEach((name, k) => {
    for (const below of table[name]!.may_use) {
      if (!names.slice(0, k).includes(below)) found.push(`rooms.json: ${name} may use ${below}, which does not stand above it`);
      else if (!used.has(`${name} ${below}`)) found.push(`rooms.json: no file of ${name} uses ${below}`);
    }
  });
  return found;
}

describe('the rooms of the page', () => {
  it('import only what rooms.json allows them, and need every permission', () => expect(breaches(importsIn(''), rooms)).toEqual([]));

  it.each(Object.keys(rooms))('%s has a README of three statements', (room) => {
    const readme = join(src, room, 'README.md');
    expect(existsSync(readme)).toBe(true);
    const statements = readFileSync(readme, 'utf8').split('\n').filter((line) => line !== '');
    expect(statements.map((line) => /^(Entry file|Used by):/.exec(line)?.[1] ?? 'what')).toEqual(['what', 'Entry file', 'Used by']);
  });

  it('are the same in docs/page.md', () => {
    const docs = readFileSync(join(src, '..', '..', 'docs', 'page.md'), 'utf8');
    const rows = [...docs.matchAll(/^\| `src\/(\w+)` \| (.*) \| (.*) \|$/gm)].map(([, name, holds, uses]) => [name, holds, uses]);
    expect(rows).toEqual(Object.entries(rooms).map(([name, { holds, may_use }]) => [name, holds, may_use.join(', ')]));
  });
});

describe('the check of the rooms', () => {
  const table: Table = { low: { holds: '', may_use: [] }, high: { holds: '', may_use: ['low'] } };
  const good: Imports = { 'low/a.ts': ['dom', 'generated/protocol'], 'high/b.ts': ['low/a', 'high/c'], 'dom.ts': [] };
  it('passes a tree that keeps the table', () => expect(breaches(good, table)).toEqual([]));
  it('refuses an import upwards, but not of a test', () => {
    expect(breaches({ ...good, 'low/d.ts': ['high/b'] }, table)).toEqual(['low/d.ts: low may not import high']);
    expect(breaches({ ...good, 'low/d.test.ts': ['high/b'] }, table)).toEqual([]);
  });
  it('refuses a shared file that imports a room', () =>
    expect(breaches({ ...good, 'dom.ts': ['low/a'] }, table)).toEqual(['dom.ts: the level of src/ may not import low']));
  it('refuses a folder that is no room', () =>
    expect(breaches({ ...good, 'attic/e.ts': [] }, table)).toEqual(['attic/e.ts: attic is not a room of rooms.json']));
  it('refuses a permission that no file needs, and one that points upwards', () => {
    expect(breaches({ 'high/b.ts': [] }, table)).toEqual(['rooms.json: no file of high uses low']);
    expect(breaches({}, { high: { holds: '', may_use: ['low'] }, low: { holds: '', may_use: [] } })).toEqual(['rooms.json: high may use low, which does not stand above it']);
  });
});
