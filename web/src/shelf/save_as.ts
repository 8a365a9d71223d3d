// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A scene of the shelf as another file: what for it is saved, and the files that the browser gets.
import { element } from '../dom';
import type { Job, SaveAs, ShelfScene } from '../generated/protocol';
import { known, language, t } from '../language';
import { setSent } from '../sent_language';
import { offerChoices } from './choices';
import { formsOf } from './forms';

export interface SaveAsTarget {
  save(wanted: Omit<SaveAs, 'type'>): void;
  closed(): void;
}

export class SaveAsQuestion {
  private scene: ShelfScene | null = null;

  constructor(private readonly target: SaveAsTarget) {
    element<HTMLFormElement>('save-as').onsubmit = (event) => {
      event.preventDefault();
      if (this.scene === null) return;
      const paper = element('paper-field').hidden ? null : element<HTMLSelectElement>('paper').value;
      this.target.save({ scene: this.scene.scene, form: this.form, paper, language });
    };
    element('save-not').onclick = () => this.target.closed();
    element('saved-done').onclick = () => this.target.closed();
  }

  ask(scene: ShelfScene): void {
    this.scene = scene;
    element('save-as-title').textContent = t('Save {title}', { title: known(scene.title) });
    offerChoices(element('forms'), 'form', formsOf(scene.forms).map(({ form, words }) => ({ value: form, words })), () => this.offerPaper());
    element<HTMLFormElement>('save-as').reset();
    this.offerPaper();
  }

  focus(): void {
    element('forms').querySelector<HTMLInputElement>('input:checked')?.focus();
  }

  private get form(): string {
    return element('forms').querySelector<HTMLInputElement>('input:checked')?.value ?? '';
  }

  private offerPaper(): void {
    element('paper-field').hidden = !formsOf([this.form]).some(({ onPaper }) => onPaper);
  }
}

/** Lists what was saved, and begins the download of a single file. Returns the words for it. */
export function showSaved({ saved, notes }: Job): string {
  const links = saved.map(({ name, address }) => {
    const link = document.createElement('a');
    link.href = address;
    link.download = name;
    link.textContent = name;
    return link;
  });
  const listed = (child: Node) => {
    const line = document.createElement('li');
    line.append(child);
    return line;
  };
  element('saved-files').replaceChildren(...links.map(listed));
  element('saved-notes').replaceChildren(
    ...notes.map((note) => {
      const line = document.createElement('li');
      setSent(line, known(note));
      return line;
    }),
  );
  const isOne = links.length === 1;
  element('saved-how').textContent = isOne ? t('If the download does not begin by itself, choose the file:') : t('Choose each file to download it:');
  const words = isOne ? t('Saved: {names}', { names: saved[0]!.name }) : t('Saved as {count} files', { count: links.length });
  element('saved-title').textContent = words;
  if (isOne) links[0]!.click();
  return [words, ...notes.map(known)].join('. ');
}
