// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The page in German and Spanish: by the browser's language and by choice, with the program's sentences, and nothing cut off
// on a screen of 320 pixels.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { hasSaid, keepPicture, launch, openMore, openPage, startProgram, type Running } from './harness';

let browser: Browser;
let running: Running;
beforeAll(async () => {
  browser = await launch({ webgl: false });
  running = await startProgram();
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

/** What is wider than its place: the page, or the text of a control or a heading. */
const cutOff = (page: Page) =>
  page.evaluate(() => {
    const { scrollWidth } = document.documentElement;
    const found = scrollWidth > window.innerWidth ? [`the page is ${scrollWidth} pixels wide`] : [];
    for (const one of document.querySelectorAll<HTMLElement>('button, label, legend, summary, h1, h2, h3, p, th, td')) {
      const isShown = one.checkVisibility() && !one.classList.contains('unseen') && getComputedStyle(one).overflowX !== 'visible';
      if (isShown && one.scrollWidth > one.clientWidth + 1) found.push(`${one.textContent}: ${one.scrollWidth} of ${one.clientWidth}`);
    }
    return found;
  });

const narrow = { width: 320, height: 640 };
let storage: Awaited<ReturnType<Awaited<ReturnType<typeof openPage>>['context']['storageState']>>;

it.each([
  { locale: 'de-AT', language: 'de', ready: 'Bereit zum Tasten', described: /\d+ Objekte/, place: /\d+(,\d)? Millimeter/ },
  { locale: 'es-MX', language: 'es', ready: 'Listo para tocar', described: /\d+ objetos/, place: /\d+(,\d)? milímetros/ },
])('is $language for a browser of $locale', async ({ locale, language, ready, described, place }) => {
  const address = storage ? running.address.split('#')[0]! : running.address;
  const { page, context, complaints } = await openPage(browser, address, { locale, viewport: narrow, ...(storage && { storageState: storage }) });
  storage ??= await context.storageState();
  await hasSaid(page, ready);
  expect(await page.locator('html').getAttribute('lang')).toBe(language);
  const hears = (about: RegExp) => page.waitForFunction(([source]) => new RegExp(source!).test(document.getElementById('spoken')!.textContent ?? ''), [about.source]);
  await page.keyboard.press('d');
  await hears(described);
  await page.keyboard.press('p');
  await hears(place);
  await openMore(page);
  expect(await cutOff(page)).toEqual([]);
  await keepPicture(page, `language-${language}`, true);
  await page.keyboard.press('h');
  await page.locator('#help-dialog').waitFor();
  expect(await cutOff(page)).toEqual([]);
  await keepPicture(page, `language-${language}-help`);
  await page.keyboard.press('Escape');
  if (language === 'es') {
    // The choice is kept, and goes before the browser's language.
    await Promise.all([page.waitForEvent('load'), page.locator('#language').selectOption('en')]);
    await hasSaid(page, 'Ready to touch');
    await page.reload();
    await hasSaid(page, 'Ready to touch');
    expect(await page.locator('html').getAttribute('lang')).toBe('en');
  }
  expect(complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
  await context.close();
});
