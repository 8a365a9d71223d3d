// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A complete touch by keyboard and hearing alone, for each kind of scene: opening, sound, exploring, descriptions, another
// law, help, several probes, and the end.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { launch, openPage, startProgram, violations, type Opened, type Running } from './harness';
import { Listener } from './listener';

const folder = mkdtempSync(join(tmpdir(), 'palpable-journeys-'));
const disc = join(folder, 'disc.pgm');
const box = join(folder, 'box.obj');
let browser: Browser;

beforeAll(async () => {
  const side = 64;
  const rows = Array.from({ length: side }, (_, y) => Array.from({ length: side }, (_, x) => (Math.hypot(x - 32, y - 32) < 20 ? '200' : '30')).join(' '));
  writeFileSync(disc, `P2\n${side} ${side}\n255\n${rows.join('\n')}\n`);
  const corners = [0, 1].flatMap((z) => [0, 1].flatMap((y) => [0, 1].map((x) => `v ${x} ${y} ${z}`)));
  const faces = ['1 3 4 2', '5 6 8 7', '1 2 6 5', '3 7 8 4', '1 5 7 3', '2 4 8 6'].map((face) => `f ${face}`);
  writeFileSync(box, [...corners, ...faces, ''].join('\n'));
  browser = await launch({ webgl: false });
});
afterAll(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

interface Journey {
  kind: string;
  words: string[];
  label: RegExp;
  /** The sentence after each press of D; the last one reports that there is no more. */
  descriptions: RegExp[];
  step: RegExp;
  /** The law that cannot be chosen with the page's pointer, if the scene has one. */
  unavailable?: string;
}

const journeys: Journey[] = [
  {
    kind: 'a relief',
    words: ['touch', '--method', 'scanline'],
    label: /^Surface of Sculptures on a table to touch$/,
    descriptions: [/8 objects rise above the table.*D again says more\.$/, /A wooden table.*more\.$/, /From the probe to the highest point.*more\.$/, /third.*That is all\.$/, /^From the beginning: (?!.*says more)/],
    step: /(-?[\d.]+) millimetres?/,
  },
  {
    kind: 'contours',
    words: ['touch', disc],
    label: /^Lines of disc\.pgm to touch$/,
    descriptions: [/1 line, closed.*D again says more\.$/, /From the probe to the nearest line.*That is all\.$/, /^From the beginning: /],
    step: /line/i,
  },
  {
    kind: 'a solid',
    words: ['touch', box, '--resolution', '32', '--size', '100x100x50'],
    label: /^Surface of box\.obj to touch$/,
    descriptions: [/A solid, 50 millimetres wide, 50 millimetres .*D again says more\.$/, /third.*That is all\.$/, /^From the beginning: /],
    step: /(-?[\d.]+) millimetres?/,
    unavailable: 'tool',
  },
];

describe.each(journeys)('by keyboard and hearing, $kind', ({ words, label, descriptions, step, unavailable }) => {
  let running: Running;
  let opened: Opened;
  let page: Page;
  let listener: Listener;
  beforeAll(async () => {
    running = await startProgram({ instead: words });
    opened = await openPage(browser, running.address);
    ({ page } = opened);
    listener = await Listener.at(page);
  });
  afterAll(async () => {
    await opened?.context.close();
    await running?.stop();
  });

  it('opens with the focus on the scene and says what it is and which keys help', async () => {
    await listener.hears(/^Ready to touch: .*Press D to hear what is where, H for help\. I begins a guided start of two minutes\.$/);
    expect(await listener.focused()).toMatchObject({ role: 'application' });
    expect((await listener.focused()).name).toMatch(label);
  });

  it('has sound from the first key on, and then no longer offers it', async () => {
    await page.keyboard.press('ArrowRight');
    await page.getByRole('button', { name: 'Turn on sound' }).waitFor({ state: 'hidden' });
  });

  it('describes the scene part by part, and says when that is all', async () => {
    for (const description of descriptions) await listener.ask('d', description);
  });

  it('says each step, the rim, a press, the position and the way back', async () => {
    await listener.ask('ArrowRight', step);
    await listener.ask('PageDown', /pressed|press|deep/i);
    await listener.ask('p', /millimetres?/);
    // Each key replaces what the one before it would have said, so the last one waits for its answer.
    for (let k = 0; k < 30; ++k) await page.keyboard.press('Shift+ArrowRight');
    await listener.ask('Shift+ArrowRight', /^Rim of the scene\./);
    await listener.ask('Home', /In the middle\./);
  });

  it('says a pause and its end', async () => {
    await listener.ask('Space', /Paused: no force\./);
    await listener.ask('Space', /Resumed\./);
  });

  it('explains itself, and returns to the scene', async () => {
    await page.keyboard.press('h');
    expect(await listener.focused()).toMatchObject({ role: 'heading', name: 'Touching with Palpable' });
    await page.keyboard.press('Escape');
    expect(await listener.focused()).toMatchObject({ role: 'application' });
  });

  it('adds, distinguishes and removes a second probe', async () => {
    await listener.ask('2', /Probe 2 added/);
    await listener.ask('n', /2 probes, the keys move probe 2\. Probe 1: .* Probe 2: /);
    await listener.ask('Delete', /Probe 2 removed\. The keys move probe 1\./);
  });

  it('changes the law, says so, and undoes it', async () => {
    await listener.tabTo('DisclosureTriangle', /More settings/);
    await page.keyboard.press('Enter');
    const choice = await listener.tabTo('combobox', /^Force law$/);
    expect(choice.name).toBe('Force law');
    await page.keyboard.press('ArrowDown');
    const [, chosen] = await listener.hears(/^Force law: (.+)\.$/);
    expect(chosen).not.toBe('');
    const options = await page.locator('#law option:disabled').evaluateAll((all) => all.map((option) => [(option as HTMLOptionElement).value, option.textContent]));
    expect(options.map(([name]) => name)).toEqual(unavailable === undefined ? [] : [unavailable]);
    for (const [, words] of options) expect(words).toMatch(/: needs a device with torque$/);
    await page.waitForFunction(() => document.querySelectorAll('#parameters input').length > 0);
    expect(await violations(page)).toEqual([]);
    await listener.ask('Control+z', /Undone: force law/);
  });

  it('says when the program has ended', async () => {
    await running.stop();
    const alert = page.getByRole('alert');
    await alert.filter({ hasText: 'The session has ended. Start palpable again to go on.' }).waitFor();
    await listener.tabTo('application', /./, 'Shift+Tab');
    await listener.ask('ArrowRight', /Palpable is not connected: nothing can be felt\./);
  });
});
