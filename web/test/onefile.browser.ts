// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page as a file of its own (`palpable export SCENE -o x.html`): opened from disk without a network, it feels what
// `palpable probe` computes, and asks nobody for anything. Skipped where the program was built without emscripten.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, BrowserContextOptions, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, program, says, violations } from './harness';
import { Listener } from './listener';

const samples = join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'samples');
const folder = mkdtempSync(join(tmpdir(), 'palpable-onefile-'));
const at = (name: string) => join(folder, name);
const run = (...words: string[]) => execFileSync(program, [...words, '--quiet'], { cwd: folder, stdio: 'pipe' });

function canExport(): boolean {
  const [left, right] = ['left', 'right'].map((side) => join(samples, `sculpture_${side}.png`));
  run('make', left!, right!, '--method', 'fast', '--title', 'Sculptures <on> a table', '--describe', 'Eight things. They are of stone.', '-o', at('relief.palp'));
  try {
    run('export', at('relief.palp'), '-o', at('relief.html'));
    return true;
  } catch (error) {
    const said = String((error as { stderr?: Buffer }).stderr);
    if (!said.includes('apt install emscripten')) throw error;
    return false;
  }
}

const possible = canExport();

/** A path through the middle of a scene, in and out of its surface. */
function path(count: number, width: number, height: number, lowest: number, highest: number): number[][] {
  return Array.from({ length: count }, (_, i) => {
    const t = i / 1000;
    const [x, y] = [0.4 * width * Math.sin(1.7 * t) * Math.cos(0.31 * t), 0.4 * height * Math.sin(2.3 * t + 1)];
    return [t, x, y, lowest + (highest - lowest) * (0.5 + 0.5 * Math.sin(9 * t))];
  });
}

function probed(scene: string, rows: number[][], options: string[]): number[][] {
  writeFileSync(at('path.csv'), `t_s,x_m,y_m,z_m\n${rows.map((row) => row.join(',')).join('\n')}\n`);
  run('probe', scene, '--path', at('path.csv'), '-o', at('forces.csv'), ...options);
  const lines = readFileSync(at('forces.csv'), 'utf8').trim().split('\n').slice(1);
  return lines.map((line) => line.split(',').slice(4, 8).map(Number));
}

interface OpenedFile {
  page: Page;
  asked: string[];
  wrong: string[];
}

describe.skipIf(!possible)('a page that is a file', () => {
  let browser: Browser;
  beforeAll(async () => {
    browser = await launch({ webgl: false });
    const cube = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => `v ${0.02 * x} ${0.015 * y} ${0.01 * z}`)));
    const faces = ['1 2 4 3', '5 7 8 6', '1 5 6 2', '3 4 8 7', '1 3 7 5', '2 6 8 4'];
    writeFileSync(at('cube.obj'), `${cube.join('\n')}\n${faces.map((face) => `f ${face}`).join('\n')}\n`);
    run('make', at('cube.obj'), '--as', 'field', '--no-cache', '-o', at('field.palp'));
    run('make', join(samples, 'sculpture_left.png'), '--as', 'contours', '-o', at('contours.palp'));
    run('make', join(samples, 'town.osm'), '-o', at('map.palp'));
    for (const kind of ['field', 'contours', 'map']) run('export', at(`${kind}.palp`), '-o', at(`${kind}.html`));
  });
  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  async function open(file: string, options: BrowserContextOptions = {}): Promise<OpenedFile> {
    const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(60_000);
    const opened: OpenedFile = { page, asked: [], wrong: [] };
    page.on('request', (request) => /^(file|blob|data):/.test(request.url()) || opened.asked.push(request.url()));
    page.on('pageerror', (error) => opened.wrong.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && opened.wrong.push(message.text()));
    await page.goto(`file://${file}`);
    return opened;
  }
  const running = (page: Page) => page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');

  const solid = [0.05, 0.04, -0.012, 0.012] as const;
  const picture = [0.1, 0.08, -0.001, 0.016] as const;
  const ball = { radius: 1, stiffness: 700, friction: 0.6, damping: 1 };
  // Ten thousand places of each kind of scene by each of its laws; for some also with options.
  it.each([
    ['relief', picture, [{ law: 'proxy' }, { law: 'rolling' }, { law: 'penalty' }, { law: 'proxy', ...ball }]],
    ['contours', [0.1, 0.08, -0.001, 0.003], [{ law: 'groove' }, { law: 'tracing' }, { law: 'rolling' }]],
    ['field', solid, [{ law: 'proxy' }, { law: 'penalty' }, { law: 'proxy', ...ball }]],
    ['map', [0.18, 0.18, -0.001, 0.004], [{ law: 'proxy' }, { law: 'rolling' }]],
  ] as const)('feels a %s as `palpable probe` does', async (kind, [width, height, lowest, highest], laws) => {
    const { page, asked, wrong } = await open(at(`${kind}.html`));
    await page.waitForFunction(() => window.palpable?.probe !== undefined);
    const rows = path(10_000, width, height, lowest, highest);
    for (const options of laws) {
      const words = Object.entries(options).flatMap(([name, value]) => [`--${name}`, String(value)]);
      const want = probed(at(`${kind}.palp`), rows, words);
      const got = await page.evaluate(([r, o]) => window.palpable!.probe(r as never, o), [rows, options] as const);
      expect(got.length).toBe(want.length);
      const worst = Math.max(...got.map((row, i) => Math.max(...[0, 1, 2].map((k) => Math.abs(row[k]! - want[i]![k]!)))));
      expect(worst, JSON.stringify(options)).toBeLessThanOrEqual(1e-9);
      expect(got.map((row) => row[3])).toEqual(want.map((row) => row[3]));
      expect(want.filter((row) => row[3] !== 0).length).toBeGreaterThan(1000);
    }
    expect([asked, wrong]).toEqual([[], []]);
    await page.context().close();
  });

  it('says what is wrong with the options', async () => {
    const { page } = await open(at('relief.html'));
    await running(page);
    const said = await page.evaluate(() => window.palpable!.probe([[0, 0, 0, 0]], { law: 'tracing' }).catch((error: Error) => error.message));
    expect(said).toBe('the scene, a relief, has no law tracing');
    await page.context().close();
  });

  it('is touched by keys and ears alone', async () => {
    const { page, asked, wrong } = await open(at('relief.html'));
    await running(page);
    const listener = await Listener.at(page);
    await listener.hears(/Ready to touch: Sculptures <on> a table/);
    expect((await listener.focused()).name).toBe('Surface of Sculptures <on> a table to touch');
    await listener.ask('d', /rise above/);
    await listener.ask('p', /millimetres/);
    await listener.ask('ArrowRight', /millimetre/);
    for (let k = 0; k < 4; ++k) await page.keyboard.press('PageDown');
    await page.waitForFunction(() => Number(document.getElementById('read-force')?.textContent) > 0.3);
    expect([asked, wrong]).toEqual([[], []]);
    await page.context().close();
  });

  it('shows its picture from above', async () => {
    const { page } = await open(at('relief.html'));
    await running(page);
    const shown = () =>
      page.evaluate(() => {
        const canvas = document.querySelector<HTMLCanvasElement>('#stage canvas')!;
        const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
        return data.filter((_, i) => i % 4 !== 3).reduce((sum, value) => sum + value, 0);
      });
    const withPicture = await shown();
    await page.selectOption('#surface', 'clay');
    await expect.poll(shown, { timeout: 10_000 }).not.toBe(withPicture);
    await page.context().close();
  });

  it('is touched by several fingers', async () => {
    const { page } = await open(at('relief.html'), { hasTouch: true, isMobile: true, viewport: { width: 320, height: 640 } });
    await running(page);
    const box = (await page.locator('#stage').boundingBox())!;
    const session = await page.context().newCDPSession(page);
    const fingers = [0.3, 0.6].map((share, id) => ({ x: box.x + share * box.width, y: box.y + 0.5 * box.height, id }));
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: fingers });
    await says(page, 'Probe 2 touches.');
    await keepPicture(page, 'onefile-phone', true);
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await page.context().close();
  });

  it.each([
    ['desktop', {}],
    ['phone', { viewport: { width: 320, height: 640 }, hasTouch: true, isMobile: true }],
    ['dark', { colorScheme: 'dark' as const }],
  ])('has no fault that axe-core finds: %s', async (name, options) => {
    for (const kind of ['relief', 'map']) {
      const { page } = await open(at(`${kind}.html`), options);
      await running(page);
      expect(await violations(page)).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth)).toBeLessThanOrEqual(0);
      await keepPicture(page, `onefile-${kind}-${name}`);
      await page.context().close();
    }
  });

  it('comes to rest, and keeps nothing', async () => {
    const { page } = await open(at('relief.html'));
    await running(page);
    await page.waitForTimeout(4000);
    const frames = () => page.evaluate(() => Number(document.documentElement.dataset.frames));
    const before = await frames();
    await page.waitForTimeout(2000);
    expect(await frames()).toBe(before);
    expect(await page.evaluate(() => document.cookie)).toBe('');
    expect(await page.locator('#save').isVisible()).toBe(false);
    await page.context().close();
  });

  it.each([0.02, 0.3, 0.5, 0.9, 0.9999])('says that it is incomplete when only %f of it is there', async (share) => {
    const whole = readFileSync(at('relief.html'));
    writeFileSync(at('cut.html'), whole.subarray(0, Math.floor(share * whole.length)));
    const { page } = await open(at('cut.html'));
    await page.getByRole('alert').filter({ hasText: 'This file is incomplete' }).waitFor();
    await page.context().close();
  });

  it('says that it is damaged when its scene is', async () => {
    const text = readFileSync(at('relief.html'), 'utf8');
    const scene = text.indexOf('id="data-scene">') + 'id="data-scene">'.length + 4000;
    writeFileSync(at('damaged.html'), `${text.slice(0, scene)}AAAAAAAAAAAA${text.slice(scene + 12)}`);
    const { page } = await open(at('damaged.html'));
    await page.getByRole('alert').filter({ hasText: 'This file is damaged' }).waitFor();
    await page.context().close();
  });

  it('says that it is damaged when the browser refuses its program', async () => {
    const text = readFileSync(at('relief.html'), 'utf8');
    const script = text.indexOf('<script type="module">') + 2000;
    expect(script).toBeGreaterThan(2000);
    writeFileSync(at('refused.html'), `${text.slice(0, script)}${text[script] === 'x' ? 'y' : 'x'}${text.slice(script + 1)}`);
    const { page } = await open(at('refused.html'));
    await page.getByRole('alert').filter({ hasText: 'This file is damaged' }).waitFor();
    await page.context().close();
  });

  it('is small enough to send', () => {
    expect(readFileSync(at('relief.html')).length).toBeLessThanOrEqual(4e6);
    expect(readFileSync(at('map.html')).length).toBeLessThanOrEqual(6e6);
  });
});
