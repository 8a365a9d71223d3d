// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The egocentric view in a real browser: by keys alone, with speech and picture.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram('--view', 'egocentric')]);
  opened = await openPage(browser, running.address);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

const probeIsAt = (page: Page, x: number, y: number) =>
  page.waitForFunction(
    ([wantedX, wantedY]) => {
      const [nowX, nowY] = (document.getElementById('read-position')?.textContent ?? '').split(',').map(Number.parseFloat);
      return Math.abs(nowX! - wantedX!) < 0.15 && Math.abs(nowY! - wantedY!) < 0.15;
    },
    [x, y],
  );

it('the hand moves and rotates with the explorer, whose position is spoken', async () => {
  const { page } = opened;
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  await probeIsAt(page, 0, 0);
  // The hand is 5 mm ahead of the feet; then the feet walk 5 mm ahead.
  await page.keyboard.press('Shift+ArrowUp');
  await probeIsAt(page, 0, 5);
  await page.keyboard.press('w');
  await probeIsAt(page, 0, 10);
  await says(page, 'You stand 5 millimetres above the middle, facing up.');
  // After six turns to the left, what was ahead is still ahead: to the left of the scene.
  for (let k = 0; k < 6; ++k) await page.keyboard.press('a');
  await probeIsAt(page, -5, 5);
  await says(page, 'You stand 5 millimetres above the middle, facing left.');
  await page.keyboard.press('Shift+ArrowUp');
  await probeIsAt(page, -10, 5);
  expect(await page.locator('#read-pose').textContent()).toBe('0.0, 5.0, facing 90° left');
  await keepPicture(page, 'egocentric', true);
});

it('walks by buttons too, and every button has a name', async () => {
  const { page } = opened;
  await page.getByRole('button', { name: 'Re-centre' }).click();
  await page.getByRole('button', { name: 'Turn right' }).click();
  await page.getByRole('button', { name: 'Turn right' }).click();
  await page.getByRole('button', { name: 'Turn right' }).click();
  await page.getByRole('button', { name: 'Walk ahead' }).click();
  await page.getByRole('button', { name: 'Where do I stand?' }).click();
  await says(page, 'You stand 3.5 millimetres right of and 3.5 millimetres above the middle, facing up and right.');
  expect(await violations(page)).toEqual([]);
});
