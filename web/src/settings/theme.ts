// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import type { Preferences } from './preferences';

/** The colours that a page uses: those chosen, else the system's. */
export function themeOf(theme: Preferences['theme']): string {
  if (theme !== 'system') return theme;
  if (matchMedia('(prefers-contrast: more)').matches) return 'contrast';
  return matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}
