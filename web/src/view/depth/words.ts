// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is shown of the scene's depth, in words.
import { fixed, t } from '../../language';
import type { Preferences } from '../../settings/preferences';
import { comfortLimit } from './comfort';
import type { Fit } from './fit';
import { straightPitch } from './layout';

const degrees = (angle: number) => t('{value}°', { value: fixed(Math.abs(angle), 1) });

/** How much of the depth is shown, and why not all of it. */
function shareWords({ depth }: Fit, { depthShare }: Pick<Preferences, 'depthShare'>): string {
  const share = Math.round(100 * depth);
  const shown = share === 100 ? t('The true depth') : t('{share} % of the true depth', { share });
  return share < depthShare ? t('{shown}, so that it is easy on the eyes', { shown }) : shown;
}

/** `fit`: null in a usual picture. `showsSecond`: whether the right eye sees the pair's own second picture. */
export function depthWords(fit: Fit | null, look: Pick<Preferences, 'depthMode' | 'depthShare' | 'eyeDistance' | 'screenDistance'>, showsSecond = false): string {
  if (fit === null) return t('A usual picture, the same for both eyes.');
  if (fit.isByHand && look.depthMode === 'head') return t('The scene stands where the hand feels it, as seen with one eye from your head’s place.');
  if (look.depthMode === 'head') return t('{shown}, as seen with one eye from your head’s place.', { shown: shareWords(fit, { depthShare: 0 }) });
  const pitch = Math.round(straightPitch({ distance: look.screenDistance, eyeDistance: look.eyeDistance }));
  const apart = look.depthMode === 'parallel' ? ` ${t('The pictures are at most {pitch} mm apart, so that the eyes need not turn outwards.', { pitch })}` : '';
  const second = showsSecond ? ` ${t('The right eye sees the second photograph, laid on the surface; what it does not show is taken from the first.')}` : '';
  const values = { shown: fit.isByHand ? t('The scene where the hand feels it') : shareWords(fit, look), nearest: degrees(fit.nearest), farthest: degrees(fit.farthest) };
  return `${t('{shown}: disparities up to {nearest} before the screen and {farthest} behind it.', values)}${strainWords(fit)}${apart}${second}`;
}

/** What magnifying the picture, or moving the head, may change. */
export function comfortWords(fit: Fit | null, look: Pick<Preferences, 'depthMode' | 'depthShare'>): string {
  return fit === null || look.depthMode === 'head' ? '' : `${shareWords(fit, look)}.${strainWords(fit)}`;
}

function strainWords({ nearest, farthest }: Fit): string {
  return Math.max(nearest, -farthest) > comfortLimit + 0.05 ? ` ${t('More than one degree tires the eyes.')}` : '';
}
