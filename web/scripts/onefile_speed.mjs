// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Measures a one-file page: node web/scripts/onefile_speed.mjs FILE.html [SLOWDOWN]
// The time from opening it to the first force; the processor time of the page's own thread for each frame of a pointer
// that moves; and its frames per second with a processor that is SLOWDOWN times slower (4).
import { statSync } from 'node:fs';
import { resolve } from 'node:path';
import { chromium } from 'playwright-core';

const [file, slowdown = '4'] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-3d-apis'],
});
const context = await browser.newContext({ offline: true, viewport: { width: 390, height: 844 } });
const page = await context.newPage();
// As the page's own clock counts, from the navigation on: the time of the first force that is not zero.
await page.addInitScript(() => {
  const watch = () => {
    const force = document.getElementById('read-force')?.textContent ?? '–';
    if (window.touchable === undefined && force !== '–') window.touchable = performance.now();
    if (Number(force) > 0) window.firstForce = performance.now();
    else requestAnimationFrame(watch);
  };
  requestAnimationFrame(watch);
});
await page.goto(`file://${resolve(file)}`);
await page.waitForFunction(() => window.touchable !== undefined);
await page.locator('#stage').focus();
for (let k = 0; k < 4; ++k) await page.keyboard.press('PageDown');
await page.waitForFunction(() => window.firstForce !== undefined);
const { touchable, firstForce } = await page.evaluate(() => ({ touchable: window.touchable, firstForce: window.firstForce }));

const session = await context.newCDPSession(page);
const box = await page.locator('#stage').boundingBox();
const moveTo = (k) => page.mouse.move(box.x + box.width * (0.5 + 0.4 * Math.sin(k / 9)), box.y + box.height * (0.5 + 0.4 * Math.sin(k / 13)));

/** Processor time, which other programs of the machine change little: a move of the pointer for each frame. */
async function mainThreadMs(frames) {
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  const busy = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
  const before = await busy();
  for (let k = 0; k < frames; ++k) {
    await moveTo(k);
    await page.evaluate(() => new Promise(requestAnimationFrame));
  }
  return (1000 * ((await busy()) - before)) / frames;
}
await mainThreadMs(60);
const mainMs = await mainThreadMs(240);

await session.send('Emulation.setCPUThrottlingRate', { rate: Number(slowdown) });
const counted = page.evaluate(
  () =>
    new Promise((done) => {
      const times = [];
      const count = (now) => (times.push(now) && now - times[0] < 3000 ? requestAnimationFrame(count) : done(times));
      requestAnimationFrame(count);
    }),
);
let moving = true;
const move = (async () => {
  for (let k = 0; moving; ++k) await moveTo(k);
})();
const times = await counted;
moving = false;
await move;
const gaps = times.slice(1).map((time, i) => time - times[i]).sort((a, b) => a - b);
console.log(
  JSON.stringify({
    megabytes: statSync(file).size / 1e6,
    ms_to_touchable: Math.round(touchable),
    ms_to_first_force: Math.round(firstForce),
    main_thread_ms_a_frame: Number(mainMs.toFixed(2)),
    slowdown: Number(slowdown),
    frames_per_s: Number(((1000 * gaps.length) / (times.at(-1) - times[0])).toFixed(1)),
    frame_ms: { p50: gaps[Math.floor(gaps.length / 2)], p99: gaps[Math.floor(0.99 * gaps.length)] },
  }),
);
await browser.close();
