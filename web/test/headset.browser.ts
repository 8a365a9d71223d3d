// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene in a headset, which is emulated (iwer): what both eyes see, the controllers, and how it begins and ends.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Quaternion, Vector3 } from 'three';
import { centre, marks, pixelsOf, scriptOf, stagePage } from './discs';
import { keepPicture, launch, openPage, startProgram, violations, type Running } from './harness';
import type { HeadsetShot } from './headset_scene';

let browser: Browser;
beforeAll(async () => (browser = await launch()));
afterAll(() => browser?.close());

/** On the ground, where no disc is before or behind it. */
const marble = { x: 0.002, y: 0.006 };
const marbleRadius = 0.0022;
const small = { width: 320, height: 240 };
const straight: HeadsetShot = { head: { place: [0, 0, 0], turn: 0, nod: -0.85 }, eyeDistance: 0.063 };
const shots: [string, HeadsetShot][] = [
  ['straight', straight],
  ['from the right, higher', { head: { place: [0.15, 0.05, -0.05], turn: 0.4, nod: -0.9 }, eyeDistance: 0.058 }],
  ['near, from the left', { head: { place: [-0.06, -0.05, -0.1], turn: -0.2, nod: -1 }, eyeDistance: 0.07 }],
];

describe('both eyes', () => {
  let page: Page;
  beforeAll(async () => {
    page = await (await browser.newContext({ viewport: { width: 1000, height: 600 } })).newPage();
    // WebXR is for secure pages.
    await page.route('**/*', (route) => route.fulfill({ body: stagePage, contentType: 'text/html' }));
    await page.goto('http://127.0.0.1/');
    await page.addScriptTag({ content: await scriptOf('headset_scene.ts') });
    await page.evaluate(([all, probe]) => window.depthScene.build([0.1, 0.08], all, probe), [marks, { ...marble, z: 0 }] as const);
    await page.evaluate(() => window.depthScene.take({ width: 640, height: 400, look: {}, head: { x: 0, y: 0, z: 0 } }));
    expect(await page.evaluate(() => window.headsetScene.show())).toBe(null);
  });
  afterAll(() => page?.context().close());

  it('see the scene in its true size where it stands, within half a pixel of theory', async () => {
    for (const [name, shot] of shots) {
      const { width, height, pixels, stands, verticalAngle } = await page.evaluate(([one, anew]) => window.headsetScene.take(one, anew), [shot, name === 'straight'] as const);
      const canvas = pixelsOf(pixels, width, height);
      // 40 cm below the eyes, the nearest side 30 cm before them.
      expect(stands.scale).toBe(1);
      stands.place.forEach((value, k) => expect(value).toBeCloseTo([0, -0.4, -0.34][k]!, 5));
      const turned = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), shot.head.turn).multiply(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), shot.head.nod));
      const pixelsPerUnit = height / 2 / Math.tan((verticalAngle * Math.PI) / 360);
      const ball = { ...marble, height: marbleRadius, green: false };
      for (const [k, mark] of [...marks.map((disc) => ({ ...disc, green: true })), ball].entries()) {
        const seen = [-1, 1].map((side, half) => {
          // On the table: the scene's y is away, its height up.
          const point = new Vector3(mark.x, mark.height - 0.4, -0.34 - mark.y).sub(new Vector3(...shot.head.place)).applyQuaternion(turned.clone().invert());
          point.x -= (side * shot.eyeDistance) / 2;
          const wanted = { right: (pixelsPerUnit * point.x) / -point.z, down: (pixelsPerUnit * point.y) / point.z };
          const middle = (width / 4) * (1 + 2 * half);
          const radius = (pixelsPerUnit * 0.002) / -point.z + 2;
          const found = centre(canvas, middle + wanted.right, height / 2 + wanted.down, radius, ([red, green]) => (mark.green ? green : red > 60 ? 1 : 0));
          return { wanted, right: found.left - middle, down: found.top - height / 2 };
        });
        const [left, right] = [seen[0]!, seen[1]!];
        const errors = [left.right - right.right - (left.wanted.right - right.wanted.right), left.right - left.wanted.right, left.down - left.wanted.down];
        errors.forEach((error) => expect(Math.abs(error), `${name}, point ${k}: ${errors.join(', ')}`).toBeLessThanOrEqual(0.5));
        // There is depth: with the eyes exchanged it would fail.
        expect(left.right - right.right).toBeGreaterThan(10);
      }
    }
  });

  it('see nothing more when it ends, and no frames go on', async () => {
    expect(await page.evaluate(() => window.headsetScene.leave())).toEqual(['drives', 'rests', '0 frames', 'none asked for']);
    expect(await page.evaluate(() => document.querySelector('#stage canvas') !== null)).toBe(true);
  });
});

interface Emulated {
  headset: {
    readonly controllers: { right: Hand; left: Hand };
    readonly activeSession: { end(): Promise<void>; dispatchEvent(event: Event): void } | undefined;
    quaternion: { set(x: number, y: number, z: number, w: number): void };
  };
  pulses: number[];
  heard: string;
}
interface Hand {
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
  updateButtonValue(id: string, value: number): void;
  inputSource: { gamepad: Gamepad };
}

describe('the page with a headset', () => {
  let running: Running;
  let page: Page;
  let complaints: string[];
  beforeAll(async () => {
    running = await startProgram();
    const context = await browser.newContext({ viewport: small });
    await context.addInitScript(readFileSync(createRequire(import.meta.url).resolve('iwer/build/iwer.min.js'), 'utf8'));
    await context.addInitScript(() => {
      const { XRDevice, metaQuest3 } = (window as unknown as { IWER: { XRDevice: new (config: unknown, options: unknown) => Emulated['headset'] & { installRuntime(o: object): void }; metaQuest3: unknown } }).IWER;
      const headset = new XRDevice(metaQuest3, { stereoEnabled: true });
      headset.installRuntime({ forceInstall: true });
      const pulses: number[] = [];
      Object.assign(window, { headset, pulses, heard: '' });
      // All that was said: a marble that the hand moves is said soon after.
      addEventListener('DOMContentLoaded', () => {
        const spoken = document.getElementById('spoken')!;
        new MutationObserver(() => ((window as unknown as Emulated).heard += spoken.textContent)).observe(spoken, { childList: true, characterData: true, subtree: true });
      });
      const [motor] = (headset.controllers.right.inputSource.gamepad as unknown as { hapticActuators: object[] }).hapticActuators;
      Object.getPrototypeOf(motor).pulse = (value: number) => Promise.resolve(pulses.push(value));
    });
    ({ page, complaints } = await openPage({ newContext: () => Promise.resolve(context) } as unknown as Browser, running.address));
    await page.locator('#depth').evaluate((depth) => ((depth as HTMLDetailsElement).open = true));
  });
  afterAll(async () => {
    await page?.context().close();
    await running?.stop();
  });

  const state = () => page.evaluate(() => document.documentElement.dataset.headset);
  const hears = async (words: string) => {
    const heard = () => page.evaluate(() => (window as unknown as Emulated).heard);
    await expect.poll(heard, { timeout: 60_000 }).toContain(words);
    await page.evaluate(() => ((window as unknown as Emulated).heard = ''));
  };
  const enter = async () => {
    // Where a first try of this test has left it in the headset.
    if ((await state()) === 'on') return;
    await page.getByRole('button', { name: 'Show it in the headset' }).click();
    await hears('stands before you in the headset');
  };
  const frames = () => page.evaluate(() => Number(document.documentElement.dataset.frames));
  const millimetres = async () => (await page.locator('#read-position').textContent())!.split(/[^-−.\d]+/).map((one) => Number(one.replace('−', '-')));
  /** Points the right hand, from the eyes, at a place of the scene as it stands: millimetres to the right and away. */
  const point = (right: number, away: number) =>
    page.evaluate(
      ([x, y]) => {
        const hand = (window as unknown as Emulated).headset.controllers.right;
        hand.position.set(0, 1.6, 0);
        // The middle is 40 cm below and 30 cm and half the scene's depth ahead; heights are small beside that.
        const [dx, dy, dz] = [x! / 1000, -0.4, -(0.3 + y! / 1000)];
        const [turn, nod] = [Math.atan2(-dx, -dz) / 2, Math.atan2(dy, Math.hypot(dx, dz)) / 2];
        hand.quaternion.set(Math.cos(turn) * Math.sin(nod), Math.sin(turn) * Math.cos(nod), -Math.sin(turn) * Math.sin(nod), Math.cos(turn) * Math.cos(nod));
      },
      [right, away],
    );
  const press = (id: string, value: number) => page.evaluate(([button, much]) => (window as unknown as Emulated).headset.controllers.right.updateButtonValue(button as string, much as number), [id, value]);

  it('offers it, shows its size, and has no problem for axe', async () => {
    await page.getByRole('button', { name: 'Show it in the headset' }).waitFor();
    expect(await page.locator('#headset-words').textContent()).toMatch(/In the headset its longer side is \d+ centimetres; its true size\./);
    expect(await violations(page)).toEqual([]);
    await page.locator('#show-headset').scrollIntoViewIfNeeded();
    await keepPicture(page, 'headset-offered');
  });

  it('moves the marble by the ray of a controller, which vibrates, and by keys', async () => {
    await enter();
    expect(await state()).toBe('on');
    await point(10, 60);
    await expect.poll(async () => Math.abs((await millimetres())[0]! - 10) < 2, { timeout: 60_000 }).toBe(true);
    // Looking down at it.
    await page.evaluate(() => (window as unknown as Emulated).headset.quaternion.set(Math.sin(-0.42), 0, 0, Math.cos(0.42)));
    await page.waitForTimeout(500);
    await keepPicture(page, 'headset-on');
    await press('trigger', 1);
    await point(-20, 40);
    await expect.poll(async () => Math.abs((await millimetres())[0]! + 20) < 2, { timeout: 60_000 }).toBe(true);
    await press('trigger', 0);
    await expect.poll(() => page.evaluate(() => (window as unknown as Emulated).pulses.length), { timeout: 60_000 }).toBeGreaterThan(0);
    // The hand rests now, and the keys move the marble.
    await page.waitForTimeout(600);
    const before = await millimetres();
    await page.keyboard.press('ArrowRight');
    await expect.poll(async () => ((await millimetres())[0]! - before[0]!).toFixed(1), { timeout: 60_000 }).toBe('1.0');
  });

  it('is left with Escape, and everything is as before', async () => {
    await page.keyboard.press('Escape');
    await hears('The scene is on the screen again.');
    expect(await state()).toBe('off');
    const stage = page.locator('#stage canvas');
    await stage.waitFor();
    expect(await stage.evaluate((canvas) => (canvas as HTMLCanvasElement).width)).toBeGreaterThan(0);
    await expect.poll(async () => { const before = await frames(); await page.waitForTimeout(400); return (await frames()) - before; }, { timeout: 60_000 }).toBe(0);
    const before = await millimetres();
    await page.keyboard.press('ArrowLeft');
    await expect.poll(async () => ((await millimetres())[0]! - before[0]!).toFixed(1), { timeout: 60_000 }).toBe('-1.0');
  });

  it('says that a session was lost, or refused', async () => {
    await enter();
    await page.evaluate(() => (window as unknown as Emulated).headset.activeSession!.end());
    await hears('The headset has ended');
    expect(await state()).toBe('off');
    await page.evaluate(() => (navigator.xr!.requestSession = () => Promise.reject(new DOMException('', 'SecurityError'))));
    await page.getByRole('button', { name: 'Show it in the headset' }).click();
    await hears('The headset was refused');
    expect(await state()).toBe('off');
    expect(complaints).toEqual([]);
  });
});
