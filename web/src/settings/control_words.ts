// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A control's name and value in words, for people who hear the page without a screen reader.

import { t } from '../language';

/** "Height: × 1.5", "Sound: on"; null if the element is no setting. */
export function controlWords(control: Element | null): string | null {
  if (control instanceof HTMLSelectElement) return named(control, control.selectedOptions[0]?.text ?? '');
  if (!(control instanceof HTMLInputElement)) return null;
  if (control.type === 'range') return named(control, control.getAttribute('aria-valuetext') ?? control.value);
  return control.type === 'checkbox' ? named(control, control.checked ? t('on') : t('off')) : null;
}

function named(control: HTMLInputElement | HTMLSelectElement, value: string): string {
  return `${control.labels?.[0]?.textContent?.trim() ?? ''}: ${value}`;
}
