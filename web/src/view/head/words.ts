// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is said about the camera that follows the head: one sentence each.
import { t } from '../../language';
import type { CameraFault } from './camera';

export const faultWords: Record<CameraFault, string> = {
  refused: t('The camera was refused: allow it for this page in the browser, or move your head by keys with V.'),
  missing: t('No camera was found: move your head by keys with V.'),
  busy: t('The camera cannot be opened; another program may use it.'),
  insecure: t('This browser gives the camera to pages of this machine or with TLS only.'),
  ended: t('The camera was disconnected, so it does not follow your head any more.'),
  frozen: t('The camera gives no pictures any more, so it was turned off.'),
  'no finder': t('This browser is too old to look for a head in the camera’s pictures.'),
};

/** Degrees by which the camera looks down. */
export const tiltWords = (tilt: number): string => (tilt === 0 ? t('straight ahead') : tilt > 0 ? t('{tilt}° down', { tilt }) : t('{tilt}° up', { tilt: -tilt }));

export const headCameraWords = {
  waiting: t('The camera is being started.'),
  started: t('The camera looks for your head. Its pictures do not leave this page.'),
  found: t('Your head is seen: the view follows it.'),
  lost: t('Your head is not seen: the view goes back to the middle.'),
  several: t('Several faces are seen: the one nearest to where yours was is followed.'),
  severalHeads: t('Several heads are seen: the one nearest to where yours was is followed.'),
  off: t('The camera is off.'),
  unseen: t('Your head is not seen: sit before the camera, and try again.'),
  calibrated: t('The camera’s angle was set: your head is straight before the screen now.'),
  depthStarted: t('The depth camera looks for your head. Its pictures do not leave the program.'),
  depthMissing: t('The depth camera gives no pictures: the view goes back to the middle.'),
  depthEnded: t('The pictures of the depth camera have ended.'),
  depthOff: t('The depth camera does not follow your head any more.'),
  implausibleTilt: t('No camera that looks so sees your head straight before the screen: check how far it is above the screen’s edge.'),
  depthHead: t('Follow my head with the depth camera'),
  depthPrivacy: t('The depth camera’s pictures do not leave the program, which tells this page where your head is, and nothing else.'),
  depthStraight: t('Sit straight before the middle of the screen, and press the button: the tilt is set by it.'),
  depthAngle: t('stated by the depth camera'),
  implausible: t('At that distance no camera sees a face so large: check the distance of your eyes from the screen.'),
} as const;
