// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// True depth on the screen: known points are measured in the drawn pixels, and the settings are used by keys.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { anaglyph, glasses, type Colour } from '../src/view/depth/anaglyph';
import type { Fit } from '../src/view/depth/fit';
import { straightPitch } from '../src/view/depth/layout';
import type { Mark, Second, Shot } from './depth_scene';
import { registrationOf, type Triple } from '../src/view/depth/registration';
import { centre, marks, pixelsOf, scriptOf, stagePage, top, type Pixels } from './discs';
import { launch } from './harness';

let browser: Browser;
beforeAll(async () => (browser = await launch()));
afterAll(() => browser?.close());

const eyeDistance = 0.063;
/** With the default settings, the plane of the scene that lies in the screen. */
const screenPlane = 0.01384;
const flatEdge: Mark = { x: -0.02, y: 0, height: screenPlane, kind: 'edge', colour: [255, 255, 255] };
const lowEdge: Mark = { x: 0.02, y: 0, height: 0, kind: 'edge', colour: [40, 120, 200] };
const marble = { x: 0, y: -0.0145, z: 0.015 };
const marbleRadius = 0.0022;

const screens = [
  { name: 'a phone', width: 640, height: 360, pixel: 0.16, distance: 300 },
  { name: 'a laptop', width: 800, height: 500, pixel: 0.265, distance: 600 },
  { name: 'a television', width: 960, height: 540, pixel: 1.25, distance: 1500 },
];
/** Shares of the distance from the screen. */
const heads = [{ x: 0, y: 0, z: 0 }, { x: 0.25, y: -0.1, z: -0.2 }, { x: -0.15, y: 0.15, z: 0.4 }];

interface Picture extends Pixels {
  fit: Fit;
  corner: { left: number; top: number };
}

/** Where an eye sees a point of the scene, in pixels from the middle of its window: where the line from the eye meets the screen. */
function expected(mark: { x: number; y: number; height: number }, { fit }: Picture, eye: { x: number; y: number; z: number }, pixel: number) {
  const [x, y, z] = [mark.x * fit.scale, mark.y * fit.scale, (mark.height - top / 2 - fit.plane) * fit.scale * fit.depth];
  const along = eye.z / (eye.z - z);
  return { right: (eye.x + (x - eye.x) * along) / pixel, down: -(eye.y + (y - eye.y) * along) / pixel };
}

describe('the drawn depth', () => {
  let page: Page;
  beforeAll(async () => {
    page = await (await browser.newContext({ viewport: { width: 1000, height: 600 } })).newPage();
    await page.setContent(stagePage);
    await page.addScriptTag({ content: await scriptOf('depth_scene.ts') });
    await page.evaluate(([all, probe]) => window.depthScene.build([0.1, 0.08], all, probe), [[...marks, flatEdge, lowEdge], marble] as [Mark[], typeof marble]);
  });
  afterAll(() => page?.context().close());

  async function take(shot: Shot): Promise<Picture> {
    const { fit, pixels, corner } = await page.evaluate((wanted) => window.depthScene.take(wanted), shot);
    return { fit: fit!, corner, ...pixelsOf(pixels, shot.width, shot.height) };
  }
  const near = (of: string, measured: number, wanted: number) => expect(Math.abs(measured - wanted), `${of}: ${measured}, in theory ${wanted}`).toBeLessThanOrEqual(0.5);

  it.each(screens)('of ten points and a marble is within half a pixel of theory on $name, from three places', async ({ width, height, pixel, distance }) => {
    const metres = pixel / 1000;
    let least = Infinity;
    let most = -Infinity;
    for (const share of heads) {
      const head = { x: (share.x * distance) / 1000, y: (share.y * distance) / 1000, z: (share.z * distance) / 1000 };
      const picture = await take({ width, height, look: { depthMode: 'crossed', pixelSize: pixel, screenDistance: distance }, head });
      const eyes = [-1, 1].map((side) => ({ ...head, x: head.x + (side * eyeDistance) / 2, z: head.z + distance / 1000 }));
      const measure = (mark: { x: number; y: number; height: number }, radius: number, of: (colour: Colour) => number) =>
        eyes.map((eye, half) => {
          // With crossed gaze the left eye's picture is the right one.
          const middle = (width / 4) * (3 - 2 * half);
          const { right, down } = expected(mark, picture, eye, metres);
          const found = centre(picture, middle + right, height / 2 + down, (radius * picture.fit.scale) / metres + 2, of);
          return { wanted: right, found: found.left - middle, down: found.top - height / 2, wantedDown: down };
        });
      for (const [k, mark] of marks.entries()) {
        const [left, right] = measure(mark, 0.002, ([, green]) => green);
        near(`point ${k}`, left!.found - right!.found, left!.wanted - right!.wanted);
        near(`point ${k}, left eye`, left!.found, left!.wanted);
        near(`point ${k}, down`, left!.down, left!.wantedDown);
        [least, most] = [Math.min(least, left!.found - right!.found), Math.max(most, left!.found - right!.found)];
      }
      const [left, right] = measure({ x: marble.x, y: marble.y, height: marble.z + marbleRadius }, marbleRadius, ([red]) => (red > 60 ? 1 : 0));
      near('the marble', left!.found - right!.found, left!.wanted - right!.wanted);
    }
    // There is depth, before the screen and behind it.
    expect(most).toBeGreaterThan(1);
    expect(least).toBeLessThan(-1);
  });

  it.each(screens)('asks no eyes that look straight ahead to turn outwards on $name', async ({ width, height, pixel, distance }) => {
    const picture = await take({ width, height, look: { depthMode: 'parallel', pixelSize: pixel, screenDistance: distance }, head: { x: 0, y: 0, z: 0 } });
    const pitch = Math.min(width / 2, (1000 * straightPitch({ distance: distance / 1000, eyeDistance })) / pixel);
    for (const [k, mark] of marks.entries()) {
      const [left, right] = [-1, 1].map((side) => {
        const eye = { x: (side * eyeDistance) / 2, y: 0, z: distance / 1000 };
        const { right: x, down } = expected(mark, picture, eye, pixel / 1000);
        const middle = width / 2 + (side * pitch) / 2;
        const found = centre(picture, middle + x, height / 2 + down, (0.002 * picture.fit.scale) / (pixel / 1000) + 1, ([, green]) => green).left;
        // The pictures begin at whole pixels.
        expect(Math.abs(found - middle - x), `point ${k}`).toBeLessThanOrEqual(1);
        return found;
      });
      expect((right! - left!) * pixel, `point ${k}`).toBeLessThanOrEqual(1000 * eyeDistance);
    }
  });

  it('leaves an edge in the plane of the screen where it is when the head moves, and no other one', async () => {
    const { width, height, pixel, distance } = screens[1]!;
    const shots: { flat: number; low: number }[] = [];
    for (const share of [...heads, { x: 0.5, y: 0.1, z: -0.4 }]) {
      const head = { x: share.x * 0.6, y: share.y * 0.6, z: share.z * 0.6 };
      const picture = await take({ width, height, look: { depthMode: 'head', pixelSize: pixel, screenDistance: distance }, head });
      // Its left border is the edge: the first column, with its part, that is brighter than half.
      const border = (x: number, full: number, of: (colour: Colour) => number) => {
        const expectedLeft = width / 2 + (x * picture.fit.scale) / (pixel / 1000);
        const from = Math.round(expectedLeft - 120);
        for (let i = from; i < from + 240; ++i) {
          const [before, here] = [of(picture.at(i - 1, height / 2)), of(picture.at(i, height / 2))];
          if (before < full / 2 && here >= full / 2) return i - 0.5 + (full / 2 - before) / (here - before);
        }
        return NaN;
      };
      shots.push({ flat: border(flatEdge.x, 255, ([red]) => red), low: border(lowEdge.x, 200, ([, , blue]) => blue) });
    }
    const spread = (values: number[]) => Math.max(...values) - Math.min(...values);
    expect(spread(shots.map(({ flat }) => flat))).toBeLessThan(1);
    expect(spread(shots.map(({ low }) => low))).toBeGreaterThan(5);
  });

  it.each(screens)('of ten points is where a registered hand feels them on $name, from three places', async ({ width, height, pixel, distance }) => {
    const metres = pixel / 1000;
    // The scene as a hand feels it: leaning back by 30 degrees, turned by 10, two fifths as wide as the picture, a tenth of that before the screen.
    const { corner } = await take({ width, height, look: { depthMode: 'head', pixelSize: pixel }, head: { x: 0, y: 0, z: 0 } });
    const [lean, turn] = [Math.PI / 6, Math.PI / 18];
    const scale = 4 * width * metres;
    const middle = { x: (corner.left + 0.55 * width) * metres, y: -(corner.top + 0.5 * height) * metres, z: 0.04 * width * metres };
    const felt = ({ x, y, z }: { x: number; y: number; z: number }) => {
      const [u, v] = [Math.cos(turn) * x - Math.sin(turn) * y, Math.sin(turn) * x + Math.cos(turn) * y];
      return { x: middle.x + scale * u, y: middle.y + scale * (Math.cos(lean) * v - Math.sin(lean) * z), z: middle.z + scale * (Math.sin(lean) * v + Math.cos(lean) * z) };
    };
    const touched: Triple<{ x: number; y: number; z: number }> = [{ x: -0.04, y: -0.03, z: 0.01 }, { x: 0.04, y: -0.03, z: 0 }, { x: -0.01, y: 0.035, z: 0.02 }];
    const found = registrationOf(touched, [felt(touched[0]), felt(touched[1]), felt(touched[2])]);
    if (typeof found === 'string') throw new Error(found);
    for (const share of heads) {
      const head = { x: (share.x * distance) / 1000, y: (share.y * distance) / 1000, z: (share.z * distance) / 1000 };
      const eye = { x: (corner.left + width / 2) * metres + head.x, y: -(corner.top + height / 2) * metres + head.y, z: distance / 1000 + head.z };
      const picture = await take({ width, height, look: { depthMode: 'head', pixelSize: pixel, screenDistance: distance }, head, registration: found.registration });
      expect(picture.fit.isByHand).toBe(true);
      for (const [k, { x, y, height: z }] of marks.entries()) {
        const point = felt({ x, y, z });
        const along = eye.z / (eye.z - point.z);
        const wanted = { left: (eye.x + (point.x - eye.x) * along) / metres - corner.left, top: -(eye.y + (point.y - eye.y) * along) / metres - corner.top };
        const at = centre(picture, wanted.left, wanted.top, (0.002 * scale * along) / metres + 2, ([, green]) => green);
        near(`point ${k}, right`, at.left, wanted.left);
        near(`point ${k}, down`, at.top, wanted.top);
      }
    }
  });

  it('of a pair shows the right eye the second picture, and the left one the first', async () => {
    const { width, height, pixel, distance } = screens[0]!;
    // The first picture's discs are white, the second one's green, and lie elsewhere in it.
    const build = (second?: Second) =>
      page.evaluate(([all, probe, other]) => window.depthScene.build([0.1, 0.08], all, probe, other), [marks, marble, second] as [Mark[], typeof marble, Second?]);
    await build({ colour: [0, 255, 0], shiftPerMetre: 2 });
    for (const share of heads) {
      const head = { x: (share.x * distance) / 1000, y: (share.y * distance) / 1000, z: (share.z * distance) / 1000 };
      const look = { depthMode: 'crossed', pixelSize: pixel, screenDistance: distance } as const;
      const picture = await take({ width, height, look, head });
      const without = await take({ width, height, look: { ...look, secondView: false }, head });
      for (const [k, mark] of marks.entries())
        for (const [half, side] of [-1, 1].entries()) {
          const eye = { x: head.x + (side * eyeDistance) / 2, y: head.y, z: head.z + distance / 1000 };
          const middle = (width / 4) * (3 - 2 * half);
          const { right, down } = expected(mark, picture, eye, pixel / 1000);
          const radius = (0.002 * picture.fit.scale) / (pixel / 1000) + 2;
          const found = centre(picture, middle + right, height / 2 + down, radius, ([, green]) => green);
          near(`point ${k}, ${side < 0 ? 'left' : 'right'} eye`, found.left - middle, right);
          near(`point ${k}, down`, found.top - height / 2, down);
          const red = (of: Picture) => of.at(Math.round(middle + right), Math.round(height / 2 + down))[0];
          expect(red(picture) > 128, `point ${k}, ${side < 0 ? 'left' : 'right'} eye`).toBe(side < 0);
          expect(red(without)).toBeGreaterThan(128);
        }
    }
    await page.evaluate(([all, probe]) => window.depthScene.build([0.1, 0.08], all, probe), [[...marks, flatEdge, lowEdge], marble] as [Mark[], typeof marble]);
  });

  it('has in every mode the pictures of both eyes where they belong', async () => {
    const [width, height, pixel, distance] = [400, 240, 0.24, 300];
    const rest = { x: 0, y: 0, z: 0 };
    const shot = (depthMode: NonNullable<Shot['look']['depthMode']>, more: Partial<Shot['look']> = {}, head = rest) =>
      take({ width, height, look: { depthMode, pixelSize: pixel, screenDistance: distance, ...more }, head });
    const [left, right] = [await shot('head', {}, { ...rest, x: -eyeDistance / 2 }), await shot('head', {}, { ...rest, x: eyeDistance / 2 })];
    const linear = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
    const encoded = (value: number) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
    const mapped = (colour: Colour, by: (value: number) => number): Colour => [by(colour[0]), by(colour[1]), by(colour[2])];
    /** The share of pixels that differ from what is wanted by more than rounding. */
    const wrong = (picture: Picture, wanted: (left: number, top: number) => Colour, pixels = width * height) => {
      let count = 0;
      for (let j = 0; j < height; ++j)
        for (let i = 0; i < width; ++i) {
          const [a, b] = [picture.at(i, j), wanted(i, j)];
          if (Math.max(...a.map((value, c) => Math.abs(value - b[c]!))) > 4) ++count;
        }
      return count / pixels;
    };
    // The eyes see different pictures: what follows can fail.
    expect(wrong(left, right.at)).toBeGreaterThan(0.005);

    const of = (a: Picture, b: Picture, through: keyof typeof glasses) => (i: number, j: number) => {
      const [one, other] = [a, b].map((picture) => mapped(picture.at(i, j), (value) => linear(value / 255)));
      return mapped(anaglyph(one!, other!, glasses[through]), (value) => 255 * encoded(value));
    };
    for (const through of ['red-cyan', 'amber-blue', 'green-magenta'] as const) expect(wrong(await shot(through), of(left, right, through)), through).toBeLessThan(0.001);
    expect(wrong(await shot('red-cyan', { swapEyes: true }), of(right, left, 'red-cyan'))).toBeLessThan(0.001);

    // Which line is the first one depends on where the window is on the screen: one of both ways is right, the other one wrong.
    for (const mode of ['rows', 'columns'] as const) {
      const [usual, swapped] = [await shot(mode), await shot(mode, { swapEyes: true })];
      const turns = [0, 1].map((odd) => (i: number, j: number) => ((mode === 'rows' ? j : i) % 2 === odd ? left : right).at(i, j));
      const [even, odd] = turns.map((turn) => wrong(usual, turn));
      expect(Math.min(even!, odd!), mode).toBeLessThan(0.001);
      expect(Math.max(even!, odd!), mode).toBeGreaterThan(0.005);
      expect(wrong(swapped, turns[even! < odd! ? 1 : 0]!), mode).toBeLessThan(0.001);
    }

    const parallel = await shot('parallel');
    const crossed = await shot('crossed');
    expect(wrong(crossed, (i, j) => parallel.at((i + width / 2) % width, j))).toBeLessThan(0.001);
    expect(wrong(crossed, parallel.at)).toBeGreaterThan(0.005);

    // Stretched to the whole screen, each half is an eye's picture.
    const eyes = [-1, 1].map((side) => ({ x: (side * eyeDistance) / 2, y: 0, z: distance / 1000 }));
    for (const [mode, columns, rows] of [['side-by-side', 2, 1], ['over-under', 1, 2]] as const) {
      const picture = await shot(mode);
      eyes.forEach((eye, k) => {
        for (const mark of marks) {
          const { right: x, down: y } = expected(mark, picture, eye, pixel / 1000);
          const [middleX, middleY] = [((columns === 2 ? 1 + 2 * k : 2) * width) / 4, ((rows === 2 ? 1 + 2 * k : 2) * height) / 4];
          const found = centre(picture, middleX + x / columns, middleY + y / rows, 10, ([, green]) => green);
          near(`${mode}, right`, found.left - middleX, x / columns);
          near(`${mode}, down`, found.top - middleY, y / rows);
        }
      });
    }
  });
});
