// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What is shown of the scene's depth, in words.
import type { Preferences } from '../../settings/preferences';
import { comfortLimit } from './comfort';
import type { Fit } from './fit';

const degrees = (angle: number) => `${Math.abs(angle).toFixed(1)}°`;

/** `fit`: null in a usual picture. */
export function depthWords(fit: Fit | null, look: Pick<Preferences, 'depthMode' | 'depthShare'>): string {
  if (fit === null) return 'A usual picture, the same for both eyes.';
  const share = Math.round(100 * fit.depth);
  const depth = share === 100 ? 'The true depth' : `${share} % of the true depth`;
  if (look.depthMode === 'head') return `${depth}, as seen with one eye from your head’s place.`;
  const reduced = share < look.depthShare ? ', so that it is easy on the eyes' : '';
  const most = Math.max(fit.nearest, -fit.farthest);
  const strain = most > comfortLimit + 0.05 ? ' More than one degree tires the eyes.' : '';
  return `${depth}${reduced}: disparities up to ${degrees(fit.nearest)} before the screen and ${degrees(fit.farthest)} behind it.${strain}`;
}
