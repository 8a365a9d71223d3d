// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is said about the camera that follows the head: one sentence each.
import type { CameraFault } from './camera';

export const faultWords: Record<CameraFault, string> = {
  refused: 'The camera was refused: allow it for this page in the browser, or move your head by keys with V.',
  missing: 'No camera was found: move your head by keys with V.',
  busy: 'The camera cannot be opened; another program may use it.',
  insecure: 'This browser gives the camera to pages of this machine or with TLS only.',
  ended: 'The camera was disconnected, so it does not follow your head any more.',
  frozen: 'The camera gives no pictures any more, so it was turned off.',
  'no finder': 'This browser is too old to look for a head in the camera’s pictures.',
};

/** Degrees by which the camera looks down. */
export const tiltWords = (tilt: number): string => (tilt === 0 ? 'straight ahead' : tilt > 0 ? `${tilt}° down` : `${-tilt}° up`);

export const headCameraWords = {
  waiting: 'The camera is being started.',
  started: 'The camera looks for your head. Its pictures do not leave this page.',
  found: 'Your head is seen: the view follows it.',
  lost: 'Your head is not seen: the view goes back to the middle.',
  several: 'Several faces are seen: the one nearest to where yours was is followed.',
  off: 'The camera is off.',
  unseen: 'Your head is not seen: sit before the camera, and try again.',
  calibrated: 'The camera’s angle was set: your head is straight before the screen now.',
  implausible: 'At that distance no camera sees a face so large: check the distance of your eyes from the screen.',
} as const;
