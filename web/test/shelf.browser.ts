// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page: from the first page to touching one's own picture, by hand and by keys, and what may go wrong.
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, startProgram, violations, type Running } from './harness';

const drawing = join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'samples', 'boat.png');
const folder = mkdtempSync(join(tmpdir(), 'palpable-shelf-'));
let browser: Browser;
let running: Running;
let context: BrowserContext;
let page: Page;
const complaints: string[] = [];

beforeAll(async () => {
  process.env.XDG_STATE_HOME = folder;
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram({ instead: ['home'] })]);
  context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  page = await newPage(running.address);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
  rmSync(folder, { recursive: true, force: true });
});

const home = () => new URL('/', running.address).href;

async function newPage(address = home()): Promise<Page> {
  const made = await context.newPage();
  made.setDefaultTimeout(120_000);
  made.on('dialog', (dialog) => void dialog.accept());
  made.on('pageerror', (error) => complaints.push(String(error)));
  await made.goto(address);
  await made.getByRole('button', { name: 'Touch A church' }).waitFor();
  return made;
}

const alertSays = (on: Page, words: RegExp) => on.getByRole('alert').filter({ hasText: words }).waitFor();
const isTouched = (on: Page) => on.waitForFunction(() => location.pathname === '/touch' && document.getElementById('status')?.dataset.state === 'running');

/** Drops a file of this size, as if it were dragged from a folder. */
const drop = (on: Page, name: string, bytes: number) =>
  on.evaluate(
    ([fileName, size]) => {
      const data = new DataTransfer();
      data.items.add(new File([new Uint8Array(size as number)], fileName as string));
      for (const type of ['dragover', 'drop']) document.body.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
    },
    [name, bytes] as const,
  );

it.each([
  { width: 320, height: 640 },
  { width: 640, height: 320 },
  { width: 1280, height: 800 },
  { width: 3840, height: 2160 },
])('the shelf at $width x $height: nothing is cut off, and axe finds nothing', async (size) => {
  await page.setViewportSize(size);
  await keepPicture(page, `shelf-${size.width}x${size.height}`, true);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize({ width: 1280, height: 800 });
});

it('by keyboard alone, one is touching one\'s own picture after at most 12 key presses', async () => {
  let keys = 0;
  const press = async (key: string) => {
    ++keys;
    await page.keyboard.press(key);
  };
  // Playwright takes part in choosing files from some time after this on.
  const chooser = page.waitForEvent('filechooser');
  await page.reload();
  await page.getByRole('button', { name: 'Touch A church' }).waitFor();
  const focused = () => page.evaluate(() => document.activeElement?.id);
  while ((await focused()) !== 'choose') await press('Tab');
  await press('Enter');
  await (await chooser).setFiles(drawing);
  keys += 4; // In the system's dialogue: its folder, two arrow keys, Enter.
  await page.getByRole('radio', { name: /^a drawing/ }).waitFor();
  expect(await page.evaluate(() => (document.activeElement as HTMLInputElement).value)).toBe('drawing');
  await keepPicture(page, 'shelf-question', true);
  expect(await violations(page)).toEqual([]);
  await page.getByText('More', { exact: true }).click();
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize({ width: 320, height: 640 });
  await keepPicture(page, 'shelf-question-320', true);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.getByRole('radio', { name: /^a drawing/ }).focus();
  await press('Enter');
  await isTouched(page);
  console.log(`${keys} key presses from the first page to the touch`);
  expect(keys).toBeLessThanOrEqual(12);
  await page.getByRole('link', { name: 'All scenes' }).click();
  await page.getByRole('button', { name: 'Touch boat.png' }).waitFor();
  expect(await page.getByRole('link', { name: 'Go on touching boat.png' }).count()).toBe(1);
  await keepPicture(page, 'shelf-lately', true);
  expect(await violations(page)).toEqual([]);
});

it('the accessibility tree tells what each scene is', async () => {
  const tree = await page.locator('main').ariaSnapshot();
  writeFileSync(join(folder, 'tree.txt'), tree);
  for (const words of ['heading "Open your own"', 'button "Choose files"', 'heading "Opened lately"', 'heading "Samples"', 'button "Touch Oldbridge"', 'a street map'])
    expect(tree).toContain(words);
});

it('a sample is touched after one action, and another page is told', async () => {
  const other = await newPage();
  await other.getByRole('button', { name: 'Touch Oldbridge' }).click();
  await isTouched(other);
  // What is typed right after the key is typed into the dialog, and a name that is not given yet is given to no other scene.
  await other.locator('#stage').focus();
  await other.keyboard.press('t');
  await other.keyboard.type('plan of the town');
  expect(await other.locator('#name-text').inputValue()).toBe('plan of the town');
  await page.getByRole('button', { name: 'Touch A sailing boat' }).click();
  await isTouched(page);
  await other.waitForFunction(() => !(document.getElementById('name-dialog') as HTMLDialogElement).open);
  await other.waitForFunction(() => document.getElementById('scene-name')?.textContent?.includes('sailing boat'));
  await other.close();
  await page.goto(home());
  await page.getByRole('button', { name: 'Touch A church' }).waitFor();
});

it('a scene is saved by keyboard as a file that touches it by itself, with the names that it was given', async () => {
  await page.locator('#samples').getByRole('button', { name: 'Touch A sailing boat' }).click();
  await isTouched(page);
  await page.getByRole('application').first().press('t');
  await page.getByLabel('Name', { exact: true }).fill('The mast');
  await page.keyboard.press('Enter');
  await page.getByText('The mast').first().waitFor({ state: 'attached' });
  await page.getByRole('link', { name: 'All scenes' }).click();
  const save = page.getByRole('button', { name: 'Save A sailing boat, with names as a file' });
  await save.waitFor();
  await save.press('Enter');
  expect(await page.evaluate(() => (document.activeElement as HTMLInputElement).value)).toBe('phone');
  expect(await page.getByLabel('Paper', { exact: true }).isVisible()).toBe(false);
  await keepPicture(page, 'shelf-save-as', true);
  expect(await violations(page)).toEqual([]);
  const download = page.waitForEvent('download');
  await page.keyboard.press('Enter');
  const file = await download;
  expect(file.suggestedFilename()).toBe('A sailing boat, with names.html');
  const saved = join(folder, 'saved.html');
  await file.saveAs(saved);
  await page.getByRole('heading', { name: 'Saved: A sailing boat, with names.html' }).waitFor();
  expect(await page.getByRole('status').textContent()).toBe('Saved: A sailing boat, with names.html');
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('saved-title');
  await keepPicture(page, 'shelf-saved', true);
  expect(await violations(page)).toEqual([]);
  const pupil = await context.newPage();
  await pupil.goto(`file://${saved}`);
  await pupil.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  await pupil.getByRole('application').first().press('l');
  await pupil.getByText('The mast').first().waitFor();
  await pupil.close();
  await page.getByRole('button', { name: 'Back to the scenes' }).click();
  await page.setViewportSize({ width: 320, height: 640 });
  await save.click();
  await page.getByRole('radio', { name: /swell paper/ }).check();
  await page.getByLabel('Paper', { exact: true }).selectOption('A3');
  await keepPicture(page, 'shelf-save-as-320', true);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByRole('heading', { name: 'Saved as 2 files' }).waitFor();
  const files = await page.locator('#saved-files a').allTextContents();
  expect(files).toEqual(['A sailing boat, with names.svg', 'A sailing boat, with names-key.svg']);
  const drawing = await page.request.get(new URL((await page.getByRole('link', { name: 'A sailing boat, with names.svg' }).getAttribute('href'))!, home()).href);
  expect(await drawing.text()).toMatch(/^<\?xml[\s\S]*width="4\d\d|width="2\d\d/);
  await page.getByRole('button', { name: 'Back to the scenes' }).click();
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('choose');
});

it('a file of 500 MB, an empty one and a broken one are refused with a sentence, and the page goes on', async () => {
  await page.evaluate(() => {
    const file = new File(['x'], 'large.mp4');
    Object.defineProperty(file, 'size', { value: 500e6 });
    const event = new Event('paste', { bubbles: true, cancelable: true });
    Object.defineProperty(event, 'clipboardData', { value: { files: [file] } });
    document.dispatchEvent(event);
  });
  await alertSays(page, /large\.mp4: has 500 MB, and a page may open at most 300 MB/);
  await keepPicture(page, 'shelf-refused', true);
  expect(await violations(page)).toEqual([]);
  await drop(page, 'empty.png', 0);
  await alertSays(page, /empty\.png: is empty/);
  await drop(page, 'broken.png', 1000);
  await page.getByRole('button', { name: 'Make it touchable' }).click();
  await alertSays(page, /^broken\.png: /);
  await page.getByRole('button', { name: 'Cancel' }).click();
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('choose');
});

it('making is shown, can be cancelled, and leaves nothing behind', async () => {
  await page.getByRole('button', { name: 'Touch Sculptures on a table' }).click();
  await page.getByRole('heading', { name: 'Making the scene' }).waitFor();
  await keepPicture(page, 'shelf-making', true);
  expect(await violations(page)).toEqual([]);
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.getByRole('button', { name: 'Choose files' }).waitFor();
  expect(await page.getByRole('status').textContent()).toBe('Cancelled.');
});

it('scenes are removed from the list with their files', async () => {
  const kept = page.locator('#recent').getByRole('button', { name: /^Remove / });
  for (let left = await kept.count(); left > 0; --left) {
    await kept.first().click();
    await expect.poll(() => kept.count(), { timeout: 60_000 }).toBe(left - 1);
  }
  await page.getByRole('heading', { name: 'Opened lately' }).waitFor({ state: 'hidden' });
  expect(readdirSync(join(folder, 'palpable', 'scenes'))).toEqual([]);
  expect(complaints).toEqual([]);
});
