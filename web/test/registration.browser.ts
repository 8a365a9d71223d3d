// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand at a device touches three marks on the screen, and the scene is drawn where it feels it. The program's simulated hand is held;
// the page reads other places of it.
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, says, startProgram, violations, type Running } from './harness';

let running: Running;
let browser: Browser;
let page: Page;

/** Where the simulated hand is said to be. */
interface Hand {
  x_m: number;
  y_m: number;
  z_m: number;
}
/** Where its device is said to be in the scene. */
interface DeviceAt {
  x_m: number;
  y_m: number;
  z_m: number;
  turned_deg: number;
}
declare global {
  interface Window {
    hand: Hand;
    device: DeviceAt;
  }
}

const drawing = fileURLToPath(new URL('../../samples/boat.png', import.meta.url));

beforeAll(async () => {
  [running, browser] = await Promise.all([startProgram({ instead: ['touch', drawing, '--no-browser', '--device', 'sim:?script=hold'] }), launch()]);
  page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
  page.setDefaultTimeout(60_000);
  await page.addInitScript(() => {
    window.hand = { x_m: 0, y_m: 0, z_m: 0.05 };
    window.device = { x_m: 0, y_m: 0, z_m: 0, turned_deg: 0 };
    const parse = JSON.parse;
    JSON.parse = (text: string) => {
      const message = parse(text) as { type?: string; probes?: object[]; device?: object };
      if (message.type === 'state' && message.probes?.[0]) {
        Object.assign(message.probes[0], window.hand);
        message.device = window.device;
      }
      return message;
    };
  });
  await page.goto(running.address);
  await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  await page.locator('#depth').evaluate((depth) => ((depth as HTMLDetailsElement).open = true));
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

/** Of the marks on the stage. */
const shares = [[0.12, 0.85], [0.88, 0.85], [0.3, 0.15]] as const;

/** Rests at the places of the scene that are at the marks if a CSS pixel is a tenth of a millimetre of it; `order`: which mark's place first. */
async function touchMarks(order: readonly number[]): Promise<void> {
  await page.locator('#register-hand').click();
  for (const k of order) {
    await says(page, `ouch mark ${order.indexOf(k) + 1} of 3`);
    // The stage's size follows the sentence below it.
    const box = await page.locator('#stage').evaluate((stage) => ({ x: stage.getBoundingClientRect().x + 1, y: stage.getBoundingClientRect().y + 1, width: stage.clientWidth, height: stage.clientHeight }));
    const [across, down] = shares[k]!;
    await page.evaluate((hand) => (window.hand = hand), { x_m: 1e-4 * (box.x + box.width * across) - 0.03, y_m: 0.05 - 1e-4 * (box.y + box.height * down), z_m: 0.01 });
    // States come once a second while nothing changes; then the hand must rest for half a second.
    await page.waitForTimeout(3000);
    await page.keyboard.press('Enter');
  }
}

it('is offered for a device, in depth modes, and passes axe-core', async () => {
  expect(await page.locator('#register-hand').isVisible()).toBe(true);
  await page.locator('#register-hand').click();
  await says(page, 'paused, without force');
  expect(await page.locator('#depth-mode').inputValue()).toBe('head');
  expect(await page.locator('#status').getAttribute('data-state')).toBe('paused');
  expect(await violations(page)).toEqual([]);
  await keepPicture(page, 'registration');
  await page.keyboard.press('Escape');
  await says(page, 'Nothing was changed');
  expect(await page.locator('.registration-mark').count()).toBe(0);
});

it('places the scene at the touched marks, and says how exactly', async () => {
  await touchMarks([0, 1, 2]);
  await page.waitForFunction(() => /The scene is where the hand feels it, within 0(\.0\d*)? millimetres/.test(document.getElementById('spoken')!.textContent ?? ''));
  expect(await page.locator('#depth-words').textContent()).toContain('where the hand feels it');
  expect(await page.locator('#register-hand').textContent()).toBe('Put the scene back into the middle');
  await keepPicture(page, 'registered');
});

it('follows where a clutch moves the scene beneath the hand, which stays where it is', async () => {
  // What a clutch adds to the device's positions moves the hand in the scene.
  const marble = () => page.locator('#stage').screenshot();
  const before = await marble();
  await page.evaluate(() => {
    window.device = { x_m: 0.02, y_m: 0, z_m: 0, turned_deg: 0 };
    window.hand = { ...window.hand, x_m: window.hand.x_m + 0.02 };
  });
  // States come once a second while nothing changes.
  await page.waitForTimeout(3000);
  const after = await marble();
  expect(await page.locator('#register-hand').textContent()).toBe('Put the scene back into the middle');
  expect(after.equals(before)).toBe(false);
  await keepPicture(page, 'registered-clutched');
});

it('ends when the device is turned in the scene', async () => {
  await page.evaluate(() => (window.device = { ...window.device, turned_deg: 15 }));
  await page.waitForFunction(() => document.getElementById('register-hand')!.textContent === 'Put the scene where the hand is');
  await says(page, 'place under the hand has changed');
});

it('changes nothing where two marks were exchanged', async () => {
  await touchMarks([1, 0, 2]);
  await says(page, 'do not fit the marks');
  expect(await page.locator('#depth-words').textContent()).not.toContain('where the hand feels it');
});
