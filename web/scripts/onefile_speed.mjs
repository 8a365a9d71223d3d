// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Measures a one-file page: node web/scripts/onefile_speed.mjs FILE.html [SLOWDOWN]
// The time from opening it to the first force, and the frames per second of a pointer that moves, with a processor
// that is SLOWDOWN times slower (4).
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
await session.send('Emulation.setCPUThrottlingRate', { rate: Number(slowdown) });
const box = await page.locator('#stage').boundingBox();
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
  for (let k = 0; moving; ++k)
    await page.mouse.move(box.x + box.width * (0.5 + 0.4 * Math.sin(k / 9)), box.y + box.height * (0.5 + 0.4 * Math.sin(k / 13)));
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
    slowdown: Number(slowdown),
    frames_per_s: Number(((1000 * gaps.length) / (times.at(-1) - times[0])).toFixed(1)),
    frame_ms: { p50: gaps[Math.floor(gaps.length / 2)], p99: gaps[Math.floor(0.99 * gaps.length)] },
  }),
);
await browser.close();
