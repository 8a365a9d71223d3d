// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The first frames of a video as JPEGs, decoded by the browser. One after the other they are a file for its fake camera.
import { launch } from './harness';

export async function videoFrames(video: Buffer, most: number): Promise<Buffer[]> {
  const browser = await launch({ webgl: false });
  try {
    const page = await browser.newPage();
    await page.route('**/*', (route) => route.fulfill(route.request().url().endsWith('video.mp4') ? { body: video, contentType: 'video/mp4' } : { body: '', contentType: 'text/html' }));
    await page.goto('http://127.0.0.1/');
    const frames = await page.evaluate(async (count) => {
      const element = document.createElement('video');
      element.muted = true;
      element.src = URL.createObjectURL(await (await fetch('/video.mp4')).blob());
      const context = document.createElement('canvas').getContext('2d')!;
      const jpegs: string[] = [];
      await new Promise<void>((done) => {
        element.addEventListener('ended', () => done());
        const take = () => {
          context.canvas.width = element.videoWidth;
          context.canvas.height = element.videoHeight;
          context.drawImage(element, 0, 0);
          jpegs.push(context.canvas.toDataURL('image/jpeg', 0.95).split(',')[1]!);
          if (jpegs.length === count) done();
          else element.requestVideoFrameCallback(take);
        };
        element.requestVideoFrameCallback(take);
        element.playbackRate = 0.5;
        void element.play();
      });
      return jpegs;
    }, most);
    return frames.map((jpeg) => Buffer.from(jpeg, 'base64'));
  } finally {
    await browser.close();
  }
}
