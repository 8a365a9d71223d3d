// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The cards of scenes on the shelf.
import { known, t } from '../language';
import type { ShelfScene } from '../generated/protocol';

export interface CardTarget {
  touch(scene: ShelfScene): void;
  saveAs(scene: ShelfScene): void;
  /** Not set: the scene stays on the shelf. */
  forget?: (scene: ShelfScene) => void;
}

function made<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, className = '', text = ''): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  if (className !== '') element.className = className;
  // Names come from files: they are text, whatever they contain.
  element.textContent = text;
  return element;
}

function button(words: string, label: string, act: () => void): HTMLButtonElement {
  const button = made('button', '', words);
  button.type = 'button';
  button.setAttribute('aria-label', label);
  button.onclick = act;
  return button;
}

export function showCards(list: HTMLElement, scenes: readonly ShelfScene[], target: CardTarget): void {
  list.replaceChildren(
    ...scenes.map((scene) => {
      const card = made('li');
      const frame = made('div', 'picture');
      if (scene.picture !== null) {
        const picture = made('img');
        picture.src = scene.picture;
        picture.alt = '';
        frame.append(picture);
      }
      const words = made('div', 'words');
      words.append(made('h3', '', known(scene.title)), made('p', 'kind', known(scene.kind)), made('p', '', known(scene.sentence)));
      const actions = made('div', 'actions');
      actions.append(button(t('Touch'), t('Touch {title}', { title: known(scene.title) }), () => target.touch(scene)));
      if (scene.forms.length > 0) actions.append(button(t('Save'), t('Save {title} as a file', { title: known(scene.title) }), () => target.saveAs(scene)));
      const { forget } = target;
      if (forget) actions.append(button(t('Remove'), t('Remove {title} from this list', { title: known(scene.title) }), () => forget(scene)));
      card.append(frame, words, actions);
      return card;
    }),
  );
}
