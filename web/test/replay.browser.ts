// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A recording on the page: opened, played, gone through by keys, saved as a clip that the browser can play, and ended.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { keepPicture, launch, openPage, program, says, startProgram, violations, type Opened, type Running } from './harness';

const folder = mkdtempSync(join(tmpdir(), 'palpable-replay-'));
const [scene, other, recorded] = ['box.palp', 'flat.palp', 'touch.rec'].map((name) => join(folder, name)) as [string, string, string];
let browser: Browser;
let running: Running;
let opened: Opened;
let page: Page;

/** The ticks of the recording, by the program's own export. */
function ticks(): Record<string, number>[] {
  const [head = '', ...rows] = readFileSync(join(folder, 'touch.csv'), 'utf8').trim().split('\n');
  const names = head.split(',');
  return rows.map((row) => Object.fromEntries(row.split(',').map((cell, k) => [names[k], Number(cell)])) as Record<string, number>);
}
/** The tick at a time. */
function tickAt(seconds: number): Record<string, number> {
  const all = ticks();
  return all.filter(({ t_s }) => t_s! - all[0]!.t_s! <= seconds).pop()!;
}
/** "4 seconds", or more where a busy machine took longer. */
function length(): string {
  const all = ticks();
  return `${Number((all.at(-1)!.t_s! - all[0]!.t_s!).toFixed(1))} seconds`;
}

beforeAll(async () => {
  const palpable = (...words: string[]) => execFileSync(program, words, { cwd: folder, stdio: 'ignore' });
  const side = 64;
  const picture = (of: (x: number, y: number) => number) =>
    `P2\n${side} ${side}\n255\n${Array.from({ length: side }, (_, y) => Array.from({ length: side }, (_, x) => of(x, y)).join(' ')).join('\n')}\n`;
  writeFileSync(join(folder, 'box.pgm'), picture((x, y) => (Math.abs(x - 32) < 14 && Math.abs(y - 32) < 14 ? 220 : 60)));
  writeFileSync(join(folder, 'flat.pgm'), picture((x) => (x < 60 ? 250 : 10)));
  palpable('make', 'box.pgm', '--kind', 'depth', '-o', scene);
  palpable('make', 'flat.pgm', '--kind', 'depth', '-o', other);
  palpable('touch', scene, '--headless', '--seconds', '4', '--record', recorded);
  palpable('export', recorded, '-o', 'touch.csv');
  browser = await launch({ webgl: false });
  running = await startProgram({ instead: ['touch', scene, '--no-browser'] });
  opened = await openPage(browser, running.address);
  ({ page } = opened);
});
afterAll(async () => {
  await browser?.close();
  await running?.stop();
  rmSync(folder, { recursive: true, force: true });
});

it('is opened, and shows each of its moments with position and force', async () => {
  await page.locator('#replay-file').setInputFiles(recorded);
  await says(page, `Replay of touch.rec, ${length()}. Space plays, left and right go back and on by a second.`);
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('replay-play');
  await page.locator('#stage').focus();
  for (let k = 0; k < 2; ++k) await page.keyboard.press('ArrowRight');
  await says(page, `2 seconds of ${length()}, `);
  const tick = tickAt(2);
  const shown = (id: string) => page.locator(id).innerText();
  await page.waitForFunction((x) => Math.abs(Number.parseFloat(document.getElementById('read-position')?.textContent ?? '') - x) < 1.5, 1000 * tick.position_x_m!);
  const force = Math.hypot(tick.written_force_x_N!, tick.written_force_y_N!, tick.written_force_z_N!);
  expect(Math.abs(Number(await shown('#read-force')) - force)).toBeLessThan(0.1 + 0.1 * force);
  expect(await page.getByRole('slider', { name: 'Time' }).getAttribute('aria-valuetext')).toMatch(/^2 seconds of [\d.]+ seconds, (in contact|in free air), [\d.]+ newtons$/);
  expect(await violations(page)).toEqual([]);
  // The picture keeps its height, also in a low window.
  for (const height of [800, 600]) {
    await page.setViewportSize({ width: 1280, height });
    expect((await page.locator('#stage').boundingBox())!.height).toBeGreaterThan(height / 4);
    await keepPicture(page, `replay-${height}`);
  }
  await page.setViewportSize({ width: 320, height: 640 });
  expect(await violations(page)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)).toBeLessThanOrEqual(0);
  await keepPicture(page, 'replay-320', true);
  await page.setViewportSize({ width: 1280, height: 800 });
});

it('plays to its end, and stops where it is told', async () => {
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  // Slowly, so that it is stopped before its end also on a busy machine.
  await page.getByLabel('Speed').selectOption('0.25');
  await page.locator('#stage').focus();
  const before = await page.locator('#read-position').innerText();
  await page.keyboard.press('Space');
  await page.waitForFunction((was) => document.getElementById('read-position')?.textContent !== was, before);
  await page.keyboard.press('Space');
  await says(page, 'Stopped at ');
  await page.getByLabel('Speed').selectOption('2');
  await page.locator('#stage').focus();
  await page.keyboard.press('Space');
  await says(page, 'The end of the recording.');
  expect(await page.getByRole('button', { name: 'Play', exact: true }).isVisible()).toBe(true);
});

it('is saved as a clip of its length, or not at all', async () => {
  const clip = page.getByRole('button', { name: 'Save as a clip' });
  await page.getByLabel('Speed').selectOption('0.25');
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  await clip.click();
  await page.getByText(/^Recording the clip: \d+ %$/).waitFor();
  await page.getByRole('button', { name: 'Cancel the clip' }).click();
  await says(page, 'The clip was cancelled: nothing is saved.');
  await page.getByLabel('Speed').selectOption('2');
  await page.locator('#stage').focus();
  await page.keyboard.press('Home');
  const [saved] = await Promise.all([page.waitForEvent('download'), clip.click()]);
  expect(saved.suggestedFilename()).toBe('touch.webm');
  const bytes = readFileSync((await saved.path())!);
  // EBML, and a moving picture of the size of the stage.
  expect([...bytes.subarray(0, 4)]).toEqual([0x1a, 0x45, 0xdf, 0xa3]);
  const seen = await browser.newPage();
  await seen.setContent('<video muted></video>');
  const film = await seen.evaluate(async (base64) => {
    const video = document.querySelector('video')!;
    video.src = URL.createObjectURL(await (await fetch(`data:video/webm;base64,${base64}`)).blob());
    await new Promise((resolve) => video.addEventListener('loadedmetadata', resolve, { once: true }));
    // As its header says: without that it is infinite.
    const { duration } = video;
    await video.play();
    await new Promise((resolve) => video.addEventListener('ended', resolve, { once: true }));
    // Chromium's own count.
    const { webkitAudioDecodedByteCount: heard } = video as unknown as { webkitAudioDecodedByteCount: number };
    return { width: video.videoWidth, duration, seconds: video.currentTime, heard };
  }, bytes.toString('base64'));
  expect(film.width).toBe(await page.locator('#stage canvas').evaluate((canvas) => (canvas as HTMLCanvasElement).width));
  expect(film.seconds).toBeGreaterThan(1);
  expect(Math.abs(film.duration - film.seconds)).toBeLessThan(0.2);
  expect(film.heard).toBeGreaterThan(0);
  await seen.close();
});

it('ends with Escape, and the touch goes on', async () => {
  await page.locator('#stage').focus();
  await page.keyboard.press('Escape');
  await says(page, 'The replay has ended: the page shows the touch again.');
  expect(await page.locator('#replay').isVisible()).toBe(false);
  await page.keyboard.press('Home');
  await page.waitForFunction(() => document.getElementById('read-position')?.textContent === '0.0, 0.0');
});

it('says what is no recording', async () => {
  await page.locator('#replay-file').setInputFiles(scene);
  await says(page, 'box.palp is not a recording of this version of Palpable.');
  expect(opened.complaints.filter((one) => !one.includes('WebGL'))).toEqual([]);
});

it('says that it is of another scene, and ends the force of a device meanwhile', async () => {
  const elsewhere = await startProgram({ instead: ['touch', other, '--no-browser', '--device', 'sim:'] });
  const there = await openPage(browser, elsewhere.address);
  const pause = there.page.locator('#pause');
  expect(await pause.textContent()).toBe('Pause');
  await there.page.locator('#replay-file').setInputFiles(recorded);
  await there.page.locator('#replay-note', { hasText: 'It seems to be of another scene than this one. It was made on box.pgm.' }).waitFor();
  await there.page.waitForFunction(() => document.getElementById('pause')?.textContent === 'Resume');
  await there.page.getByRole('button', { name: 'End the replay' }).click();
  await says(there.page, 'It is paused: Space resumes it.');
  await there.page.keyboard.press('Space');
  await there.page.waitForFunction(() => document.getElementById('pause')?.textContent === 'Pause');
  await there.context.close();
  await elsewhere.stop();
});
