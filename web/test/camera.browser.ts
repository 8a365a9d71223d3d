// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Rotation, shift, zoom and reset of the picture by drag, wheel, pinch and keys; the probe does not move.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { keepPicture, launch, openPage, startProgram, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram()]);
  opened = await openPage(browser, running.address, { hasTouch: true });
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});
beforeEach(() => opened.page.getByRole('button', { name: 'Reset view' }).click());

const box = async (page: Page) => (await page.locator('#stage').boundingBox())!;
const position = (page: Page) => page.locator('#read-position').textContent().then((text) => (text ?? '').split(',').map(Number.parseFloat) as [number, number]);

/** Moves the pointer to a relative position on the stage and returns the final position of the probe. */
async function probeUnder(page: Page, across: number, down: number): Promise<[number, number]> {
  const { x, y, width, height } = await box(page);
  await page.mouse.move(x + width * across, y + height * down);
  let before = await position(page);
  for (let k = 0; k < 50; ++k) {
    await page.waitForTimeout(250);
    const now = await position(page);
    if (Math.abs(now[0] - before[0]) + Math.abs(now[1] - before[1]) < 0.05) return now;
    before = now;
  }
  return before;
}
/** Drags with a mouse button; distances are relative to the size of the stage. */
async function drag(page: Page, button: 'left' | 'middle' | 'right', across: number, down: number): Promise<void> {
  const { x, y, width, height } = await box(page);
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down({ button });
  for (let k = 1; k <= 4; ++k) await page.mouse.move(x + width * (0.5 + (across * k) / 4), y + height * (0.5 + (down * k) / 4));
  await page.mouse.up({ button });
}

describe('the picture from above', () => {
  it('is zoomed by the wheel about the pointer, and reset', async () => {
    const { page } = opened;
    const before = await probeUnder(page, 0.5, 0.3);
    expect(before[1]).toBeGreaterThan(5);
    const { x, y, width, height } = await box(page);
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.wheel(0, -Math.log(2) / 0.0015);
    const after = await probeUnder(page, 0.5, 0.3);
    expect(after[1] / before[1]).toBeCloseTo(0.5, 1);
    await keepPicture(page, 'zoomed');
    await page.getByRole('button', { name: 'Reset view' }).click();
    expect((await probeUnder(page, 0.5, 0.3))[1]).toBeCloseTo(before[1], 0);
  });

  it('is shifted by the middle button, without moving the probe', async () => {
    const { page } = opened;
    const before = await probeUnder(page, 0.5, 0.5);
    await drag(page, 'middle', 0, 0.2);
    expect(await position(page)).toEqual(before);
    expect((await probeUnder(page, 0.5, 0.7))[1]).toBeCloseTo(before[1], 0);
  });

  it('is zoomed and shifted by keys; arrows move the probe again after C', async () => {
    const { page } = opened;
    await page.mouse.move(2, 2);
    await page.locator('#stage').focus();
    await page.keyboard.press('Home');
    for (const key of ['+', '+', '+']) await page.keyboard.press(key);
    await page.locator('#spoken').filter({ hasText: 'Zoom 195 percent' }).waitFor();
    await page.keyboard.press('c');
    expect(await page.getByRole('button', { name: 'Move picture' }).getAttribute('aria-pressed')).toBe('true');
    // The line of keys itself is not shown where a finger points.
    expect(await page.locator('#arrows-move-picture').getAttribute('hidden')).toBeNull();
    expect(await page.locator('#arrows-move-picture').textContent()).toContain('turn the picture');
    await page.keyboard.press('Shift+ArrowUp');
    await page.locator('#spoken').filter({ hasText: /The picture is centred \d+ millimetres down from the middle/ }).waitFor();
    await page.keyboard.press('ArrowLeft');
    await page.locator('#spoken').filter({ hasText: 'Seen from above the picture does not turn.' }).waitFor();
    expect(await position(page)).toEqual([0, 0]);
    await page.keyboard.press('c');
    expect(await page.locator('#arrows-move-picture').getAttribute('hidden')).not.toBeNull();
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.getElementById('read-position')?.textContent === '1.0, 0.0');
    await page.keyboard.press('r');
  });

  it('is zoomed by a pinch once the picture is moved, and no finger is a probe then', async () => {
    const { page, context } = opened;
    const before = await probeUnder(page, 0.5, 0.3);
    await page.getByRole('button', { name: 'Move picture' }).click();
    const session = await context.newCDPSession(page);
    const { x, y, width, height } = await box(page);
    const fingers = (spread: number) => [-1, 1].map((side, id) => ({ x: x + width / 2 + side * spread, y: y + height / 2, id }));
    await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: fingers(50) });
    for (const spread of [60, 70, 80, 90, 100]) await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: fingers(spread) });
    await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    expect(await page.locator('#probe option').count()).toBe(1);
    await page.getByRole('button', { name: 'Move picture' }).click();
    expect((await probeUnder(page, 0.5, 0.3))[1] / before[1]).toBeCloseTo(0.5, 1);
  });
});
