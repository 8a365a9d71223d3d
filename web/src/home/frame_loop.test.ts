// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { FrameLoop } from './frame_loop';

it('requests one frame at a time while something moves, and none at rest', () => {
  const asked: (() => void)[] = [];
  const seen: [number | null, number][] = [];
  let [now, moving] = [0, 2];
  const loop = new FrameLoop((_, passed, waited) => (seen.push([passed, waited]), --moving > 0), (callback) => asked.push(callback), () => now);
  const run = (at: number) => ((now = at), asked.pop()!());
  loop.request();
  loop.request();
  expect(asked).toHaveLength(1);
  run(100);
  expect(asked).toHaveLength(1);
  run(116);
  expect(asked).toHaveLength(0);
  expect(loop.count).toBe(2);
  moving = 1;
  now = 5000;
  loop.request();
  run(5016);
  expect(seen).toEqual([[null, 100], [16, 16], [null, 16]]);
});

it('leaves the frames to a headset while that drives it, and loses none when it ends', () => {
  const asked: (() => void)[] = [];
  let [frames, moving] = [0, true];
  const loop = new FrameLoop(() => ((frames += 1), moving), (callback) => asked.push(callback), () => 0);
  loop.request();
  loop.drive(true);
  expect(asked).toHaveLength(1);
  // The frame that the window still owes is not drawn beside those of the headset.
  asked.pop()!();
  expect(frames).toBe(0);
  loop.tick();
  loop.tick();
  loop.request();
  expect([frames, asked.length]).toEqual([2, 0]);
  loop.drive(false);
  loop.drive(false);
  moving = false;
  expect(asked).toHaveLength(1);
  asked.pop()!();
  expect([frames, asked.length]).toEqual([3, 0]);
});
