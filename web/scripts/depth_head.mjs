// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How well a depth camera's head is found, how much a still one trembles, and where the view is when it moves:
//   palpable_head_set 201 220 0 640 places | node scripts/depth_head.mjs
// The places that the program would tell go through the smoother of the page, as they come. The first seconds of each viewer
// are still; a moving head is judged 80 ms after each picture.
import { createInterface } from 'node:readline';
import { createServer } from 'vite';

const still = 4;
const hidden = 14;
const late = 80;
const axes = ['x', 'y', 'z'];
const millimetres = (metres) => (1000 * metres).toFixed(2);
const rms = (values) => Math.sqrt(values.reduce((sum, value) => sum + value ** 2, 0) / values.length);

const viewers = new Map();
for await (const line of createInterface({ input: process.stdin })) {
  const numbers = line.trim().split(/\s+/).map(Number);
  const point = (from) => (numbers.length > from ? { x: numbers[from], y: numbers[from + 1], z: numbers[from + 2] } : null);
  const pictures = viewers.get(numbers[0]) ?? [];
  viewers.set(numbers[0], pictures);
  pictures.push({ time: 1000 * numbers[1], truth: point(2), place: point(5) });
}

const server = await createServer({ logLevel: 'error', server: { middlewareMode: true }, optimizeDeps: { noDiscovery: true } });
const { HeadSmoother } = await server.ssrLoadModule('/src/view/head/smooth.ts');
const all = { found: 0, pictures: 0, measured: [], smoothed: [], predicted: [], bias: [], moving: [], lag: 0 };
for (const pictures of viewers.values()) judge(pictures);
await server.close();
report();

function judge(pictures) {
  const smoother = new HeadSmoother();
  const paths = { measured: [], smoothed: [], predicted: [] };
  let offset = null;
  for (const { time, truth, place } of pictures) {
    const shown = time < 1000 * hidden;
    if (shown) all.pictures += 1;
    if (place === null) continue;
    if (shown) {
      all.found += 1;
      all.bias.push(difference(place, truth));
    }
    smoother.add({ time, place });
    const average = smoother.average();
    if (shown) all.lag = Math.max(all.lag, average.lag);
    if (time < 1000 * still) {
      if (time < 1000) continue;
      paths.measured.push(place);
      paths.smoothed.push(average.place);
      paths.predicted.push(smoother.at(time));
    } else if (shown) {
      // What is constant (the size of the head, hair) is no error of following.
      offset ??= difference(mean(paths.measured), truthAt(pictures, 2000));
      const later = truthAt(pictures, time + late);
      if (later !== null && time > 1000 * still + 1000) all.moving.push(difference(difference(smoother.at(time + late), later), offset));
    }
  }
  for (const [name, path] of Object.entries(paths)) {
    const middle = mean(path);
    all[name].push(...path.map((point) => difference(point, middle)));
  }
}

function truthAt(pictures, time) {
  return pictures.find((picture) => picture.time >= time - 1e-6)?.truth ?? null;
}
function difference(a, b) {
  return { x: a.x - b.x, y: a.y - b.y, z: a.z - b.z };
}
function mean(path) {
  return Object.fromEntries(axes.map((axis) => [axis, path.reduce((sum, point) => sum + point[axis], 0) / path.length]));
}

function report() {
  console.log(`${viewers.size} viewers: found in ${all.found} of ${all.pictures} pictures (${((100 * all.found) / all.pictures).toFixed(2)} %), without those with a hand before the face`);
  const line = (words, errors) =>
    console.log(`${words}: ${axes.map((axis) => `${axis} ${millimetres(rms(errors.map((error) => error[axis])))}`).join(', ')}, together ${millimetres(Math.sqrt(axes.reduce((sum, axis) => sum + rms(errors.map((error) => error[axis])) ** 2, 0)))} mm`);
  line('still head, trembling as found', all.measured);
  line('still head, trembling smoothed', all.smoothed);
  line('still head, trembling as the page shows it', all.predicted);
  line('error of the place found (root mean square)', all.bias);
  line(`moving head as the page shows it ${late} ms after its picture, without what is constant`, all.moving);
  console.log(`lag of the smoothing: at most ${all.lag.toFixed(1)} ms`);
}
