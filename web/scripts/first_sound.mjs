// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Measures how soon the page can be touched and sounds: node scripts/first_sound.mjs PROGRAM. Prints one JSON object: seconds from
// the command to a running touch, clicks until sound runs (the page offers it until then), and seconds for that.
import { startBrowser, touch } from './touched_page.mjs';

const [program] = process.argv.slice(2);
const seconds = (since) => (performance.now() - since) / 1000;

const { server, browser } = await startBrowser(['--disable-gpu']);
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const started = performance.now();
const child = await touch(program, page);
const secondsToRunning = seconds(started);
const offer = page.getByRole('button', { name: 'Turn on sound' });
await offer.waitFor();
const asked = performance.now();
let clicks = 0;
while (await offer.isVisible()) {
  await offer.click();
  clicks += 1;
  await offer.waitFor({ state: 'hidden', timeout: 2000 }).catch(() => undefined);
}
console.log(JSON.stringify({ seconds_to_running: secondsToRunning, clicks, seconds_to_sound: seconds(asked) }));
child.kill('SIGINT');
await browser.close();
await server.close();
