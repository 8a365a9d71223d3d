// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The guided start: for the ears by keys, the accessibility tree and announcements alone; for the eyes as it looks.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { framesDrawn, keepPicture, launch, openPage, startProgram, violations, type Opened, type Running } from './harness';
import { Listener } from './listener';

const folder = mkdtempSync(join(tmpdir(), 'palpable-guide-'));
let browser: Browser;
let running: Running;
let opened: Opened | undefined;
let page: Page;
let listener: Listener;
beforeAll(async () => {
  const side = 64;
  const rows = Array.from({ length: side }, (_, y) => Array.from({ length: side }, (_, x) => (Math.hypot(x - 32, y - 32) < 20 ? '200' : '30')).join(' '));
  writeFileSync(join(folder, 'disc.pgm'), `P2\n${side} ${side}\n255\n${rows.join('\n')}\n`);
  browser = await launch({ webgl: false });
  running = await startProgram({ instead: ['touch', join(folder, 'disc.pgm'), '--no-browser'] });
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
  rmSync(folder, { recursive: true, force: true });
});

/** Walks as a sentence says: "12 millimetres right, 5 millimetres up". */
async function walkAsSaid(sentence: string): Promise<void> {
  for (const [, count, way] of sentence.matchAll(/(\d+) millimetres? (right|left|up|down)/g))
    await listener.walk(Number(count), ...({ right: ['ArrowRight', ''], left: ['ArrowLeft', ''], up: ['ArrowUp', ''], down: ['ArrowDown', ''] }[way!] as [string, string]));
}

it('for the ears is offered once, and done by keys and announcements alone', async () => {
  // A person who was never here.
  await opened?.context.close();
  opened = await openPage(browser, running.address);
  ({ page } = opened);
  listener = await Listener.at(page);
  await listener.hears(/^Ready to touch: .* I begins a guided start of two minutes\.$/);
  await page.keyboard.press('i');
  const edge = await listener.hears(/^Step 1 of 7: Find a line.* The nearest one is .*/);
  await walkAsSaid(edge[0]);
  await listener.hears(/^Good\. Step 2 of 7: Follow the line/);
  // Its sentence is repeated by one key.
  await listener.ask('p', /millimetres/);
  await listener.ask('i', /^Step 2 of 7: Follow the line/);
  await page.keyboard.press('End');
  await listener.tries(async () => {
    for (const key of ['ArrowUp', 'ArrowDown', 'ArrowUp', 'ArrowRight', 'ArrowLeft']) for (let k = 0; k < 4; ++k) await page.keyboard.press(key);
  }, /Step 3 of 7: Press P/);
  // Left, and taken up again.
  await page.keyboard.press('Escape');
  await listener.hears(/^The guided start is left\. I goes on with it\.$/);
  expect(await page.locator('#guide').isVisible()).toBe(false);
  await page.keyboard.press('i');
  await listener.hears(/^You left it here\. Step 3 of 7/);
  await page.keyboard.press('p');
  await listener.hears(/Step 4 of 7: Press L/);
  await page.keyboard.press('l');
  await page.getByLabel('Names, the nearest first').waitFor();
  await page.keyboard.press('Escape');
  await listener.hears(/Step 5 of 7: Open the list once more/);
  await page.keyboard.press('k');
  await listener.hears(/Step 6 of 7: Every change/);
  await page.keyboard.press('m');
  await page.keyboard.press('Control+z');
  await listener.hears(/Step 7 of 7: That was the guided start/);
  await page.keyboard.press('Escape');
  await listener.hears(/^The guided start is done\. I begins it anew\.$/);
  expect(opened.complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
});

it('leads to a name, is not offered again, and is begun from below the picture', async () => {
  await page.reload();
  await listener.hears(/^Ready to touch: .* for help\.$/);
  expect(await page.locator('#guide').isVisible()).toBe(false);
  await page.getByRole('button', { name: 'Guided start' }).press('Enter');
  expect(await listener.focused()).toMatchObject({ role: 'button', name: 'For the eyes' });
  expect(await violations(page)).toEqual([]);
  await keepPicture(page, 'guide-offer');
  await page.keyboard.press('Enter');
  expect(await listener.focused()).toMatchObject({ role: 'application' });
  for (let k = 0; k < 4; ++k) await page.keyboard.press('k');
  await listener.hears(/Step 5 of 7/);
  await page.keyboard.press('l');
  await page.getByLabel('Names, the nearest first').waitFor();
  await page.keyboard.press('Enter');
  const looking = await listener.hears(/^Looking for .*/);
  await walkAsSaid(looking[0]);
  await page.keyboard.press('g');
  await listener.hears(/Step 6 of 7/);
});

it('for the eyes outlines what is meant, at every size', async () => {
  const step = (number: number) => page.getByRole('region', { name: `Guided start for the eyes. Step ${number} of 7` }).waitFor();
  await step(6);
  expect(await page.locator('.meant').evaluateAll((all) => all.map(({ id }) => id).sort())).toEqual(['theme', 'undo']);
  await page.getByLabel('Colours').selectOption('dark');
  await page.getByRole('button', { name: 'Undo' }).click();
  await step(7);
  await page.getByRole('button', { name: 'Leave' }).click();
  expect(await page.locator('.meant').count()).toBe(0);
  await page.getByRole('button', { name: 'Guided start' }).click();
  await page.getByRole('button', { name: 'For the eyes' }).click();
  const stage = (await page.locator('#stage').boundingBox())!;
  await page.mouse.move(stage.x + stage.width / 2, stage.y + stage.height / 2);
  await page.mouse.move(stage.x + stage.width / 2 + 60, stage.y + stage.height / 2 + 20, { steps: 10 });
  await step(2);
  await keepPicture(page, 'guide-edge');
  for (const [width, height] of [[320, 640], [1280, 600], [3840, 2160]] as const) {
    await page.setViewportSize({ width, height });
    // The stage is drawn anew in the frame after the one that lays it out.
    await framesDrawn(page, 2);
    expect(await violations(page), `${width} wide`).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)).toBeLessThanOrEqual(0);
    if (width > 1000) expect((await page.locator('#stage').boundingBox())!.height).toBeGreaterThan(height / 4);
    await keepPicture(page, `guide-${width}x${height}`, width < 1000);
  }
});
