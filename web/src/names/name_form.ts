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
      if (returnValue === 'save')
        this.save({ list: this.around?.list ?? 0, place: this.chosen?.place ?? null, name: this.name.value, sentence: this.sentence.value, at: this.at });
    });
  }

  private get chosen(): AroundPlace | null {
    return this.named[this.of.selectedIndex] ?? null;
  }

  /** For the point `at`: at once, so that what is typed is typed here. */
  open(at: Place): void {
    this.show(null, at, [null]);
  }
  /** For one place of a list. */
  rename(around: Around, at: Place, place: AroundPlace): void {
    this.show(around, at, [place]);
  }
  /** What covers the point can be named instead of it. */
  offer(around: Around): void {
    if (!this.dialog.open) return;
    this.around = around;
    this.choose([null, ...around.places.filter(({ here }) => here)]);
  }
  /** Nothing is named; false: it was not open. */
  leave(): boolean {
    if (!this.dialog.open) return false;
    this.dialog.close('');
    return true;
  }

  private show(around: Around | null, at: Place, named: (AroundPlace | null)[]): void {
    this.around = around;
    this.at = at;
    this.choose(named);
    element('name-problem').textContent = '';
    const [only] = named;
    element('name-title').textContent = only ? t('Rename {name}', { name: only.name }) : t('Name a place');
    this.name.value = this.sentence.value = '';
    this.fill();
    this.dialog.showModal();
    this.name.focus();
    this.name.select();
  }

  private choose(named: (AroundPlace | null)[]): void {
    this.named = named;
    const words = (place: AroundPlace | null) => (place === null ? t('this point') : place.written ? t('instead of {name}', { name: place.name }) : t('the whole of {name}', { name: place.name }));
    this.of.replaceChildren(...this.named.map((place) => new Option(words(place))));
    this.of.disabled = this.named.length === 1;
  }

  /** A written name is edited; something else gets one. */
  private fill(): void {
    const { chosen } = this;
    if (chosen === null) return;
    this.name.value = chosen.name;
    this.sentence.value = chosen.sentence;
  }
}
