// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Every state that a user may meet: checked by axe-core here, and inspected by eye in web/test-results.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let flatBrowser: Browser;
let running: Running;
let key: Awaited<ReturnType<Opened['context']['storageState']>>;

beforeAll(async () => {
  [browser, flatBrowser, running] = await Promise.all([launch(), launch({ webgl: false }), startProgram()]);
  // The address admits one browser once; further windows of these tests send the cookie that it received.
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
  // One window is used for all of them, because opening a new one each time would take most of the time. It uses the view
  // from above, which is fast without a graphics processor; the 3D view is tested below.
  let opened: Opened;
  beforeAll(async () => {
    opened = await openPage(flatBrowser, home(), { storageState: key });
    await opened.page.mouse.move(200, 330);
  });
  afterAll(() => opened?.context.close());

  const desktop = { width: 1280, height: 800 };
  const colours = (theme: string) => (page: Page) => page.getByLabel('Colours').selectOption(theme);
  const states: [string, (page: Page) => Promise<unknown>, (page: Page) => Promise<unknown>][] = [
    ['desktop', async () => undefined, async () => undefined],
    ['200-percent', (page) => page.setViewportSize({ width: 640, height: 400 }), (page) => page.setViewportSize(desktop)],
    ['phone', (page) => page.setViewportSize({ width: 320, height: 640 }), (page) => page.setViewportSize(desktop)],
    ['dark', (page) => page.emulateMedia({ colorScheme: 'dark' }), (page) => page.emulateMedia({ colorScheme: 'light' })],
    ['reduced-motion', (page) => page.emulateMedia({ reducedMotion: 'reduce' }), (page) => page.emulateMedia({ reducedMotion: null })],
    ['forced-colours', (page) => page.emulateMedia({ forcedColors: 'active' }), (page) => page.emulateMedia({ forcedColors: 'none' })],
    ['high-contrast', colours('contrast'), colours('system')],
    [
      'clay',
      (page) => page.getByLabel('Surface', { exact: true }).selectOption('clay'),
      (page) => page.getByLabel('Surface', { exact: true }).selectOption('picture'),
    ],
    ['described', (page) => page.getByRole('button', { name: 'Describe' }).click(), async () => undefined],
    [
      'paused',
      async (page) => {
        await page.getByRole('button', { name: 'Pause' }).click();
        await page.getByRole('button', { name: 'Resume' }).waitFor();
      },
      (page) => page.getByRole('button', { name: 'Resume' }).click(),
    ],
    ['help', (page) => page.getByRole('button', { name: 'Help and keys' }).click(), (page) => page.keyboard.press('Escape')],
    [
      'depth-without-webgl',
      async (page) => {
        await page.setViewportSize({ width: 320, height: 640 });
        await page.locator('#depth > summary').click();
        await page.getByText('True depth needs WebGL, which this browser does not offer.').waitFor();
        expect(await page.getByLabel('Depth mode').isDisabled()).toBe(true);
      },
      async () => undefined,
    ],
    [
      'measure-the-screen',
      (page) => page.getByRole('button', { name: 'Measure the screen' }).click(),
      async (page) => {
        await page.keyboard.press('Escape');
        await page.locator('#depth > summary').click();
        await page.setViewportSize(desktop);
      },
    ],
  ];
  it.each(states)('%s passes axe-core and has no horizontal scroll bar', async (name, enter, leave) => {
    const { page, complaints } = opened;
    await enter(page);
    try {
      await page.waitForTimeout(100);
      await keepPicture(page, name, ['phone', '200-percent', 'depth-without-webgl'].includes(name));
      expect(await violations(page)).toEqual([]);
      expect(await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)).toBeLessThanOrEqual(0);
      // A browser without WebGL reports exactly that.
      expect(complaints.filter((complaint) => !complaint.includes('WebGL'))).toEqual([]);
    } finally {
      await leave(page);
    }
  });
});

describe('the page in 3D', () => {
  let opened: Opened;
  beforeAll(async () => {
    opened = await openPage(browser, home(), { storageState: key });
  });
  afterAll(() => opened?.context.close());

  it('passes axe-core, and the force changes with the position of the pointer', async () => {
    const { page, complaints } = opened;
    await keepPicture(page, 'in-3d');
    expect(await violations(page)).toEqual([]);
    const stage = (await page.locator('#stage').boundingBox())!;
    const felt = new Set<string>();
    for (const part of [0.35, 0.42, 0.5, 0.58, 0.65]) {
      await page.mouse.move(stage.x + stage.width * part, stage.y + stage.height * part);
      await page.waitForTimeout(300);
      felt.add((await page.locator('.readout').textContent())!);
    }
    expect(felt.size).toBeGreaterThan(3);
    expect(complaints).toEqual([]);
  });

  it('is rotated by dragging with the right button, and an arrow that points at the viewer does not hide the marble', async () => {
    const { page } = opened;
    await page.locator('#stage').focus();
    await page.keyboard.press('Home');
    await page.getByRole('slider', { name: 'Tilt' }).focus();
    await page.keyboard.press('Home');
    await page.waitForFunction(() => Number(document.getElementById('read-force')?.textContent) > 0.2);
    const stage = (await page.locator('#stage').boundingBox())!;
    const [middleX, middleY] = [stage.x + stage.width / 2, stage.y + stage.height / 2];
    // Seen from directly above, the marble is in the middle of the picture and the force points at the viewer.
    const clip = { x: Math.round(middleX) - 1, y: Math.round(middleY) - 1, width: 3, height: 3 };
    const middleColour = async () => {
      const middle = await page.screenshot({ clip });
      return page.evaluate(async (bytes) => {
        // An image element would need to load an address, which the page is not allowed to do.
        const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: 'image/png' }));
        const pen = new OffscreenCanvas(3, 3).getContext('2d')!;
        pen.drawImage(image, 0, 0);
        return [...pen.getImageData(1, 1, 1, 1).data];
      }, [...middle]);
    };
    // The camera has rotated as soon as a busy machine has drawn it.
    let [red, green, blue] = await middleColour();
    for (let k = 0; k < 40 && red! - blue! <= 60; ++k) {
      await page.waitForTimeout(250);
      [red, green, blue] = await middleColour();
    }
    expect(red! - blue!, `${red} ${green} ${blue}`).toBeGreaterThan(60);
    await keepPicture(page, 'end-on');
    await page.mouse.move(middleX, middleY);
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(middleX - 112, middleY);
    await page.mouse.move(middleX - 225, middleY - 75);
    await page.mouse.up({ button: 'right' });
    expect(await page.getByRole('slider', { name: 'Tilt' }).getAttribute('aria-valuetext')).toBe('30°');
    await keepPicture(page, 'turned');
    // After a rotation by 90 degrees, what was at the top of the picture is at its left or right.
    await page.mouse.move(middleX + 80, middleY, { steps: 3 });
    await page.waitForFunction(() => {
      const [x, y] = (document.getElementById('read-position')?.textContent ?? '').split(',').map(Number.parseFloat);
      return Math.abs(y!) > 5 && Math.abs(x!) < 4;
    });
    await page.getByRole('button', { name: 'Reset view' }).click();
    expect(await page.getByRole('slider', { name: 'Tilt' }).getAttribute('aria-valuetext')).toBe('25°');
  });

  it('shows true depth: chosen, measured with a card and seen from beside by keys, and undone', async () => {
    const { page, complaints } = opened;
    await page.locator('#depth > summary').focus();
    await page.keyboard.press('Enter');
    await page.getByLabel('Depth mode').focus();
    await page.keyboard.press('r');
    await says(page, 'Coloured glasses: Red–cyan. The true depth: disparities up to');
    expect(await violations(page)).toEqual([]);
    await page.getByRole('button', { name: 'Measure the screen' }).focus();
    await page.keyboard.press('Enter');
    const width = page.getByRole('slider', { name: 'Width of the card' });
    const before = Number(await width.inputValue());
    for (const key of ['ArrowLeft', 'ArrowLeft', 'Tab', 'Enter']) await page.keyboard.press(key);
    await says(page, 'as measured');
    await page.getByRole('button', { name: 'Measure the screen' }).click();
    expect(Number(await width.inputValue())).toBe(before - 2);
    await page.keyboard.press('Escape');
    await page.locator('#stage').focus();
    await page.keyboard.press('v');
    await says(page, 'Arrows move your head');
    await page.keyboard.press('ArrowRight');
    await says(page, 'Your head is 1 centimetre right.');
    await keepPicture(page, 'depth');
    await page.keyboard.press('v');
    await page.keyboard.press('r');
    await page.keyboard.press('Control+z');
    await says(page, 'Undone: size of the screen.');
    await page.keyboard.press('Control+z');
    await says(page, 'Undone: depth mode.');
    expect(await page.getByLabel('Depth mode').inputValue()).toBe('plain');
    expect(complaints).toEqual([]);
  });

  it('offers the view from above if drawing is slow', async () => {
    const { page } = opened;
    // A machine on which every frame waits a fifth of a second.
    await page.evaluate(() => {
      const ask = window.requestAnimationFrame.bind(window);
      window.requestAnimationFrame = (callback) => window.setTimeout(() => ask(callback), 200);
    });
    await page.locator('#stage').focus();
    const offer = page.getByRole('button', { name: 'Show it from above' });
    for (let k = 0; k < 60 && !(await offer.isVisible()); ++k) {
      await page.keyboard.press(k % 2 === 0 ? 'ArrowRight' : 'ArrowLeft');
      await page.waitForTimeout(100);
    }
    await keepPicture(page, 'slow');
    await offer.click();
    await page.waitForFunction(() => (document.getElementById('view') as HTMLSelectElement).value === 'flat');
    expect(await page.locator('#view-note').isVisible()).toBe(false);
  });
});

describe('the page with a fault', () => {
  it('without WebGL is shown from above, says so, and can still be touched', async () => {
    const opened = await openPage(flatBrowser, home(), { storageState: key });
    const { page } = opened;
    // The opening sentences come first; the sentence for a step before them is dropped.
    await page.waitForFunction(() => document.getElementById('spoken')?.textContent !== '');
    await page.locator('#stage').focus();
    await page.keyboard.press('Home'); // other tests have left the probe elsewhere
    expect(await page.locator('#view-note').textContent()).toMatch(/WebGL.*Touch, sound and speech work/);
    // On a busy machine, the sentence for one step may expire before it is spoken.
    const spoken = page.locator('#spoken').filter({ hasText: 'millimetre' });
    for (let k = 0; k < 20 && !(await spoken.isVisible()); ++k) {
      await page.keyboard.press(k % 2 === 0 ? 'ArrowRight' : 'ArrowLeft');
      await page.waitForTimeout(1500);
    }
    expect(await spoken.isVisible()).toBe(true);
    await keepPicture(page, 'no-webgl');
    expect(await violations(page)).toEqual([]);
    await opened.context.close();
  });

  it('a browser without the token is told so', async () => {
    const context = await flatBrowser.newContext();
    const page = await context.newPage();
    await page.goto(home());
    await page.getByRole('alert').filter({ hasText: 'has no access to the session' }).waitFor();
    expect(await page.locator('#scene-name').textContent()).toBe('No scene');
    expect(await page.locator('#status').textContent()).toBe('No access');
    await keepPicture(page, 'refused');
    expect(await violations(page)).toEqual([]);
    await page.goto('about:blank');
    await page.goto(running.address);
    await page.getByRole('alert').filter({ hasText: 'was used already' }).waitFor();
    await context.close();
  });

  it('a field shows its cells and describes them', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'palpable-cells-'));
    const corners = [0, 1].flatMap((z) => [0, 1].flatMap((y) => [0, 1].map((x) => `v ${x} ${y} ${z}`)));
    const faces = ['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map((face) => `f ${face}`);
    writeFileSync(join(folder, 'box.obj'), [...corners, ...faces, ''].join('\n'));
    const own = await startProgram(join(folder, 'box.obj'), '--resolution', '48', '--size', '100x100x50');
    try {
      const { page, context } = await openPage(flatBrowser, own.address);
      await page.getByLabel('Surface', { exact: true }).selectOption('Cells of the field');
      await page.locator('#spoken').filter({ hasText: /The field has \d+ cells; at the surface they are/ }).waitFor();
      expect(await page.locator('#read-height-name').textContent()).toBe('Towards you, mm');
      await keepPicture(page, 'cells');
      expect(await violations(page)).toEqual([]);
      await context.close();
    } finally {
      await own.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });

  it('the end of the session is reported', async () => {
    const own = await startProgram();
    const opened = await openPage(flatBrowser, own.address).finally(() => own.stop());
    await opened.page.getByRole('alert').filter({ hasText: 'The session has ended' }).waitFor();
    await keepPicture(opened.page, 'ended');
    expect(await violations(opened.page)).toEqual([]);
    await opened.context.close();
  });
});
