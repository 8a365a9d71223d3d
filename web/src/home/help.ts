// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The help dialog, whose table is generated from keys.ts, and the line of hints under the picture.
import { rounded, t } from '../language';
import { element } from '../dom';
import { keyRows, coarseStep, fineStep } from './keys';

export function fillHelp(): void {
  element('help-keys').replaceChildren(
    ...keyRows.map(({ shown, does }) => {
      const row = document.createElement('tr');
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = shown;
      row.append(head);
      row.insertCell().textContent = does;
      return row;
    }),
  );
}

/** Opens the help, scrolled to its top and with the focus there. */
export function showHelp(): void {
  const dialog = element<HTMLDialogElement>('help-dialog');
  dialog.showModal();
  element('help-title').focus({ preventScroll: true });
  dialog.scrollTop = 0;
}

/** Shows the step of the arrow keys for a scene of this scale. */
export function showSteps(scale: number): void {
  const millimetres = (metres: number) => t('{value} mm', { value: rounded(metres * scale * 1000, 3) }).replace(' ', '\u00A0');
  element('step-fine').textContent = millimetres(fineStep);
  element('step-coarse').textContent = millimetres(coarseStep);
}
