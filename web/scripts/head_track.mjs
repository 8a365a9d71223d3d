// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// How well heads are found, how much a still one trembles, and how late the smoothed place is:
//   node scripts/head_track.mjs VIDEO.mp4 [EVERY]
// Each (EVERY-th) picture of the video goes through the finder of faces, its fit and the smoother of the page, whatever the
// machine's speed; the lens is the default one. A second of the video counts as still if the means of the found places over
// its first, middle and last half differ by less than 3 mm. What the head moves within it counts as trembling.
import { readFileSync } from 'node:fs';
import { createServer } from 'vite';
import { chromium } from 'playwright-core';

const [file, every = '1'] = process.argv.slice(2);
const server = await createServer({ logLevel: 'error', server: { port: 0, host: '127.0.0.1' }, optimizeDeps: { noDiscovery: false } });
await server.listen();
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
try {
  const page = await browser.newPage();
  await page.route('**/head_track/*', (route) =>
    route.fulfill(route.request().url().endsWith('video.mp4') ? { body: readFileSync(file), contentType: 'video/mp4' } : { body: '<title>head</title>', contentType: 'text/html' }),
  );
  page.on('pageerror', (error) => console.error(String(error)));
  const at = server.resolvedUrls.local[0];
  await page.goto(`${at}head_track/page`);
  const samples = await page.evaluate(track, Number(every));
  const { HeadSmoother } = await server.ssrLoadModule('/src/view/head/smooth.ts');
  report(samples, HeadSmoother);
} finally {
  await browser.close();
  await server.close();
}

/** In the browser: the place in each picture, null without a face, metres; times in milliseconds. */
async function track(every) {
  const { fitFace, placeOf } = await import('/src/view/head/place.ts');
  const video = document.createElement('video');
  video.muted = true;
  video.src = URL.createObjectURL(await (await fetch('/head_track/video.mp4')).blob());
  const pictures = [];
  await new Promise((done) => {
    video.onended = done;
    let count = 0;
    const take = (_, { mediaTime }) => {
      if (count++ % every === 0) pictures.push({ time: 1000 * mediaTime, picture: createImageBitmap(video) });
      video.requestVideoFrameCallback(take);
    };
    video.requestVideoFrameCallback(take);
    video.playbackRate = 0.5;
    void video.play();
  });
  const worker = new Worker('/src/view/head/face_worker.ts?worker_file&type=module', { type: 'module' });
  const answer = () => new Promise((done) => (worker.onmessage = ({ data }) => done(data)));
  const { type } = await answer();
  if (type !== 'ready') throw new Error('the finder of faces was not loaded');
  const found = [];
  for (const { time, picture } of pictures) {
    const bitmap = await picture;
    const looked = answer();
    const begun = performance.now();
    worker.postMessage({ picture: bitmap, time }, [bitmap]);
    const { width, height, points } = await looked;
    const lens = { width, height, angle: 60, tilt: 0, up: 0 };
    found.push({ time, took: performance.now() - begun, place: points && placeOf(fitFace(points), lens, 0.063) });
  }
  return found;
}

function report(samples, HeadSmoother) {
  const seen = samples.filter(({ place }) => place !== null);
  console.log(`${samples.length} pictures, a face in ${seen.length} (${((100 * seen.length) / samples.length).toFixed(2)} %)`);
  console.log(`time for one, median: ${seen.map(({ took }) => took).sort((a, b) => a - b)[seen.length >> 1].toFixed(0)} ms (wall time, of this machine)`);
  const smoother = new HeadSmoother();
  const paths = { measured: [], smoothed: [], predicted: [] };
  let [lag, largest] = [0, 0];
  for (const sample of seen) {
    smoother.add(sample);
    const average = smoother.average();
    lag += average.lag / seen.length;
    largest = Math.max(largest, average.lag);
    paths.measured.push(sample.place);
    paths.smoothed.push(average.place);
    paths.predicted.push(smoother.at(sample.time));
  }
  console.log(`lag of the smoothing: mean ${lag.toFixed(1)} ms, largest ${largest.toFixed(1)} ms`);
  const axes = ['x', 'y', 'z'];
  const mean = (path, from, to, axis) => path.slice(from, to).reduce((sum, place) => sum + place[axis], 0) / (to - from);
  const second = Math.round((1000 * (seen.length - 1)) / (seen.at(-1).time - seen[0].time));
  const half = second >> 1;
  const still = [];
  for (let from = second; from + second <= seen.length; from += Math.max(1, Math.round(second / 5))) {
    const means = [0, half >> 1, second - half].map((begin) => axes.map((axis) => mean(paths.measured, from + begin, from + begin + half, axis)));
    const apart = (a, b) => Math.hypot(...a.map((value, k) => value - b[k]));
    if (Math.max(apart(means[0], means[1]), apart(means[1], means[2]), apart(means[0], means[2])) < 0.003) still.push(from);
  }
  console.log(`still seconds (they overlap): ${still.length}`);
  for (const [name, path] of Object.entries(paths)) {
    const squares = axes.map((axis) => still.reduce((sum, from) => {
      const middle = mean(path, from, from + second, axis);
      return sum + path.slice(from, from + second).reduce((total, place) => total + (place[axis] - middle) ** 2, 0) / second;
    }, 0) / still.length);
    const mm = (square) => (1000 * Math.sqrt(square)).toFixed(2);
    console.log(`${name}: jitter, root mean square, x ${mm(squares[0])}, y ${mm(squares[1])}, z ${mm(squares[2])}, together ${mm(squares[0] + squares[1] + squares[2])} mm`);
  }
}
