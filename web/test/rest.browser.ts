// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A page without input is at rest: no animation frames, no layouts, one state message per second, no running audio.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { launch, openPage, startProgram, type Opened, type Running } from './harness';

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

interface Watched {
  framesAsked: number;
  contexts: AudioContext[];
}

/** Counts animation frames and keeps the audio contexts of the page from now on. */
const watch = (page: Page) =>
  page.evaluate(() => {
    const watched = window as unknown as Watched;
    watched.framesAsked = 0;
    watched.contexts = [];
    const ask = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => {
      watched.framesAsked += 1;
      return ask(callback);
    };
    const Context = window.AudioContext;
    window.AudioContext = class extends Context {
      constructor() {
        super();
        watched.contexts.push(this);
      }
    };
  });
const audioIs = (page: Page, wanted: AudioContextState) =>
  page.waitForFunction((state) => {
    const { contexts } = window as unknown as Watched;
    return contexts.length > 0 && contexts.every((context) => context.state === state);
  }, wanted);

it('suspends audio at rest, and resumes it for the next step', async () => {
  const { page } = opened;
  await watch(page);
  await page.getByRole('button', { name: 'Turn on sound' }).click();
  await audioIs(page, 'running');
  await audioIs(page, 'suspended');
  expect(await page.getByRole('button', { name: 'Turn on sound' }).isVisible()).toBe(false);
  await page.locator('#stage').focus();
  await page.keyboard.press('ArrowRight');
  await audioIs(page, 'running');
  await audioIs(page, 'suspended');
});

it('at rest receives one state per second, without drawing or layout', async () => {
  const { page, context } = opened;
  const session = await context.newCDPSession(page);
  await session.send('Performance.enable');
  const metric = async (name: string) => (await session.send('Performance.getMetrics')).metrics.find((one) => one.name === name)?.value ?? 0;
  const work = async () => ({
    frames: await page.evaluate(() => (window as unknown as Watched).framesAsked),
    layouts: await metric('LayoutCount'),
    styles: await metric('RecalcStyleCount'),
  });
  const received: string[] = [];
  const sent: string[] = [];
  await session.send('Network.enable');
  session.on('Network.webSocketFrameReceived', ({ response }) => received.push(response.payloadData));
  session.on('Network.webSocketFrameSent', ({ response }) => sent.push(response.payloadData));
  const next = async (count: number) => {
    const wanted = received.length + count;
    while (received.length < wanted) await page.waitForTimeout(50);
  };
  // The plot is level after at most the ten seconds that it shows.
  let before = await work();
  for (let k = 0; k < 30; ++k) {
    await next(1);
    const now = await work();
    if (now.frames === before.frames && now.layouts === before.layouts && k > 12) break;
    before = now;
  }
  received.length = sent.length = 0;
  before = await work();
  await next(4);
  const states = received.map((text) => JSON.parse(text) as { type: string; t_s: number });
  expect(states.map(({ type }) => type)).toEqual(['state', 'state', 'state', 'state']);
  // Measured with the program's clock.
  for (let k = 1; k < states.length; ++k) expect(states[k]!.t_s - states[k - 1]!.t_s).toBeGreaterThan(0.9);
  expect(sent).toEqual([]);
  expect(await work()).toEqual(before);
});
