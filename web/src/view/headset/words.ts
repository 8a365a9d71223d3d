// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is said about the headset: one sentence each.
import { rounded, t } from '../../language';
import type { Surface } from '../../surface';
import { usualScale } from './standing';
import type { HeadsetFault, HeadsetObstacle } from './support';

export const obstacleWords: Record<HeadsetObstacle, string> = {
  'no WebXR': t('This browser shows nothing in a headset: it has no WebXR.'),
  insecure: t('Browsers use a headset for pages of this machine or with TLS only.'),
  'no headset': t('This browser finds no headset. Connect one, and this is offered here.'),
  forbidden: t('This page may not use a headset here: it is shown within another page that does not allow it.'),
};
export const faultWords: Record<HeadsetFault, string> = {
  refused: t('The headset was refused: allow it for this page in the browser, and try again.'),
  busy: t('The headset is used by another page.'),
  gone: t('The headset is not there any more.'),
  failed: t('The headset cannot be started.'),
};

export const headsetWords = {
  flat: t('A headset needs the view in 3D.'),
  show: t('Show it in the headset'),
  leave: t('Leave the headset'),
  waiting: t('The headset is being started.'),
  began: t('The scene stands before you in the headset. Point at it to touch it; keep the handle pressed to move and turn it, both handles to magnify it. Escape ends it.'),
  left: t('The scene is on the screen again.'),
  lost: t('The headset has ended: the scene is on the screen again.'),
} as const;

const metres = (value: number) => (value < 1 ? t('{value} centimetres', { value: rounded(100 * value, 2) }) : t('{value, plural, one {# metre} other {# metres}}', { value: Number(value.toPrecision(value < 1.05 ? 1 : 2)) }));

/** How large the scene stands in the room; `size`: per cent of the usual size. */
export function sizeWords(surface: Surface, size: number): string {
  const scale = (usualScale(surface) * size) / 100;
  const side = Math.max(surface.sizeX, surface.sizeY);
  const truth = Math.abs(scale - 1) < 0.005 ? t('its true size') : t('its true size is {size}', { size: metres(side) });
  return t('In the headset its longer side is {size}; {truth}.', { size: metres(side * scale), truth });
}
