// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Every state that a person may meet: looked at by axe-core here, and by people in web/test-results.
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, openPage, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let flatBrowser: Browser;
let running: Running;
let key: Awaited<ReturnType<Opened['context']['storageState']>>;

beforeAll(async () => {
  [browser, flatBrowser, running] = await Promise.all([launch(), launch({ webgl: false }), startProgram()]);
  // The address lets one browser in, once; further windows of these tests show the cookie that it got.
  const first = await openPage(browser, running.address);
  key = await first.context.storageState();
  await first.context.close();
});
afterAll(async () => {
  await Promise.all([browser?.close(), flatBrowser?.close()]);
  await running?.stop();
});

const home = () => new URL('/', running.address).href;

describe('the page in every state', () => {
  const states: [string, Parameters<typeof openPage>[2], (opened: Opened) => Promise<void>][] = [
    ['desktop', {}, async () => undefined],
    ['large-text', { viewport: { width: 640, height: 400 }, deviceScaleFactor: 2 }, async () => undefined],
    ['phone', { viewport: { width: 320, height: 640 }, deviceScaleFactor: 2, hasTouch: true }, async () => undefined],
    ['dark', { colorScheme: 'dark' }, async () => undefined],
    ['reduced-motion', { reducedMotion: 'reduce' }, async () => undefined],
    ['forced-colours', { forcedColors: 'active' }, async () => undefined],
    ['high-contrast', {}, async ({ page }) => void (await page.getByLabel('Colours').selectOption('contrast'))],
    ['clay', {}, async ({ page }) => void (await page.getByLabel('Surface', { exact: true }).selectOption('clay'))],
    ['from-above', {}, async ({ page }) => void (await page.getByLabel('View', { exact: true }).selectOption('flat'))],
    ['help', {}, async ({ page }) => page.getByRole('button', { name: 'Help and keys' }).click()],
    ['described', {}, async ({ page }) => page.getByRole('button', { name: 'Describe' }).click()],
    [
      'paused',
      {},
      async ({ page }) => {
        await page.getByRole('button', { name: 'Pause' }).click();
        await page.getByRole('button', { name: 'Go on' }).waitFor();
      },
    ],
  ];
  it.each(states)('%s has nothing that axe-core objects to, and no scroll bar sideways', async (name, options, prepare) => {
    const opened = await openPage(browser, home(), { storageState: key, ...options });
    try {
      const { page } = opened;
      await page.mouse.move(200, 330);
      await prepare(opened);
      await page.waitForTimeout(600);
      await keepPicture(page, name, ['phone', 'large-text'].includes(name));
      expect(await violations(page)).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)).toBeLessThanOrEqual(0);
      expect(opened.complaints).toEqual([]);
    } finally {
      if (name === 'paused') await opened.page.getByRole('button', { name: 'Go on' }).click();
      await opened.context.close();
    }
  });

  it('without WebGL is shown from above, says so, and can still be touched', async () => {
    const opened = await openPage(flatBrowser, home(), { storageState: key });
    const { page } = opened;
    await page.locator('#stage').focus();
    await page.keyboard.press('ArrowRight');
    expect(await page.locator('#view-note').textContent()).toMatch(/WebGL.*Touch, sound and words work/);
    await page.waitForFunction(() => document.getElementById('spoken')?.textContent?.includes('millimetre'));
    await keepPicture(page, 'no-webgl');
    expect(await violations(page)).toEqual([]);
    await opened.context.close();
  });

  it('a browser without the token is told so', async () => {
    const context = await browser.newContext();
    const page = await context.newPage();
    await page.goto(home());
    await page.getByRole('alert').filter({ hasText: 'has not been let in' }).waitFor();
    await keepPicture(page, 'refused');
    expect(await violations(page)).toEqual([]);
    await page.goto('about:blank');
    await page.goto(running.address);
    await page.getByRole('alert').filter({ hasText: 'was used already' }).waitFor();
    await context.close();
  });

  it('the end of the session is said', async () => {
    const own = await startProgram();
    const opened = await openPage(browser, own.address);
    await own.stop();
    await opened.page.getByRole('alert').filter({ hasText: 'The session has ended' }).waitFor();
    await keepPicture(opened.page, 'ended');
    expect(await violations(opened.page)).toEqual([]);
    await opened.context.close();
  });
});
