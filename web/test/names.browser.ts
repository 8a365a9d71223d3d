// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Names on the page: given, listed, found, changed, deleted and undone by keys alone; and a simulated blind person who looks for
// names in scenes of five kinds, only with PALPABLE_TARGETS (200 for all of them), since it takes minutes.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, openPage, program, says, startProgram, violations, type Opened, type Running } from './harness';
import { NameAgent, type Search } from './name_agent';

const folder = mkdtempSync(join(tmpdir(), 'palpable-names-'));
const palpable = (...words: string[]) => execFileSync(program, words, { encoding: 'utf8', cwd: folder, stdio: ['ignore', 'pipe', 'ignore'] });
let browser: Browser;
beforeAll(async () => {
  browser = await launch({ webgl: false });
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

describe('names by keys', () => {
  let running: Running;
  let opened: Opened;
  let page: Page;
  const scene = join(folder, 'drawing.palp');
  beforeAll(async () => {
    palpable('make', 'sample:drawing', '-o', scene);
    running = await startProgram({ instead: ['touch', scene, '--no-browser'] });
    opened = await openPage(browser, running.address);
    ({ page } = opened);
  });
  afterAll(async () => {
    await opened?.context.close();
    await running?.stop();
  });

  it('a place is named where the probe is, and said', async () => {
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('t');
    await page.getByLabel('Name', { exact: true }).waitFor();
    expect(await violations(page)).toEqual([]);
    await keepPicture(page, 'names-form');
    await page.keyboard.press('Enter');
    await page.getByText('Type a name first.').waitFor();
    await page.keyboard.type('<b>mast</b>');
    await page.keyboard.press('Tab');
    await page.keyboard.type('It is tall.');
    await page.keyboard.press('Enter');
    await says(page, 'Named: <b>mast</b>');
    await page.keyboard.press('p');
    await says(page, 'It is tall.');
  });

  it('the list has the nearest first, and can rename and delete', async () => {
    await page.keyboard.press('l');
    const list = page.getByLabel('Names, the nearest first');
    await list.waitFor();
    expect(await list.locator('option').first().textContent()).toBe('<b>mast</b>, here');
    expect(await list.locator('option').count()).toBeGreaterThan(2);
    expect(await violations(page)).toEqual([]);
    await keepPicture(page, 'names-list');
    await page.getByRole('button', { name: 'Rename' }).press('Enter');
    await page.getByLabel('Name', { exact: true }).fill('mast');
    await page.keyboard.press('Enter');
    await says(page, '<b>mast</b> is now called mast.');
    await page.keyboard.press('l');
    await page.getByRole('button', { name: 'Delete' }).press('Enter');
    await says(page, 'Deleted: mast.');
    await page.keyboard.press('Escape');
  });

  it('each change is undone and redone', async () => {
    await page.keyboard.press('Control+z');
    await says(page, 'Undone: deleting mast.');
    await page.keyboard.press('Control+z');
    await says(page, 'Undone: naming mast.');
    await page.keyboard.press('Control+Shift+z');
    await says(page, 'Redone: naming mast.');
  });

  it('a found line is named, and the scene is saved with all names', async () => {
    await page.keyboard.press('l');
    await page.getByLabel('Names, the nearest first').selectOption({ label: await page.locator('#places-list option').filter({ hasText: /^line 1,/ }).first().innerText() });
    await page.getByRole('button', { name: 'Rename' }).press('Enter');
    await page.getByLabel('Name', { exact: true }).fill('hull');
    await page.keyboard.press('Enter');
    await says(page, 'line 1 is now called hull.');
    await page.keyboard.press('l');
    await page.getByLabel('Names, the nearest first').waitFor();
    await page.locator('#places-save').press('Enter');
    await says(page, 'The scene is saved as');
    await page.keyboard.press('Escape');
    const { names } = JSON.parse(palpable('name', scene, '--json')) as { names: { name: string; sentence: string; written: boolean }[] };
    expect(names.filter(({ written }) => written).map(({ name, sentence }) => [name, sentence])).toEqual([['mast', 'It is tall.'], ['hull', '']]);
    // The browser has no WebGL here.
    expect(opened.complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
  });

  it('End goes to the nearest line', async () => {
    await page.keyboard.press('Home');
    await page.keyboard.press('End');
    await says(page, 'At the surface, ');
    expect(await page.locator('#spoken').textContent()).toContain('on the line');
  });
});

// The targets: names written at seeded places, and what the program found.

const sizes: Record<string, [number, number]> = {};
const kinds: { kind: string; make: string[] }[] = [
  { kind: 'a drawing', make: ['sample:drawing'] },
  { kind: 'a relief', make: ['sample:sculptures', '--method', 'fast'] },
  { kind: 'a solid', make: ['sample:church'] },
  { kind: 'a street map', make: ['sample:map'] },
  { kind: 'a grid', make: ['sample:sculptures', '--method', 'fast', '--as', 'grid'] },
];
const wanted = Number(process.env.PALPABLE_TARGETS ?? 4);
const perScene = Math.ceil(wanted / (wanted > 20 ? kinds.length : 1));
const first = ['amber', 'blue', 'copper', 'dark', 'east', 'fern', 'grey', 'high', 'iron', 'jade'];
const second = ['arch', 'bench', 'court', 'door', 'elm', 'fountain', 'gate', 'hall', 'inn', 'jetty'];

/** mulberry32: the same places in each run. */
function random(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** A scene with names at seeded places; its targets. */
function named(index: number): { scene: string; targets: string[] } {
  const { make } = kinds[index]!;
  const scene = join(folder, `scene-${index}.palp`);
  palpable('make', ...make, '-o', scene);
  const { size_m } = JSON.parse(palpable('info', scene, '--json')) as { size_m: [number, number, number] };
  sizes[scene] = [size_m[0], size_m[1]];
  const next = random(20261126 + index);
  const found = (JSON.parse(palpable('name', scene, '--json')) as { names: { name: string }[] }).names.map(({ name }) => name);
  const targets = [...new Set(found)].slice(0, Math.floor(perScene / 4));
  for (let k = 0; targets.length < perScene; ++k) {
    const name = `${first[k % 10]} ${second[(k * 3 + Math.floor(k / 10)) % 10]}`;
    const at = size_m.slice(0, 2).map((size) => (1000 * size * 0.92 * (next() - 0.5)).toFixed(1));
    palpable('name', scene, '--add', name, `--at=${at.join(',')}`);
    targets.push(name);
  }
  // In another order than that of the places.
  return { scene, targets: targets.map((name) => ({ name, order: next() })).sort((a, b) => a.order - b.order).map(({ name }) => name) };
}

const all: (Search & { kind: string; name: string })[] = [];

const isAsked = process.env.PALPABLE_TARGETS !== undefined;

describe.skipIf(!isAsked).each(kinds.slice(0, wanted > 20 ? kinds.length : 1).map(({ kind }, index) => ({ kind, index })))('a blind person in $kind', ({ kind, index }) => {
  it(
    'finds names by keys, words and the accessibility tree',
    async () => {
      const { scene, targets } = named(index);
      const running = await startProgram({ instead: ['touch', scene, '--no-browser'] });
      const { page, context } = await openPage(browser, running.address);
      const agent = await NameAgent.at(page);
      for (const name of targets) {
        const search = await agent.find(name);
        // What P says confirms it in another way.
        const reached = search.reached && (kind === 'a street map' || (await agent.isAt(name)));
        all.push({ ...search, reached, kind, name });
        if (!reached) console.log(`${kind}: ${name} was not reached: ${search.last}`);
      }
      await context.close();
      await running.stop();
      const mine = all.filter((one) => one.kind === kind);
      console.log(`${kind}: ${mine.filter(({ reached }) => reached).length} of ${mine.length} reached, median ${median(mine)} key presses`);
      expect(mine.filter(({ reached }) => reached).length).toBeGreaterThanOrEqual(0.95 * mine.length);
    },
    3_600_000,
  );
});

function median(searches: Search[]): number {
  const sorted = searches.map(({ presses }) => presses).sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? 0;
}

it.skipIf(!isAsked)('most names are reached with few key presses', () => {
  expect(all.length).toBeGreaterThanOrEqual(wanted);
  expect(all.filter(({ reached }) => reached).length).toBeGreaterThanOrEqual(0.95 * all.length);
  expect(median(all)).toBeLessThanOrEqual(40);
});
