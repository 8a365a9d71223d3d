// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The dialog that gives a name to a point, or to what is there.
import { t } from '../language';
import { element } from '../dom';
import type { Around, AroundPlace } from '../generated/protocol';
import type { Place } from '../surface';

/** What is named: a point, or one of the list's places. */
export interface Named {
  list: number;
  place: number | null;
  name: string;
  sentence: string;
  at: Place;
}

/** Why a name cannot be given; null: it can. */
export function problemOf(name: string): string | null {
  return name.replace(/[\p{Cc}\p{Cf}\s]/gu, '') === '' ? t('Type a name first.') : null;
}

export class NameForm {
  private readonly dialog = element<HTMLDialogElement>('name-dialog');
  private readonly name = element<HTMLInputElement>('name-text');
  private readonly sentence = element<HTMLInputElement>('name-sentence');
  private readonly of = element<HTMLSelectElement>('name-of');
  private at: Place = { x: 0, y: 0 };
  private around: Around | null = null;
  /** By the options of `of`: null is the point. */
  private named: (AroundPlace | null)[] = [];

  constructor(private readonly save: (named: Named) => void) {
    element<HTMLFormElement>('name-form').addEventListener('submit', (event) => {
      if (event.submitter?.id === 'name-cancel') return;
      const problem = problemOf(this.name.value);
      element('name-problem').textContent = problem ?? '';
      if (problem === null) return;
      event.preventDefault();
      this.name.focus();
    });
    this.of.addEventListener('change', () => this.fill());
    this.dialog.addEventListener('close', () => {
      const { returnValue } = this.dialog;
      this.dialog.returnValue = '';
      if (returnValue === 'save' && this.around !== null)
        this.save({ list: this.around.list, place: this.chosen?.place ?? null, name: this.name.value, sentence: this.sentence.value, at: this.at });
    });
  }

  private get chosen(): AroundPlace | null {
    return this.named[this.of.selectedIndex] ?? null;
  }

  /** For the place `at`: the point, or what covers it; `only`: this one place. */
  open(around: Around, at: Place, only?: AroundPlace): void {
    this.around = around;
    this.at = at;
    const here = around.places.filter(({ here: covers }) => covers);
    this.named = only ? [only] : [null, ...here];
    const words = (place: AroundPlace | null) => (place === null ? t('this point') : place.written ? t('instead of {name}', { name: place.name }) : t('the whole of {name}', { name: place.name }));
    this.of.replaceChildren(...this.named.map((place) => new Option(words(place))));
    this.of.disabled = this.named.length === 1;
    element('name-problem').textContent = '';
    element('name-title').textContent = only ? t('Rename {name}', { name: only.name }) : t('Name a place');
    this.name.value = this.sentence.value = '';
    this.fill();
    this.dialog.showModal();
    this.name.focus();
    this.name.select();
  }

  /** A written name is edited; something else gets one. */
  private fill(): void {
    const { chosen } = this;
    if (chosen === null) return;
    this.name.value = chosen.name;
    this.sentence.value = chosen.sentence;
  }
}
