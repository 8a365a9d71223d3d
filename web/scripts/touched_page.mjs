// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A browser, and the page of a touch of the sample in it, for the scripts that measure the page.
import { spawn } from 'node:child_process';
import { chromium } from 'playwright-core';

export async function startBrowser(args) {
  const server = await chromium.launchServer({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-component-update', ...args] });
  return { server, browser: await chromium.connect(server.wsEndpoint()) };
}

/** Starts a touch of the sample and opens its page. Returns the program's process. */
export async function touch(program, page) {
  const child = spawn(program, ['touch', '--method', 'scanline', '--no-browser'], { stdio: ['ignore', 'pipe', 'pipe'] });
  const address = await new Promise((resolve) => {
    let said = '';
    child.stdout.on('data', (text) => {
      said += text;
      const found = /http:\/\/127\.0\.0\.1:\d+\/#[0-9a-f]+/.exec(said);
      if (found) resolve(found[0]);
    });
  });
  await page.goto(address);
  await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  return child;
}
