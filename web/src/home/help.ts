// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The help: a dialog whose table of keys is made from the keys themselves, and the line of hints under the picture.
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

/** Opens at its top, and is read from there. */
export function showHelp(): void {
  const dialog = element<HTMLDialogElement>('help-dialog');
  dialog.showModal();
  element('help-title').focus({ preventScroll: true });
  dialog.scrollTop = 0;
}

/** How far the arrow keys go, on a scene of this scale. */
export function showSteps(scale: number): void {
  const millimetres = (metres: number) => `${Number((metres * scale * 1000).toPrecision(3))}\u00A0mm`;
  element('step-fine').textContent = millimetres(fineStep);
  element('step-coarse').textContent = millimetres(coarseStep);
}
