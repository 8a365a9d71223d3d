// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What an eye before a screen sees through it: the picture is a window in the screen, and each eye has an off-axis frustum
// through it (Kooima, "Generalized perspective projection", 2009).
//
// The frame of the screen: metres on the real screen, origin in the middle of the window, x right, y up, z towards the person.

export interface ScreenPoint {
  x: number;
  y: number;
  z: number;
}

/** Metres on the screen. */
export interface Size {
  width: number;
  height: number;
}

/** The planes of a perspective projection, for a camera at the eye that looks along -z. */
export interface Frustum {
  left: number;
  right: number;
  bottom: number;
  top: number;
  near: number;
  far: number;
}

/** The frustum of an eye (z > 0) through a window; `near` and `far`: distances from the eye. All of one unit. */
export function offAxis(eye: ScreenPoint, window: Size, near: number, far: number): Frustum {
  const share = near / eye.z;
  return {
    left: (-window.width / 2 - eye.x) * share,
    right: (window.width / 2 - eye.x) * share,
    bottom: (-window.height / 2 - eye.y) * share,
    top: (window.height / 2 - eye.y) * share,
    near,
    far,
  };
}

/** Where on the screen an eye sees a point that is nearer to the screen than the eye. */
export function onScreen(point: ScreenPoint, eye: ScreenPoint): { x: number; y: number } {
  const share = eye.z / (eye.z - point.z);
  return { x: eye.x + (point.x - eye.x) * share, y: eye.y + (point.y - eye.y) * share };
}

/** The left and the right eye of a head, which is the middle between them; the line through the eyes is parallel to the screen's rows. */
export function eyesOf(head: ScreenPoint, eyeDistance: number): [ScreenPoint, ScreenPoint] {
  return [
    { ...head, x: head.x - eyeDistance / 2 },
    { ...head, x: head.x + eyeDistance / 2 },
  ];
}
