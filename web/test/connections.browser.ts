// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page reports its connection correctly: too many pages, a corrected address, two pages on one probe, a killed program.
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened | undefined;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram()]);
});
// A page that a failed attempt left open would take a place from the next attempt, and from the next test.
afterEach(async () => {
  const pages = browser.contexts().flatMap((context) => context.pages());
  await Promise.all(pages.filter((page) => page !== opened?.page).map((page) => page.close()));
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

const home = () => new URL('/', running.address).href;
const isRunning = (page: Page) => page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
async function another(context: BrowserContext): Promise<Page> {
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  await page.goto(home());
  return page;
}
const xIs = (page: Page, x: number) =>
  page.waitForFunction((wanted) => Math.abs(Number.parseFloat(document.getElementById('read-position')?.textContent ?? '') - wanted) < 0.15, x);

it('a page without the token works after the correct address is entered', async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(home());
  await page.getByRole('alert').filter({ hasText: 'has no access to the session' }).waitFor();
  // The same document: only the part after # differs.
  await page.evaluate((hash) => (location.hash = hash), new URL(running.address).hash);
  await isRunning(page);
  expect(await page.locator('#banner').isVisible()).toBe(false);
  expect(new URL(page.url()).hash).toBe('');
  opened = { page, context, complaints: [] };
});

it('a second page takes over the probe at its position, and the first page reports it', async () => {
  const { page, context } = opened!;
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  for (let k = 0; k < 4; ++k) await page.keyboard.press('Shift+ArrowRight');
  await xIs(page, 20);
  const second = await another(context);
  await isRunning(second);
  await xIs(second, 20);
  await second.locator('#stage').focus();
  await second.keyboard.press('ArrowLeft');
  await xIs(second, 19);
  await xIs(page, 19);
  await says(page, 'Another page moves probe 1 now.');
});

it('a fifth page is told that the limit is four, and is admitted when one is closed', async () => {
  const { context } = opened!;
  const more = [await another(context), await another(context), await another(context)];
  for (const page of more) await isRunning(page);
  const fifth = await another(context);
  await fifth.getByRole('alert').filter({ hasText: 'open in 4 pages already, which is the limit' }).waitFor();
  await keepPicture(fifth, 'fifth-page');
  expect(await violations(fifth)).toEqual([]);
  await more.pop()!.close();
  await isRunning(fifth);
});

it('after the program was killed, no force is shown and nothing is spoken', async () => {
  const own = await startProgram();
  const { page, context } = await openPage(browser, own.address);
  await page.locator('#stage').focus();
  await page.keyboard.press('ArrowRight');
  await says(page, 'millimetre');
  own.child.kill('SIGKILL');
  await page.getByRole('alert').waitFor();
  expect(await page.locator('#read-force').textContent()).toBe('–');
  await page.keyboard.press('ArrowRight');
  await says(page, 'Palpable is not connected');
  expect(await page.locator('#spoken').textContent()).not.toMatch(/millimetre/);
  await keepPicture(page, 'killed');
  // The arrow of the force has disappeared: no pixel of the picture has its colour.
  const arrow = await page.locator('#stage canvas').evaluate((canvas) => {
    const { width, height } = canvas as HTMLCanvasElement;
    const pixels = (canvas as HTMLCanvasElement).getContext('2d')!.getImageData(0, 0, width, height).data;
    let found = 0;
    for (let k = 0; k < pixels.length; k += 4) if (pixels[k] === 0x0b && pixels[k + 1] === 0x61 && pixels[k + 2] === 0x70) found += 1;
    return found;
  });
  expect(arrow).toBe(0);
  await context.close();
  await own.stop();
});
