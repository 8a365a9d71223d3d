// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene in the frame of the screen: how large it is drawn, which of its planes lies in that of the screen, and how
// much of its depth is shown.
import { comfortableDepth, comfortLimit, disparityAngle, type DepthRange, type Viewer } from './comfort';
import type { ScreenPoint, Size } from './frustum';
import { inScreen, type Registration } from './registration';

/** The picture's size relative to the block. */
const margin = 1.07;

export interface FitOptions {
  /** The share of the depth that is before the screen, 0 to 1. */
  before: number;
  /** The wanted share of the true depth. */
  depth: number;
  /** Whether disparities are kept within `comfortLimit`. */
  comfort: boolean;
  zoom: number;
  /** The distance of the head now: nearer than the viewer's resting place, disparities are greater. */
  headDistance: number;
}

export interface Fit {
  /** Metres on the screen per metre of the scene. */
  scale: number;
  /** The plane of the scene that lies in the screen: metres of the scene from its middle towards the person. */
  plane: number;
  /** The share of the true depth that is shown. */
  depth: number;
  /** The greatest disparities before and behind the screen, degrees; behind it negative. */
  nearest: number;
  farthest: number;
  /** Whether it is the place where the hand feels the scene. */
  isByHand: boolean;
}

/**
 * `corners`: of the block, turned as it is seen, in metres of the scene from its middle. The scale does not depend on where
 * the head is.
 */
export function fitOf(corners: readonly ScreenPoint[], window: Size, viewer: Viewer, options: FitOptions): Fit {
  const range: DepthRange = { nearest: Math.max(...corners.map(({ z }) => z)), farthest: Math.min(...corners.map(({ z }) => z)) };
  const plane = range.farthest + (1 - options.before) * (range.nearest - range.farthest);
  // The eyes see the borders of what is before the screen beside one another: room for the greatest disparity.
  const apart = viewer.distance * Math.tan((comfortLimit * Math.PI) / 180);
  const across = Math.max(window.width / 4, window.width / 2 / margin - apart / 2);
  const up = window.height / 2 / margin;
  const within = (half: number, from: number, z: number) =>
    (half * viewer.distance) / (Math.abs(from) * viewer.distance + half * Math.max(0, z) * Math.max(1, options.depth));
  const scale = options.zoom * Math.min(...corners.map(({ x, y, z }) => Math.min(within(across, x, z - plane), within(up, y, z - plane))));
  const shown = (share: number): DepthRange => ({ nearest: (range.nearest - plane) * scale * share, farthest: (range.farthest - plane) * scale * share });
  const closest = { ...viewer, distance: Math.min(viewer.distance, options.headDistance) };
  // Never nearer than half-way to the eyes.
  const most = closest.distance / 2 / Math.max(1e-9, shown(1).nearest);
  const depth = Math.min(most, options.depth * (options.comfort ? comfortableDepth(shown(options.depth), closest) : 1));
  const { nearest, farthest } = shown(depth);
  return { scale, plane, depth, nearest: disparityAngle(nearest, closest), farthest: disparityAngle(farthest, closest), isByHand: false };
}

/** The fit that puts the scene where a hand feels it, in its whole depth; `corners`: of the block, in the scene's frame. */
export function fitByHand(corners: readonly ScreenPoint[], viewer: Viewer, registration: Registration): Fit {
  const depths = corners.map((corner) => inScreen(corner, registration).z);
  // What is beside the eyes has no disparity.
  const angle = (depth: number) => disparityAngle(Math.min(depth, 0.9 * viewer.distance), viewer);
  return { scale: registration.scale, plane: 0, depth: 1, nearest: angle(Math.max(...depths)), farthest: angle(Math.min(...depths)), isByHand: true };
}

/**
 * An eye in metres of the scene, from the middle of the picture in the screen's plane. To show a share of the depth is to
 * draw what an eye sees that is as many times farther away: both give the same picture.
 */
export function eyeInScene(eye: ScreenPoint, { scale, depth }: Fit): ScreenPoint {
  return { x: eye.x / scale, y: eye.y / scale, z: eye.z / (scale * depth) };
}
