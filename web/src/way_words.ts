// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A way in the scene, in words.
import { t } from './language';

/** "12 millimetres right, 5 millimetres up"; empty within half a millimetre. Metres, from here to there. */
export function wayWords(dx: number, dy: number): string {
  const [right, up] = [Math.round(1000 * dx), Math.round(1000 * dy)];
  const parts: string[] = [];
  if (right > 0) parts.push(t('{count, plural, one {# millimetre} other {# millimetres}} right', { count: right }));
  if (right < 0) parts.push(t('{count, plural, one {# millimetre} other {# millimetres}} left', { count: -right }));
  if (up > 0) parts.push(t('{count, plural, one {# millimetre} other {# millimetres}} up', { count: up }));
  if (up < 0) parts.push(t('{count, plural, one {# millimetre} other {# millimetres}} down', { count: -up }));
  return parts.join(', ');
}
