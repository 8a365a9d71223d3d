// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Touching in a real browser: by pointer, and by keyboard with only the information that a screen reader receives.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { readRaster, type HeightsFrame } from '../src/codec';
import { framesDrawn, keepPicture, launch, openMore, openPage, startProgram, type Opened, type Running } from './harness';
import { Listener } from './listener';

let browser: Browser;
let running: Running;
let opened: Opened;
let heights: HeightsFrame;

beforeAll(async () => {
  // The view from above: a machine without a graphics processor draws it 60 times per second even when busy. The 3D view is
  // tested in states.browser.ts.
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram()]);
  opened = await openPage(browser, running.address, {}, (payload) => {
    const raster = readRaster(payload);
    if (typeof raster !== 'string' && raster.kind === 'heights') heights = raster;
  });
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});
beforeEach(async () => {
  await opened.page.getByRole('button', { name: 'Re-centre' }).click();
});

const number = (page: Page, id: string) => page.locator(`#${id}`).textContent().then((text) => Number.parseFloat(text ?? ''));

/** A reading once it is stable: within 2 % of its mean for ten samples in a row. A hand oscillates first after it was re-centred or
 * the scene was changed. */
async function settled(page: Page, id: string): Promise<number> {
  let looks: number[] = [];
  for (let k = 0; k < 600; ++k) {
    looks = [...looks, await number(page, id)].slice(-10);
    const mean = looks.reduce((sum, look) => sum + look, 0) / looks.length;
    if (looks.length === 10 && looks.every((look) => Math.abs(look - mean) <= 0.02 * Math.abs(mean))) return mean;
    await page.waitForTimeout(100);
  }
  throw new Error(`${id} never came to rest; last: ${looks.join(', ')}`);
}

describe('by pointer', () => {
  it('the force changes as the marble moves over the surface', async () => {
    const { page } = opened;
    const stage = (await page.locator('#stage').boundingBox())!;
    const forces = new Set<string>();
    const heightsMet = new Set<string>();
    for (let k = 0; k <= 30; ++k) {
      await page.mouse.move(stage.x + stage.width * (0.3 + 0.4 * (k / 30)), stage.y + stage.height * (0.3 + 0.3 * (k / 30)));
      await page.waitForTimeout(60);
      forces.add((await page.locator('#read-force').textContent())!);
      heightsMet.add((await page.locator('#read-height').textContent())!);
    }
    await keepPicture(page, 'touching');
    expect(forces.size).toBeGreaterThan(5);
    expect(heightsMet.size).toBeGreaterThan(5);
    await page.waitForFunction(() => Number.parseFloat(document.getElementById('read-force')?.textContent ?? '') > 0.05);
  });

  it('the view from above, of which only parts are drawn at each move, is as if it were drawn whole', async () => {
    const { page } = opened;
    const stage = (await page.locator('#stage').boundingBox())!;
    for (let k = 0; k <= 40; ++k) {
      await page.mouse.move(stage.x + stage.width * (0.5 + 0.49 * Math.sin(k)), stage.y + stage.height * (0.5 + 0.49 * Math.cos(2 * k)));
      await framesDrawn(page, 2);
    }
    // Compared in the page: two million numbers take half a minute to come from it.
    const keepPixels = (name: 'inParts' | 'whole') =>
      page.evaluate((kept) => {
        const canvas = document.querySelector<HTMLCanvasElement>('#stage canvas')!;
        Object.assign(window, { [kept]: canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height).data });
      }, name);
    await settled(page, 'read-force');
    await keepPixels('inParts');
    await page.locator('#stage').focus();
    await page.keyboard.press('r');
    await framesDrawn(page, 4);
    await keepPixels('whole');
    const { shown, differing, lengths } = await page.evaluate(() => {
      const { inParts, whole } = window as unknown as { inParts: Uint8ClampedArray; whole: Uint8ClampedArray };
      return {
        shown: inParts.some((value) => value !== inParts[0]),
        differing: inParts.filter((value, i) => value !== whole[i]).length,
        lengths: [inParts.length, whole.length],
      };
    });
    expect(shown).toBe(true);
    expect(lengths[0]).toBe(lengths[1]);
    expect(differing).toBe(0);
  });

  it('a pause sets the force to zero, and resuming restores it', async () => {
    const { page } = opened;
    await page.waitForFunction(() => Number.parseFloat(document.getElementById('read-force')?.textContent ?? '') > 0.05);
    await page.getByRole('button', { name: 'Pause' }).click();
    await page.waitForFunction(() => document.getElementById('read-force')?.textContent === '0.00');
    await page.getByRole('button', { name: 'Resume' }).click();
    await page.waitForFunction(() => Number.parseFloat(document.getElementById('read-force')?.textContent ?? '') > 0.05);
  });

  it('a changed setting reaches the program, and is undone and redone by keys', async () => {
    const { page } = opened;
    const slider = page.getByRole('slider', { name: 'Height' });
    const height = await settled(page, 'read-height');
    await slider.focus();
    for (let k = 0; k < 10; ++k) await page.keyboard.press('ArrowRight');
    const doubled = (factor: number) =>
      page.waitForFunction(
        ([wanted]) => Math.abs(Number.parseFloat(document.getElementById('read-height')?.textContent ?? '') - wanted!) < 0.15,
        [height * factor],
      );
    await doubled(1.5);
    expect(await slider.getAttribute('aria-valuetext')).toBe('× 1.5');
    await page.keyboard.press('Control+z');
    await doubled(1);
    await page.keyboard.press('Control+Shift+Z');
    await doubled(1.5);
    await page.keyboard.press('Control+z');
    await doubled(1);
  });
});

describe('the materials', () => {
  it('are edited by keyboard, felt, undone by name, and saved in the scene', async () => {
    const { page } = opened;
    await openMore(page);
    await page.locator('#region-here').click();
    const before = await settled(page, 'read-force');
    expect(before).toBeGreaterThan(0.05);
    const stiffness = page.getByRole('slider', { name: 'Region stiffness' });
    await stiffness.focus();
    await page.keyboard.press('Home');
    expect(await stiffness.getAttribute('aria-valuetext')).toBe('20 N/m');
    const becomes = (least: number, most: number) =>
      page.waitForFunction(
        ([low, high]) => {
          const now = Number.parseFloat(document.getElementById('read-force')?.textContent ?? '');
          return now >= low! && now <= high!;
        },
        [before * least, before * most],
      );
    await becomes(0, 0.3);
    await page.getByLabel('Texture', { exact: true }).selectOption('ridges');
    expect(await page.getByRole('slider', { name: 'Texture height' }).isEnabled()).toBe(true);
    await keepPicture(page, 'material', true);
    await page.getByRole('button', { name: 'Save the scene' }).click();
    await page.waitForFunction(() => /saved as/.test(document.getElementById('spoken')?.textContent ?? ''));
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => (document.getElementById('texture') as HTMLSelectElement).value === 'none');
    await page.keyboard.press('Control+z');
    await becomes(0.7, 1.3);
  });
});

describe('by keyboard, hearing only', () => {
  it('finds the highest point, to 3 % of the relief or half a millimetre', async () => {
    const { page } = opened;
    await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    const listener = await Listener.at(page);
    expect((await listener.tabTo('application')).name).toMatch(/^(Surface|Lines) of .* to touch$/);

    await listener.ask('d', /8 objects rise above the table: .*D again says more\./);
    await listener.ask('d', /A wooden table, seen from above/);
    const [, way] = await listener.ask('d', /From the probe to the highest point: ([^.]+)\./);
    const millimetres = (direction: string) => Number(new RegExp(`(\\d+) millimetres? ${direction}`).exec(way!)?.[1] ?? 0);
    await listener.walk(millimetres('right') - millimetres('left'), 'ArrowRight', 'ArrowLeft');
    await listener.walk(millimetres('up') - millimetres('down'), 'ArrowUp', 'ArrowDown');
    // The last millimetre by trial: a step that leads down is reversed.
    const opposite = { ArrowRight: 'ArrowLeft', ArrowLeft: 'ArrowRight', ArrowUp: 'ArrowDown', ArrowDown: 'ArrowUp' };
    let best = Number((await listener.ask('p', /Height (-?[\d.]+) millimetres?/))[1]);
    for (const [key, back] of Object.entries(opposite)) {
      const [, there] = await listener.ask(key, /(-?[\d.]+) millimetres?/);
      if (Number(there) > best) best = Number(there);
      else await listener.ask(back, /millimetres?/);
    }
    const [, heard] = await listener.ask('p', /Height (-?[\d.]+) millimetres?/);

    const highest = 1000 * heights.heights.reduce((most, z) => Math.max(most, z), -Infinity);
    const lowest = 1000 * heights.heights.reduce((least, z) => Math.min(least, z), Infinity);
    expect(Number(heard)).toBeGreaterThan(highest - Math.max(0.5, 0.03 * (highest - lowest)));
    // The sentences agree with what the servo computes, not only with the state of the page.
    // Both are tenths of a millimetre: at most three of them apart.
    expect(Math.abs((await settled(page, 'read-height')) - Number(heard))).toBeLessThan(0.35);
    await keepPicture(page, 'highest-point');
  });

  it('every control has a name and can be reached by Tab', async () => {
    const { page } = opened;
    await openMore(page);
    await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
    const wanted = await page.locator('button:visible:enabled, input:visible:enabled, select:visible:enabled').evaluateAll((all) => all.map(({ id }) => id));
    const reached = new Set<string>();
    for (let k = 0; k < wanted.length + 10; ++k) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement?.id ?? ''));
    }
    expect(wanted.filter((id) => !reached.has(id))).toEqual([]);
    expect(wanted.length).toBeGreaterThan(15);
  });
});
