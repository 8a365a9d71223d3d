// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Radio buttons in a fieldset, of which the first one is chosen.

export interface Choice {
  value: string;
  words: string;
}

/** Puts them in place of the earlier ones. */
export function offerChoices(fieldset: HTMLElement, name: string, choices: readonly Choice[], changed: () => void): void {
  fieldset.querySelectorAll('.check').forEach((old) => old.remove());
  choices.forEach(({ value, words }, k) => {
    const label = document.createElement('label');
    label.className = 'check';
    const input = document.createElement('input');
    input.type = 'radio';
    input.name = name;
    input.value = value;
    input.defaultChecked = k === 0;
    input.onchange = changed;
    label.append(input, ` ${words}`);
    fieldset.append(label);
  });
}
