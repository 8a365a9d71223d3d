// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Several probes at once in a real browser: by fingers on a touch screen, and by keys alone, heard and seen.
import type { Browser, CDPSession, Page } from 'playwright-core';
import { afterAll, beforeAll, beforeEach, expect, it } from 'vitest';
import { keepPicture, launch, openMore, openPage, says, startProgram, violations, type Opened, type Running } from './harness';

let browser: Browser;
let running: Running;
let opened: Opened;
let session: CDPSession;

beforeAll(async () => {
  [browser, running] = await Promise.all([launch({ webgl: false }), startProgram()]);
  opened = await openPage(browser, running.address, { hasTouch: true });
  session = await opened.context.newCDPSession(opened.page);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
});
beforeEach(async () => {
  await opened.page.locator('#stage').focus();
  for (let k = 0; k < 3; ++k) await opened.page.keyboard.press('Delete');
  await opened.page.keyboard.press('1');
  await opened.page.keyboard.press('Home');
  await countIs(opened.page, 1);
  await probeFeels(opened.page, 1, 0, 0);
});

/** Waits until the program reports this number of probes. */
const countIs = (page: Page, count: number) =>
  page.waitForFunction((wanted) => (document.getElementById('probe-rows') as HTMLTableSectionElement).rows.length === wanted, count);
/** Waits until the program has a probe there that presses. */
const probeFeels = (page: Page, number: number, x: number, y: number) =>
  page.waitForFunction(
    ([wanted, wantedX, wantedY]) => {
      const rows = [...(document.getElementById('probe-rows') as HTMLTableSectionElement).rows].map((row) => [...row.cells].map((cell) => cell.textContent ?? ''));
      const row = rows.find(([name]) => Number(name) === wanted);
      const [nowX, nowY] = (row?.[1] ?? '').split(',').map(Number.parseFloat);
      return Math.abs(nowX! - wantedX!) < 0.15 && Math.abs(nowY! - wantedY!) < 0.15 && Number(row?.[3]) > 0.05;
    },
    [number, x, y],
  );

it('each finger is a probe with its own force, until it is lifted', async () => {
  const { page } = opened;
  const box = (await page.locator('#stage').boundingBox())!;
  const at = (part: number, id: number) => ({ x: box.x + box.width * part, y: box.y + box.height * 0.5, id });
  const fingers = (type: 'touchStart' | 'touchMove' | 'touchEnd', touchPoints: { x: number; y: number; id: number }[]) =>
    session.send('Input.dispatchTouchEvent', { type, touchPoints });
  await fingers('touchStart', [at(0.4, 0)]);
  await fingers('touchStart', [at(0.4, 0), at(0.5, 1)]);
  await fingers('touchStart', [at(0.4, 0), at(0.5, 1), at(0.6, 2)]);
  await countIs(page, 3);
  const x = (row: number) =>
    page.evaluate((k) => Number.parseFloat((document.getElementById('probe-rows') as HTMLTableSectionElement).rows[k]?.cells[1]?.textContent ?? ''), row);
  await page.waitForFunction(() =>
    [...(document.getElementById('probe-rows') as HTMLTableSectionElement).rows].every((row) => Number(row.cells[3]?.textContent) > 0.05),
  );
  // The probes move to their fingers, which are symmetric about the middle.
  await page.waitForFunction(() => {
    const [first, second, third] = [...(document.getElementById('probe-rows') as HTMLTableSectionElement).rows].map((row) => Number.parseFloat(row.cells[1]?.textContent ?? ''));
    return first! < -5 && Math.abs(second!) < 0.3 && Math.abs(first! + third!) < 0.3;
  });
  await keepPicture(page, 'three-fingers');
  // Only the middle finger moves up the scene.
  const before = await x(0);
  await fingers('touchMove', [at(0.4, 0), { ...at(0.5, 1), y: box.y + box.height * 0.4 }, at(0.6, 2)]);
  await page.waitForFunction(() => {
    const rows = [...(document.getElementById('probe-rows') as HTMLTableSectionElement).rows];
    return Number.parseFloat((rows[1]?.cells[1]?.textContent ?? '').split(',')[1] ?? '') > 2;
  });
  expect(Math.abs((await x(0)) - before)).toBeLessThan(0.3);
  await fingers('touchEnd', []);
  await countIs(page, 1);
  expect(await page.locator('#probe-table').isVisible()).toBe(false);
});

it('by keys: added, moved alone, sonified, and removed', async () => {
  const { page } = opened;
  await page.keyboard.press('n');
  await says(page, 'One probe. Probe 1: centre, at the middle');
  await page.keyboard.press('2');
  await says(page, 'Probe 2 added');
  await countIs(page, 2);
  await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.press('Shift+ArrowRight');
  await probeFeels(page, 2, 10, 0);
  await probeFeels(page, 1, 0, 0);
  await page.keyboard.press('p');
  await says(page, 'Probe 2: ');
  await page.keyboard.press('n');
  await says(page, '2 probes, the keys move probe 2. Probe 1: centre, at the middle');
  await says(page, 'Probe 2: centre, 10 millimetres right from the middle, height');
  await keepPicture(page, 'two-probes', true);
  expect(await violations(page)).toEqual([]);
  await page.keyboard.press('Delete');
  await says(page, 'Probe 2 removed. The keys move probe 1.');
  await countIs(page, 1);
  await page.keyboard.press('Delete');
  await says(page, 'The first probe cannot be removed.');
});

it('by the panel: every control has a name, and the choice is heard', async () => {
  const { page } = opened;
  await openMore(page);
  await page.getByRole('button', { name: 'Add a probe' }).click();
  await countIs(page, 2);
  const choice = page.getByRole('combobox', { name: 'Keys move' });
  expect(await choice.inputValue()).toBe('1');
  await choice.selectOption({ label: '1, the first' });
  await says(page, 'Probe 1. ');
  expect(await page.getByRole('button', { name: 'Remove this probe' }).isDisabled()).toBe(true);
  await choice.selectOption({ label: '2' });
  await page.getByRole('button', { name: 'Remove this probe' }).click();
  await countIs(page, 1);
  expect(await page.getByRole('table', { name: 'What each probe feels' }).count()).toBe(0);
});

it('closing a page removes its probes, also from other pages', async () => {
  const { page, context } = opened;
  const other = await context.newPage();
  await other.goto(running.address.replace(/#.*/, ''));
  await other.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  await other.locator('#stage').focus();
  await other.keyboard.press('3');
  await countIs(page, 2);
  await probeFeels(page, 3, 0, 0);
  await other.close();
  await countIs(page, 1);
});
