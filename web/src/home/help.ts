// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The help: a dialog whose table of keys is made from the keys themselves.
import { element } from '../dom';
import { keyRows } from './keys';

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

export function showHelp(): void {
  element<HTMLDialogElement>('help-dialog').showModal();
}
