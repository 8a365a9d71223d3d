// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The simulated robot on the page: started and stopped by keys, its modes, and what is shown and said of it.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { hasSaid, keepPicture, launch, openPage, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened;
let page: Page;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram({ instead: ['touch', 'robot:sample?fps=10&sound=0&mode=look'] })]);
  opened = await openPage(browser, running.address);
  ({ page } = opened);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

const state = () => page.locator('#robot-state').textContent();
const isStarted = async () => ((await state()) ?? '').startsWith('Started');
const stands = () => page.waitForFunction(() => /^The robot is stopped/.test(document.getElementById('robot-state')?.textContent ?? ''));

/** Again where a busy machine has stopped it, or its pictures did not come in time. */
async function start(): Promise<void> {
  for (let tries = 0; tries < 20 && !(await isStarted()); ++tries) {
    const before = await state();
    await page.locator('#robot-start').focus();
    await page.keyboard.press('Enter');
    await page.waitForFunction((before) => document.getElementById('robot-state')?.textContent !== before, before, { timeout: 5000 }).catch(() => undefined);
  }
  expect(await state()).toMatch(/^Started/);
}

it('is shown, and nothing is sent before a start', async () => {
  await page.locator('#robot').waitFor();
  expect(await state()).toMatch(/^Not started: nothing is sent to the robot/);
  expect(await page.getByRole('radio', { name: 'Look' }).isChecked()).toBe(true);
  await page.locator('#robot-floor-words').filter({ hasText: /Free for \d\.\d m ahead/ }).waitFor();
  expect(await page.locator('#robot-floor').getAttribute('aria-label')).toMatch(/^Floor around the robot\. Free for/);
  expect(await violations(page)).toEqual([]);
  await keepPicture(page, 'robot');
});

it('is started by a key from the middle, and says so', async () => {
  await page.locator('#stage').focus();
  await page.keyboard.press('Shift+ArrowRight');
  await start();
  // What stands before it is said at once afterwards.
  await hasSaid(page, 'The robot is started. The floor within');
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('stage');
  await keepPicture(page, 'robot-started');
});

it('is stopped by a key in a dialog, and that interrupts', async () => {
  await start();
  await page.getByRole('button', { name: 'Help and keys' }).click();
  await page.keyboard.press('F2');
  await stands();
  expect(await page.getByRole('alert').filter({ hasText: 'The robot is stopped' }).count()).toBe(1);
  await page.keyboard.press('Escape');
});

it('changes its mode by arrow keys', async () => {
  await page.getByRole('radio', { name: 'Look' }).focus();
  await page.keyboard.press('ArrowRight');
  await page.locator('#robot-mode-words').filter({ hasText: 'Touch: the robot stands' }).waitFor();
  await page.getByRole('radio', { name: 'Near' }).waitFor();
});

it('is stopped by a page that is loaded again, which starts nothing; Stop is in a narrow window however far it is scrolled', async () => {
  await start();
  await page.locator('#stage').focus();
  await page.keyboard.press('ArrowRight');
  await page.reload();
  await page.locator('#robot').waitFor();
  await stands();
  await page.setViewportSize({ width: 320, height: 640 });
  await page.locator('#places').scrollIntoViewIfNeeded();
  const box = (await page.locator('#robot-stop').boundingBox())!;
  expect(box.y + box.height).toBeLessThanOrEqual(640);
  expect(box.x + box.width).toBeLessThanOrEqual(320);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(320);
  expect(await violations(page)).toEqual([]);
  await page.evaluate(() => window.scrollTo(0, 0));
  await keepPicture(page, 'robot-320', true);
  expect(opened.complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
});
