// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The depth camera of the program that follows the head: depth pictures of a folder in its place.
import { existsSync, rmSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { writeDepthFrames, type Place } from './depth_frames';
import { keepPicture, launch, openPage, program, says, startProgram, violations, type Running } from './harness';

const small = { viewport: { width: 320, height: 240 } };
/** The viewer's right is the camera's left; the eyes are 83 mm nearer than the head's middle. */
const head: Place = [-0.1, 0.1, 0.783];

const state = (page: Page) => page.evaluate(() => document.documentElement.dataset.head);
const becomes = (page: Page, wanted: string) => page.waitForFunction((name) => document.documentElement.dataset.head === name, wanted);

describe('the depth camera', () => {
  let browser: Browser;
  const folders: string[] = [];
  const frames = (count: number, gone: number) => {
    folders.push(writeDepthFrames(Array.from({ length: count + gone }, (_, k) => (k < count ? head : null))));
    return folders.at(-1)!;
  };
  beforeAll(async () => {
    expect(existsSync(program)).toBe(true);
    browser = await launch();
  });
  afterAll(async () => {
    await browser?.close();
    for (const folder of folders) rmSync(folder, { recursive: true, force: true });
  });

  it('is followed in place of the browser’s camera, is lost and found, and is switched off', async () => {
    let running: Running | null = null;
    try {
      running = await startProgram('--head', `frames:${frames(120, 60)}?fps=30&loop=1`);
      const { page, context, complaints } = await openPage(browser, running.address, small);
      const sent: string[] = [];
      page.on('websocket', () => sent.push('another socket'));
      await becomes(page, 'seen');
      expect(await page.locator('#depth-mode').inputValue()).toBe('head');
      expect(await page.locator('#follow-head').isChecked()).toBe(true);
      expect(await page.locator('#follow-head-name').textContent()).toContain('depth camera');
      expect(await page.locator('#head-privacy').textContent()).toContain('do not leave the program');
      expect(await page.locator('#camera-angle').isDisabled()).toBe(true);

      // 12 cm to the right of which perspective takes 1; 10 cm farther than the set 60.
      await page.locator('#stage').focus();
      await page.keyboard.press('v');
      const said = async () => {
        await page.keyboard.press('ArrowRight');
        return page.locator('#spoken').textContent();
      };
      await expect.poll(said, { timeout: 30_000 }).toMatch(/Your head is (9|10|11) centimetres right, .*(9|10|11) centimetres farther away/);
      await says(page, 'Your head is not seen: the view goes back to the middle.');
      await says(page, 'Your head is seen: the view follows it.');

      await page.locator('#depth').evaluate((depth) => ((depth as HTMLDetailsElement).open = true));
      await page.locator('#head-more').evaluate((more) => ((more as HTMLDetailsElement).open = true));
      await becomes(page, 'seen');
      await page.locator('#head-straight').click();
      await says(page, 'The camera’s angle was set');
      expect(await violations(page)).toEqual([]);
      await page.locator('#follow-head').scrollIntoViewIfNeeded();
      await page.locator('#follow-head').uncheck();
      await says(page, 'The depth camera does not follow your head any more.');
      expect(await state(page)).toBe('off');
      // A picture of a view that moves can take a minute without a GPU.
      await keepPicture(page, 'head-depth-camera');
      expect(sent).toEqual([]);
      expect(complaints).toEqual([]);
      await context.close();
    } finally {
      await running?.stop();
    }
  });

  it('whose pictures end is said', async () => {
    let running: Running | null = null;
    try {
      running = await startProgram('--head', `frames:${frames(60, 0)}`);
      const { page, context } = await openPage(browser, running.address, small);
      await says(page, 'The pictures of the depth camera have ended.');
      expect(await state(page)).toBe('off');
      expect(await page.locator('#follow-head').isChecked()).toBe(false);
      await context.close();
    } finally {
      await running?.stop();
    }
  });
});
