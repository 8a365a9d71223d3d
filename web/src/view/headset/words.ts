// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is said about the headset: one sentence each.
import type { Surface } from '../../surface';
import { usualScale } from './standing';
import type { HeadsetFault, HeadsetObstacle } from './support';

export const obstacleWords: Record<HeadsetObstacle, string> = {
  'no WebXR': 'This browser shows nothing in a headset: it has no WebXR.',
  insecure: 'Browsers use a headset for pages of this machine or with TLS only.',
  'no headset': 'This browser finds no headset. Connect one, and this is offered here.',
  forbidden: 'This page may not use a headset here: it is shown within another page that does not allow it.',
};
export const faultWords: Record<HeadsetFault, string> = {
  refused: 'The headset was refused: allow it for this page in the browser, and try again.',
  busy: 'The headset is used by another page.',
  gone: 'The headset is not there any more.',
  failed: 'The headset cannot be started.',
};

export const headsetWords = {
  flat: 'A headset needs the view in 3D.',
  show: 'Show it in the headset',
  leave: 'Leave the headset',
  waiting: 'The headset is being started.',
  began: 'The scene stands before you in the headset. Point at it to touch it; keep the handle pressed to move and turn it, both handles to magnify it. Escape ends it.',
  left: 'The scene is on the screen again.',
  lost: 'The headset has ended: the scene is on the screen again.',
} as const;

const metres = (value: number) => (value < 1 ? `${Number((100 * value).toPrecision(2))} centimetres` : value < 1.05 ? '1 metre' : `${Number(value.toPrecision(2))} metres`);

/** How large the scene stands in the room; `size`: per cent of the usual size. */
export function sizeWords(surface: Surface, size: number): string {
  const scale = (usualScale(surface) * size) / 100;
  const side = Math.max(surface.sizeX, surface.sizeY);
  const truth = Math.abs(scale - 1) < 0.005 ? 'its true size' : `its true size is ${metres(side)}`;
  return `In the headset its longer side is ${metres(side * scale)}; ${truth}.`;
}
