// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Binds the page's buttons and the window's events to actions.
import { element } from '../dom';
import { undoKey } from './keys';

/** `actions`: by button id; `after` is called after each action. */
export function bindButtons(actions: Readonly<Record<string, () => void>>, after: () => void): void {
  for (const [id, act] of Object.entries(actions))
    element(id).addEventListener('click', () => {
      act();
      after();
    });
}

export interface WindowTarget {
  visibilityChanged(visible: boolean): void;
  /** The system's colours or contrast have changed. */
  coloursChanged(): void;
  undoOrRedo(which: 'undo' | 'redo'): void;
}

export function bindWindow(target: WindowTarget): void {
  document.addEventListener('visibilitychange', () => target.visibilityChanged(!document.hidden));
  for (const query of ['(prefers-color-scheme: dark)', '(prefers-contrast: more)', '(forced-colors: active)'])
    matchMedia(query).addEventListener('change', () => target.coloursChanged());
  document.addEventListener('keydown', (event) => {
    const which = undoKey(event);
    // In a text field it undoes what was typed.
    if (which === null || (event.target instanceof HTMLInputElement && event.target.type === 'text')) return;
    event.preventDefault();
    target.undoOrRedo(which);
  });
}
