// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The demo (`tools/build_demo`): a folder of a page and one file for each sample, opened from disk without a network.
// Skipped where the program was built without emscripten.
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, program, violations } from './harness';

const script = join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'tools', 'build_demo');
const folder = mkdtempSync(join(tmpdir(), 'palpable-demo-'));
const demo = join(folder, 'demo');
const build = (output: string) => spawnSync(script, ['--program', program, '-o', output], { encoding: 'utf8' });

function isPossible(): boolean {
  const { status, stderr } = build(demo);
  if (status === 0) return true;
  if (stderr.includes('apt install emscripten')) return false;
  throw new Error(stderr);
}

describe.skipIf(!isPossible())('the demo', () => {
  let browser: Browser;
  beforeAll(async () => {
    browser = await launch({ webgl: false });
  });
  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  async function open(width: number, height: number): Promise<{ page: Page; asked: string[]; wrong: string[] }> {
    const context = await browser.newContext({ offline: true, viewport: { width, height } });
    const page = await context.newPage();
    page.setDefaultTimeout(60_000);
    const asked: string[] = [];
    const wrong: string[] = [];
    page.on('request', (request) => /^(file|blob|data):/.test(request.url()) || asked.push(request.url()));
    page.on('pageerror', (error) => wrong.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && wrong.push(message.text()));
    await page.goto(`file://${demo}/index.html`);
    return { page, asked, wrong };
  }

  it('holds every sample in at most 25 MB, and refers to its own files only', () => {
    const files = readdirSync(demo);
    expect(files.reduce((bytes, file) => bytes + statSync(join(demo, file)).size, 0)).toBeLessThanOrEqual(25e6);
    const index = readFileSync(join(demo, 'index.html'), 'utf8');
    const named = [...index.matchAll(/(?:src|href)="([^"#]+)/g)].map((match) => match[1]!);
    expect(new Set(named)).toEqual(new Set(files.filter((file) => file !== 'index.html')));
  });

  it.each([[320, 640], [1280, 800], [3840, 2160]])('has a page for everybody at %i x %i', async (width, height) => {
    const { page } = await open(width, height);
    expect(await violations(page)).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(true);
    await keepPicture(page, `demo-${width}`, true);
    await page.context().close();
  });

  it('leads to each sample by the keyboard, which begins to be touched at once', async () => {
    const { page, asked, wrong } = await open(1280, 800);
    const count = await page.locator('a.touch').count();
    expect(count).toBeGreaterThanOrEqual(4);
    for (let sample = 0; sample < count; ++sample) {
      await page.goto(`file://${demo}/index.html`);
      for (let press = 0; press <= sample; ++press) await page.keyboard.press('Tab');
      await page.keyboard.press('Enter');
      await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
    }
    // And back to the list.
    await page.getByRole('link', { name: 'All scenes' }).click();
    await page.getByRole('heading', { name: 'Pictures that can be touched' }).waitFor();
    expect([asked, wrong]).toEqual([[], []]);
    await page.context().close();
  });

  it('stays whole when another cannot be made, and replaces no other folder', () => {
    const before = readdirSync(demo);
    const failed = spawnSync(script, ['--program', '/bin/false', '-o', demo], { encoding: 'utf8' });
    expect([failed.status, failed.stderr]).toEqual([1, expect.stringContaining('palpable make ended with 1')]);
    expect(readdirSync(demo)).toEqual(before);
    const other = join(folder, 'other');
    mkdirSync(other);
    writeFileSync(join(other, 'index.html'), 'a page of somebody');
    const { status, stderr } = build(other);
    expect([status, stderr]).toEqual([1, expect.stringContaining('is no demo')]);
    expect(readdirSync(folder).sort()).toEqual(['demo', 'other']);
    expect(execFileSync('cat', [join(other, 'index.html')], { encoding: 'utf8' })).toBe('a page of somebody');
  });
});
