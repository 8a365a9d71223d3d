// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Measures the processor time of a page at rest: node scripts/rest_cost.mjs PROGRAM [SECONDS]. Prints the share of one core that
// the program and the browser use, for the view from above and for the 3D view, each without sound and 14 s after opening, and for
// an empty page. Run it on an idle machine.
import { readdirSync, readFileSync } from 'node:fs';
import { startBrowser, touch } from './touched_page.mjs';

const [program, seconds = '20'] = process.argv.slice(2);
const ticksPerSecond = 100;

/** Processor seconds of a process and its descendants. */
function used(root) {
  const parents = new Map();
  const times = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
      parents.set(pid, fields[1]);
      times.set(pid, (Number(fields[11]) + Number(fields[12])) / ticksPerSecond);
    } catch {
      // It has ended.
    }
  }
  const isBelow = (pid) => pid === String(root) || (parents.has(pid) && isBelow(parents.get(pid)));
  return [...times].filter(([pid]) => isBelow(pid)).reduce((sum, [, time]) => sum + time, 0);
}

const wait = (s) => new Promise((resolve) => setTimeout(resolve, 1000 * s));

async function measure(what, args, prepare) {
  const { server, browser } = await startBrowser(args);
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const child = await prepare(page);
  await wait(14);
  const pids = [server.process().pid, child?.pid];
  const before = pids.map((pid) => (pid === undefined ? 0 : used(pid)));
  await wait(Number(seconds));
  const [browserShare, programShare] = pids.map((pid, k) => (pid === undefined ? 0 : (100 * (used(pid) - before[k])) / Number(seconds)));
  console.log(`${what}: browser ${browserShare.toFixed(1)} %, program ${programShare.toFixed(1)} %, together ${(browserShare + programShare).toFixed(1)} % of a core`);
  child?.kill('SIGINT');
  await browser.close();
  await server.close();
}

await measure('an empty page', ['--disable-gpu'], () => undefined);
await measure('from above', ['--disable-gpu', '--disable-3d-apis'], (page) => touch(program, page));
await measure('in 3D, software WebGL', ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'], (page) => touch(program, page));
