// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The basis of the browser tests: the real program and Debian's Chromium.
import { spawn, type ChildProcess } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium, errors, type Browser, type BrowserContext, type BrowserContextOptions, type Page } from 'playwright-core';

const results = join(dirname(fileURLToPath(import.meta.url)), '..', 'test-results');
const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const quiet = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const softwareGl = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const noGl = ['--disable-gpu', '--disable-3d-apis'];

// Chromium without its windows, which takes half of the processor time of the whole browser.
const chromiumProgram = process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell';

/** The tested program: the one named by PALPABLE, else that of the development build. */
export const program = resolve(process.env.PALPABLE ?? join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'build', 'dev', 'bin', 'palpable'));
// One method only, so that the scene is not replaced by a better one during a test.
const programArguments = (process.env.PALPABLE_ARGUMENTS ?? 'touch --method scanline').split(' ').filter((word) => word !== '');

export interface Running {
  /** As printed, token included. */
  address: string;
  child: ChildProcess;
  stop(): Promise<void>;
}

/** Starts a session without a window and waits for its address; with further arguments, or with others instead of the usual ones. */
export async function startProgram(...more: (string | { instead: string[] })[]): Promise<Running> {
  const instead = more.flatMap((one) => (typeof one === 'string' ? [] : [one.instead]))[0];
  const words = instead ?? [...programArguments, ...more.filter((one) => typeof one === 'string')];
  // It saves files in its working directory.
  const folder = mkdtempSync(join(tmpdir(), 'palpable-page-'));
  const child = spawn(program, words, { stdio: ['ignore', 'pipe', 'pipe'], env: { ...process.env, BROWSER: 'true' }, cwd: folder });
  let said = '';
  const ended = new Promise<void>((resolve) => child.once('close', () => resolve()));
  const address = await new Promise<string>((resolve, reject) => {
    const read = (text: Buffer) => {
      said += text.toString();
      const found = /http:\/\/127\.0\.0\.1:\d+\/#[0-9a-f]+/.exec(said);
      if (found) resolve(found[0]);
    };
    child.stdout?.on('data', read);
    child.stderr?.on('data', read);
    child.once('error', reject);
    child.once('close', (code) => reject(new Error(`${program} ended with ${code} before it gave an address:\n${said}`)));
  });
  return {
    address,
    child,
    stop: async () => {
      child.kill('SIGINT');
      await ended;
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

export function launch(options: { webgl?: boolean; more?: string[] } = {}): Promise<Browser> {
  const { webgl = true, more = [] } = options;
  return chromium.launch({
    executablePath: chromiumProgram,
    args: [...quiet, ...(webgl ? softwareGl : noGl), ...more],
  });
}

export interface Opened {
  page: Page;
  context: BrowserContext;
  /** Errors and warnings on the page's console. */
  complaints: string[];
}

/** Opens the page and waits for the scene. With `cookies` of an earlier context, a further context is admitted. */
export async function openPage(
  browser: Browser,
  address: string,
  options: BrowserContextOptions = {},
  onBinaryFrame: (payload: ArrayBuffer) => void = () => undefined,
): Promise<Opened> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  await context.addInitScript(keepWhatIsSaid);
  const page = await context.newPage();
  // A busy machine may draw only one frame per second; that is not an error.
  page.setDefaultTimeout(60_000);
  const complaints: string[] = [];
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('websocket', (socket) =>
    socket.on('framereceived', ({ payload }) => {
      if (typeof payload !== 'string') onBinaryFrame(new Uint8Array(payload).buffer);
    }),
  );
  await page.goto(address);
  await page.waitForFunction(() => document.getElementById('status')?.dataset.state === 'running');
  await page.waitForFunction(() => document.getElementById('read-height')?.textContent !== '–');
  return { page, context, complaints };
}

/** Opens the part of the settings that is closed initially. */
export const openMore = (page: Page) => page.locator('#more').evaluate((more) => ((more as HTMLDetailsElement).open = true));

/** Waits until the page has said these words. */
export async function says(page: Page, words: string): Promise<void> {
  try {
    await page.waitForFunction((wanted) => (document.getElementById('spoken')?.textContent ?? '').includes(wanted), words);
  } catch (cause) {
    throw new Error(`the page did not say “${words}”; last: “${await page.locator('#spoken').textContent()}”`, { cause });
  }
}

/** Collects what a page says from its load on. Runs in the page. */
function keepWhatIsSaid(): void {
  const said: string[] = [];
  (window as unknown as { said: string[] }).said = said;
  new MutationObserver(() => {
    const words = document.getElementById('spoken')?.textContent ?? '';
    if (words !== said.at(-1)) said.push(words);
  }).observe(document, { subtree: true, childList: true, characterData: true });
}

/** Waits until the page has said these words since it was loaded, whatever it says after them. */
export const hasSaid = (page: Page, words: string) =>
  page.waitForFunction((wanted) => (window as unknown as { said: string[] }).said.some((one) => one.includes(wanted)), words);

/** Waits until the browser has drawn so many frames. */
export const framesDrawn = (page: Page, count: number) =>
  page.evaluate(async (frames) => {
    for (let k = 0; k < frames; ++k) await new Promise(requestAnimationFrame);
  }, count);

/**
 * Saves a picture of the whole page in web/test-results, for inspection by eye. No test fails for want of it: on a busy machine
 * without a GPU it may take more than a minute.
 */
export async function keepPicture(page: Page, name: string, fullPage = false): Promise<void> {
  mkdirSync(results, { recursive: true });
  try {
    await page.screenshot({ path: join(results, `${name}.png`), fullPage });
  } catch (error) {
    if (!(error instanceof errors.TimeoutError)) throw error;
    console.warn(`There is no picture ${name}: it took too long.`);
  }
}

export interface Violation {
  id: string;
  help: string;
  nodes: string[];
}

/** The problems that axe-core finds in the current page. */
export async function violations(page: Page): Promise<Violation[]> {
  await page.evaluate(axeSource);
  return page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run(options: object): Promise<{ violations: { id: string; help: string; nodes: { html: string; failureSummary: string }[] }[] }> } };
    const { violations: found } = await axe.run({ resultTypes: ['violations'] });
    return found.map(({ id, help, nodes }) => ({ id, help, nodes: nodes.map(({ html, failureSummary }) => `${html}: ${failureSummary}`) }));
  });
}
