// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Measures whether a page's memory stays flat: node scripts/page_memory.mjs PROGRAM [MINUTES]. A page of the sample, from above, whose
// probe goes round by keys, four steps per second, with a list of the names opened and left once a minute. Prints for each minute the
// page's heap after a collection (MB), its nodes and event listeners, and the program's resident memory (MB).
import { readFileSync } from 'node:fs';
import { startBrowser, touch } from './touched_page.mjs';

const [program, minutes = '60'] = process.argv.slice(2);
const { server, browser } = await startBrowser(['--disable-gpu', '--disable-3d-apis', '--mute-audio']);
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const child = await touch(program, page);
const session = await page.context().newCDPSession(page);
await session.send('Performance.enable');

const residentMb = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${child.pid}/status`, 'utf8'))?.[1] ?? NaN) / 1024;

async function report(minute) {
  await session.send('HeapProfiler.collectGarbage');
  const { metrics } = await session.send('Performance.getMetrics');
  const value = (name) => metrics.find((one) => one.name === name)?.value ?? NaN;
  const heap = (value('JSHeapUsedSize') / 1e6).toFixed(2);
  console.log(`${minute} min: heap ${heap} MB, ${value('Nodes')} nodes, ${value('JSEventListeners')} listeners, program ${residentMb().toFixed(1)} MB`);
}

await page.locator('#stage').focus();
const ways = ['ArrowRight', 'ArrowUp', 'ArrowLeft', 'ArrowDown'];
for (let minute = 0; ; ++minute) {
  await report(minute);
  if (minute >= Number(minutes)) break;
  const end = Date.now() + 60_000;
  for (let k = 0; Date.now() < end - 3000; ++k) {
    await page.keyboard.press(ways[Math.floor(k / 20) % 4]);
    await page.waitForTimeout(250);
  }
  await page.keyboard.press('l');
  await page.locator('#places-list').waitFor();
  await page.keyboard.press('Escape');
  await page.waitForTimeout(Math.max(0, end - Date.now()));
}
child.kill('SIGINT');
await browser.close();
await server.close();
