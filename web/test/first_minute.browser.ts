// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The first minute of a new user, sighted or blind: focus, sound, help, sliders and sizes.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, openMore, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram()]);
  opened = await openPage(browser, running.address);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});

it('the relief has the focus, so that the keys that are announced work', async () => {
  const { page } = opened;
  await says(page, 'Ready to touch: Sculptures on a table. A wooden table');
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('stage');
  await page.keyboard.press('d');
  await says(page, '8 objects rise above the table: ');
});

it('sound is offered until it runs, which takes one click', async () => {
  const offer = (page: Page) => page.getByRole('button', { name: 'Turn on sound' });
  const fresh = await opened.context.newPage();
  await fresh.goto(new URL('/', running.address).href);
  await fresh.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  expect(await offer(fresh).isVisible()).toBe(true);
  await offer(fresh).click();
  await offer(fresh).waitFor({ state: 'hidden' });
  await fresh.close();
});

it('help opens at its top, with gestures and keys', async () => {
  const { page } = opened;
  await page.getByRole('button', { name: 'Help and keys' }).click();
  const dialog = page.getByRole('dialog');
  await dialog.waitFor();
  const title = (await dialog.getByRole('heading', { level: 2 }).boundingBox())!;
  const box = (await dialog.boundingBox())!;
  expect(title.y).toBeGreaterThanOrEqual(box.y);
  expect(title.y + title.height).toBeLessThan(box.y + 120);
  expect(await dialog.getByRole('row', { name: /^Further fingers/ }).count()).toBe(1);
  await page.keyboard.press('Escape');
});

it('on a touch screen the line of hints names gestures, not keys', async () => {
  const context = await browser.newContext({ hasTouch: true, isMobile: true, viewport: { width: 390, height: 844 }, storageState: await opened.context.storageState() });
  const page = await context.newPage();
  await page.goto(new URL('/', running.address).href);
  await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  expect(await page.locator('#stage-keys').innerText()).toMatch(/Drag a finger/);
  expect(await page.locator('#stage-keys').innerText()).not.toMatch(/Shift/);
  await keepPicture(page, 'touch-screen');
  await page.getByRole('button', { name: 'Help and keys' }).click();
  expect((await page.getByRole('dialog').getByRole('heading', { level: 2 }).boundingBox())!.y).toBeGreaterThanOrEqual(0);
  await keepPicture(page, 'touch-screen-help');
  await context.close();
});

it('a simple panel is shown first, and the rest is under "more"', async () => {
  const { page } = opened;
  for (const name of ['Volume', 'Height']) expect(await page.getByRole('slider', { name, exact: true }).isVisible()).toBe(true);
  expect(await page.getByLabel('Force law').isVisible()).toBe(false);
  await openMore(page);
  expect(await page.getByLabel('Force law').isVisible()).toBe(true);
  await keepPicture(page, 'more');
  expect(await violations(page)).toEqual([]);
});

/** The value of every slider equals the displayed number; those of closed dialogs display none. */
async function slidersSayWhatTheyHold(page: Page): Promise<void> {
  const sliders = await page.locator('input[type=range]:enabled').evaluateAll((all) =>
    all.filter((input) => !input.closest('dialog:not([open]), [hidden]')).map((input) => ({ id: input.id, value: (input as HTMLInputElement).valueAsNumber, words: input.getAttribute('aria-valuetext') ?? '' })),
  );
  for (const { id, value, words } of sliders) expect(`${id} ${Number(/-?[\d.]+/.exec(words)?.[0])}`).toBe(`${id} ${value}`);
  expect(sliders.length).toBeGreaterThan(5);
}

it('every slider has the value that it displays, whatever moves it', async () => {
  const { page } = opened;
  await openMore(page);
  await slidersSayWhatTheyHold(page);
  const stiffness = page.getByRole('slider', { name: 'Stiffness', exact: true });
  expect(await stiffness.getAttribute('aria-valuetext')).toMatch(/^500 N\/m/);
  await stiffness.focus();
  await page.keyboard.press('ArrowRight');
  expect(await stiffness.getAttribute('aria-valuetext')).toMatch(/^520 N\/m/);
  await stiffness.click();
  await slidersSayWhatTheyHold(page);
  await page.getByRole('button', { name: 'Reset', exact: true }).click();
  await page.waitForFunction(() => document.getElementById('parameter-stiffness_N_per_m')?.getAttribute('aria-valuetext')?.startsWith('500 N/m'));
});

it('with "Speak aloud", each changed setting is spoken with its value', async () => {
  const { page } = opened;
  await page.evaluate(() => {
    const kept = window as unknown as { spoken: string[] };
    kept.spoken = [];
    window.speechSynthesis.speak = (utterance) => void kept.spoken.push(utterance.text);
  });
  const spoken = (words: string) => page.waitForFunction((wanted) => (window as unknown as { spoken: string[] }).spoken.includes(wanted), words);
  const speech = page.getByRole('checkbox', { name: /^Speak aloud/ });
  await speech.focus();
  await page.keyboard.press('Space');
  await page.getByRole('slider', { name: 'Height', exact: true }).focus();
  await page.keyboard.press('ArrowRight');
  await spoken('Height: × 1.05');
  await page.getByLabel('Colours').focus();
  await page.keyboard.press('ArrowDown');
  await spoken('Colours: Light');
  await speech.focus();
  await page.keyboard.press('Space');
  await page.getByRole('button', { name: 'Reset', exact: true }).click();
});

describe('the page in every size', () => {
  const sizes = [
    { width: 1440, height: 900 },
    { width: 1920, height: 1080 },
    { width: 1280, height: 800 },
    { width: 1024, height: 600 },
  ];
  it.each(sizes)('$width x $height shows all of it, and the picture fills its stage', async (size) => {
    const { page } = opened;
    await page.setViewportSize(size);
    await page.waitForTimeout(300);
    await keepPicture(page, `size-${size.width}x${size.height}`);
    const boxes = await page.evaluate(() => {
      const box = (selector: string) => document.querySelector(selector)!.getBoundingClientRect();
      const [stage, footer, told] = [box('#stage'), box('footer'), box('.told')];
      return { stage: [stage.width, stage.height], footer: footer.bottom, aboveFooter: told.bottom <= footer.top, scrolls: document.documentElement.scrollHeight > innerHeight };
    });
    expect(boxes).toMatchObject({ aboveFooter: true, scrolls: false });
    expect(boxes.footer).toBeLessThanOrEqual(size.height + 0.5);
    expect(boxes.stage[1]! / size.height).toBeGreaterThan(0.4);
    // The caption shows whole lines only, however long it is.
    const caption = await page.locator('#spoken').evaluate((spoken) => {
      const words = spoken.textContent;
      spoken.textContent = 'A sentence that is much longer than the caption. '.repeat(20);
      const style = getComputedStyle(spoken);
      const shown = spoken.clientHeight - parseFloat(style.paddingTop) - parseFloat(style.paddingBottom);
      const cut = spoken.scrollHeight > spoken.clientHeight;
      spoken.textContent = words;
      return { cut, lines: shown / parseFloat(style.lineHeight) };
    });
    expect(caption.cut).toBe(true);
    expect(caption.lines).toBeGreaterThanOrEqual(1);
    expect(Math.abs(caption.lines - Math.round(caption.lines))).toBeLessThan(0.05);
    // The relief fills the height or the width of the stage except for a margin.
    const drawn = await page.locator('#stage canvas').evaluate((canvas) => {
      const { width, height } = canvas as HTMLCanvasElement;
      const pixels = (canvas as HTMLCanvasElement).getContext('2d')!.getImageData(0, 0, width, height).data;
      const isInk = (x: number, y: number) => pixels[4 * (y * width + x) + 3]! > 0;
      const count = (length: number, at: (k: number) => boolean) => Array.from({ length }, (_, k) => at(k)).filter(Boolean).length / length;
      return [count(width, (x) => isInk(x, height >> 1)), count(height, (y) => isInk(width >> 1, y))];
    });
    expect(Math.max(...drawn)).toBeGreaterThan(0.9);
  });
});

describe('a scene of contours', () => {
  it('opens with its law and the parameters of that law', async () => {
    const folder = mkdtempSync(join(tmpdir(), 'palpable-contours-'));
    const side = 64;
    const rows = Array.from({ length: side }, (_, y) => Array.from({ length: side }, (_, x) => (Math.hypot(x - 32, y - 32) < 20 ? '200' : '30')).join(' '));
    writeFileSync(join(folder, 'disc.pgm'), `P2\n${side} ${side}\n255\n${rows.join('\n')}\n`);
    const own = await startProgram({ instead: ['touch', join(folder, 'disc.pgm')] });
    try {
      const { page, context } = await openPage(browser, own.address);
      await openMore(page);
      const law = page.getByLabel('Force law');
      expect(await law.inputValue()).not.toBe('');
      expect(await page.getByRole('slider', { name: 'Height' }).isDisabled()).toBe(true);
      expect(await page.locator('#parameters input').count()).toBeGreaterThan(0);
      await slidersSayWhatTheyHold(page);
      await keepPicture(page, 'contours');
      await context.close();
    } finally {
      await own.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });
});

describe('scenes of other sizes', () => {
  it.each([
    { millimetres: 5, step: '0.05\u00A0mm', position: '0.25, 0.00' },
    { millimetres: 1000, step: '10\u00A0mm', position: '50.0, 0.0' },
  ])('$millimetres mm: steps, marble and camera follow', async ({ millimetres, step, position }) => {
    const folder = mkdtempSync(join(tmpdir(), 'palpable-size-'));
    const corners = [0, 1].flatMap((z) => [0, 1].flatMap((y) => [0, 1].map((x) => `v ${x} ${y} ${z}`)));
    const faces = ['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map((face) => `f ${face}`);
    writeFileSync(join(folder, 'box.obj'), [...corners, ...faces, ''].join('\n'));
    const own = await startProgram({ instead: ['touch', join(folder, 'box.obj'), '--resolution', '32', '--size', `${millimetres}x${millimetres}x${millimetres}`] });
    try {
      const { page, context } = await openPage(browser, own.address);
      expect(await page.locator('#step-fine').textContent()).toBe(step);
      await page.keyboard.press('Shift+ArrowRight');
      await page.waitForFunction((wanted) => document.getElementById('read-position')?.textContent === wanted, position);
      await page.waitForFunction(() => Number(document.getElementById('read-force')?.textContent) > 0.05);
      await keepPicture(page, `scene-of-${millimetres}-mm`);
      await context.close();
    } finally {
      await own.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  });
});
