// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Where the head is: metres in the frame of the screen, from its resting place straight before the middle of the picture.
// Keys and drags move it.
import { t } from '../../language';
import type { ScreenPoint } from './frustum';

export const restingHead: ScreenPoint = { x: 0, y: 0, z: 0 };

const aside = 0.4;
const step = 0.01;
const largeStep = 0.05;

/** Within an arm's length to the sides, not nearer than half of the resting place's distance, nor farther than twice. */
export function clampHead({ x, y, z }: ScreenPoint, screenDistance: number): ScreenPoint {
  const within = (value: number, least: number, most: number) => Math.min(most, Math.max(least, value));
  return { x: within(x, -aside, aside), y: within(y, -aside, aside), z: within(z, -screenDistance / 2, screenDistance) };
}

/** The head's motion by an arrow key, `right` and `down` being -1, 0 or 1; with Shift up and down lead nearer and away. */
export function headStep(right: number, down: number, shift: boolean): ScreenPoint {
  return shift ? { x: right * largeStep, y: 0, z: down * largeStep } : { x: right * step, y: -down * step, z: 0 };
}

/** The head's place in a sentence. */
export function headWords({ x, y, z }: ScreenPoint): string {
  const count = (metres: number) => ({ count: Math.round(100 * Math.abs(metres)) });
  const right = x > 0 ? t('{count, plural, one {# centimetre} other {# centimetres}} right', count(x)) : t('{count, plural, one {# centimetre} other {# centimetres}} left', count(x));
  const up = y > 0 ? t('{count, plural, one {# centimetre} other {# centimetres}} up', count(y)) : t('{count, plural, one {# centimetre} other {# centimetres}} down', count(y));
  const away = z > 0 ? t('{count, plural, one {# centimetre} other {# centimetres}} farther away', count(z)) : t('{count, plural, one {# centimetre} other {# centimetres}} nearer', count(z));
  const place = [right, up, away].filter((_, k) => count([x, y, z][k]!).count > 0).join(', ');
  return place === '' ? t('Your head is straight before the picture.') : t('Your head is {place}.', { place });
}
