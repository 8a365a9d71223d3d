// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { HeightsFrame, PictureFrame } from '../codec';
import type { Scene } from '../generated/protocol';
import { SceneFrames } from './scene_frames';

const scene: Scene = {
  type: 'scene', scene: 2, name: 'cone', description: null, kind: 'relief', upright: false, size_x_m: 0.1, size_y_m: 0.1, middle_x_m: 0, middle_y_m: 0, start_x_m: 0, start_y_m: 0, lowest_m: 0, highest_m: 0.01,
  has_picture: true, has_second_view: false, cells: null, labels: [],
};
const heights: HeightsFrame = { kind: 'heights', scene: 2, columns: 2, rows: 2, heights: new Float32Array(4) };
const picture: PictureFrame = { kind: 'picture', scene: 2, columns: 1, rows: 1, rgb: new Uint8Array(3) };

it('a scene is complete with its own heights and picture', () => {
  const frames = new SceneFrames();
  expect(frames.take(heights)).toBe(false);
  frames.scene = scene;
  expect(frames.take({ ...heights, scene: 1 })).toBe(false);
  expect(frames.take(heights)).toBe(true);
  expect(frames.surface?.sizeX).toBe(0.1);
  expect(frames.isComplete).toBe(false);
  frames.take(picture);
  expect(frames.isComplete).toBe(true);
  frames.take(heights);
  expect(frames.isComplete).toBe(false);
});

it('a scene of a pair is complete with its second view', () => {
  const frames = new SceneFrames();
  frames.scene = { ...scene, has_second_view: true };
  frames.take(heights);
  frames.take(picture);
  expect(frames.isComplete).toBe(false);
  frames.take({ ...picture, kind: 'second' });
  frames.take({ kind: 'shift', scene: 2, columns: 1, rows: 1, shares: new Float32Array(1) });
  expect(frames.isComplete).toBe(true);
  expect(frames.secondView?.picture.kind).toBe('second');
});

it('a field is complete with its cells', () => {
  const frames = new SceneFrames();
  frames.scene = { ...scene, has_picture: false, cells: 'The field has 8 cells.' };
  frames.take(heights);
  expect(frames.isComplete).toBe(false);
  frames.take({ ...picture, kind: 'cells' });
  expect(frames.isComplete).toBe(true);
});
