// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A shared touch: the link on the page, a phone that comes in by it and touches, and is shown out.
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, openMore, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let host: Opened;
let phone: Page;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram('--share', '--share-address', '127.0.0.1')]);
  host = await openPage(browser, running.address);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

const linkOn = (page: Page) => page.locator('#share-link').textContent();
const isRunning = (page: Page) => page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');

/** A phone on which somebody has read the warning about the certificate and gone on. */
async function phoneAt(link: string): Promise<{ page: Page; context: BrowserContext }> {
  const context = await browser.newContext({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
    userAgent: 'Mozilla/5.0 (Linux; Android 14; Pixel 8) AppleWebKit/537.36 Chrome/130.0 Mobile Safari/537.36',
    ignoreHTTPSErrors: true,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  await page.goto(link);
  return { page, context };
}

it('the page shows the link with its code, and the fingerprint of the certificate', async () => {
  const { page } = host;
  await page.locator('#share').waitFor();
  expect(await linkOn(page)).toMatch(/^https:\/\/127\.0\.0\.1:\d+\/#[0-9a-f]{32}$/);
  await page.getByRole('img', { name: 'QR code of the link below' }).waitFor();
  expect(await page.locator('#share-fingerprint').textContent()).toMatch(/^([0-9A-F]{2}:){31}[0-9A-F]{2}$/);
  await page.locator('#share details').evaluate((more) => ((more as HTMLDetailsElement).open = true));
  expect(await violations(page)).toEqual([]);
  await page.locator('#share').scrollIntoViewIfNeeded();
  await keepPicture(page, 'shared');
});

it('a phone comes in by the link, touches with a probe of its own, and is shown and said', async () => {
  const link = (await linkOn(host.page))!;
  ({ page: phone } = await phoneAt(link));
  await isRunning(phone);
  expect(new URL(phone.url()).hash).toBe('');
  expect(await phone.locator('#guest-words').textContent()).toBe('You are Phone 1: you touch with probe 9.');
  await says(host.page, 'Phone 1 has joined, and touches with probe 9.');
  await host.page.getByText('Phone 1 touches with probe 9: here').waitFor();
  expect(await host.page.locator('#share-open').isVisible()).toBe(false);
  await phone.locator('#stage').focus();
  await phone.keyboard.press('Shift+ArrowRight');
  await openMore(host.page);
  await host.page.locator('#probe-rows th', { hasText: /^9$/ }).waitFor();
  expect(await phone.getByRole('button', { name: 'Pause' }).count()).toBe(0);
  await phone.keyboard.press('Space');
  await says(phone, 'Only the person who shares the scene can do that.');
  expect(await violations(phone)).toEqual([]);
  await keepPicture(phone, 'guest');
});

it('the link is of no use to a second phone', async () => {
  await host.page.getByRole('button', { name: 'Make a link' }).click();
  await host.page.locator('#share-open').waitFor();
  const link = (await linkOn(host.page))!;
  const second = await phoneAt(link);
  await isRunning(second.page);
  const third = await phoneAt(link);
  await third.page.getByRole('alert').filter({ hasText: 'This link was used already' }).waitFor();
  expect(await violations(third.page)).toEqual([]);
  await Promise.all([second.context.close(), third.context.close()]);
});

it('a guest is shown out by keys, and stays out', async () => {
  const out = host.page.getByRole('button', { name: 'Show out Phone 1' });
  await out.focus();
  await host.page.keyboard.press('Enter');
  await phone.getByRole('alert').filter({ hasText: 'The person who shares the scene has ended your access.' }).waitFor();
  await out.waitFor({ state: 'detached' });
  expect(await host.page.evaluate(() => document.activeElement?.id)).toBe('share-invite');
  await phone.reload();
  await phone.getByRole('alert').filter({ hasText: 'This device has no access to the scene' }).waitFor();
  expect(host.complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
});
