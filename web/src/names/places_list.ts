// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The dialog with the names around a probe: a list box, which keyboards and screen readers know how to use.
import { element } from '../dom';
import type { Around, AroundPlace } from '../generated/protocol';
import { TypeAhead } from './type_ahead';

export interface PlacesTarget {
  find(place: AroundPlace, list: number): void;
  rename(place: AroundPlace): void;
  remove(place: AroundPlace, list: number): void;
  save(): void;
}

export class PlacesList {
  private readonly dialog = element<HTMLDialogElement>('places-dialog');
  private readonly list = element<HTMLSelectElement>('places-list');
  private readonly typeAhead = new TypeAhead();
  private around: Around | null = null;

  constructor(private readonly target: PlacesTarget) {
    this.list.addEventListener('change', () => this.select());
    this.list.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && this.chosen !== undefined) {
        event.preventDefault();
        this.dialog.close('find');
      }
      if ([...event.key].length === 1 && !event.ctrlKey && !event.altKey && !event.metaKey) this.type(event);
    });
    this.list.addEventListener('dblclick', () => this.chosen && this.dialog.close('find'));
    element('places-delete').addEventListener('click', () => {
      if (this.chosen && this.around) this.target.remove(this.chosen, this.around.list);
    });
    element('places-save').addEventListener('click', () => this.target.save());
    this.dialog.addEventListener('close', () => {
      const { chosen, around } = this;
      const what = this.dialog.returnValue;
      this.dialog.returnValue = '';
      if (chosen === undefined || around === null) return;
      if (what === 'find') this.target.find(chosen, around.list);
      if (what === 'rename') this.target.rename(chosen);
    });
  }

  get isOpen(): boolean {
    return this.dialog.open;
  }
  private get chosen(): AroundPlace | undefined {
    return this.around?.places[this.list.selectedIndex];
  }

  /** Shows the names, and opens the dialog if it is closed. */
  show(around: Around): void {
    const before = this.isOpen ? this.list.selectedIndex : 0;
    this.around = around;
    this.list.replaceChildren(...around.places.map(({ words, place }) => new Option(words, String(place))));
    this.list.selectedIndex = Math.min(before, around.places.length - 1);
    element('places-none').hidden = around.places.length > 0;
    this.select();
    if (this.isOpen) return;
    this.dialog.showModal();
    (around.places.length > 0 ? this.list : element('places-close')).focus();
  }

  /** Without a choice. */
  leave(): void {
    this.around = null;
    if (this.dialog.open) this.dialog.close('');
  }

  private type(event: KeyboardEvent): void {
    event.preventDefault();
    const found = this.typeAhead.type(event.key, event.timeStamp, this.around?.places ?? [], this.list.selectedIndex);
    if (found === null) return;
    this.list.selectedIndex = found;
    this.select();
  }

  private select(): void {
    const { chosen } = this;
    for (const id of ['places-find', 'places-rename']) element<HTMLButtonElement>(id).disabled = chosen === undefined;
    // What the program found is renamed, not deleted.
    element<HTMLButtonElement>('places-delete').disabled = !(chosen?.written ?? false);
    element('places-sentence').textContent = chosen?.sentence ?? '';
  }
}
