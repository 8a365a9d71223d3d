// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Names of points and regions, by key and by button: listing, naming, finding, and undoing changes of names.
import { t } from '../language';
import { element } from '../dom';
import type { Around, AroundPlace, FromPage, Words as Answer } from '../generated/protocol';
import { Importance, noScene, type Words } from '../sound/announcer';
import type { Feedback } from '../sound/feedback';
import type { Place, Surface } from '../surface';
import { Finder } from './finder';
import { NameForm } from './name_form';
import { PlacesList } from './places_list';

export interface NamesPage {
  surface(): Surface | null;
  probe(): number;
  place(): Place;
  way(): Promise<Answer | null>;
  say(words: Words | string, importance: Importance): void;
  send(message: FromPage): void;
  /** How many settings can be undone. */
  settingsSteps(): number;
  /** The probe has been led to its name. */
  found(): void;
}

export class Names {
  readonly finder: Finder;
  private readonly list: PlacesList;
  private readonly form: NameForm;
  private serial = 0;
  /** What the answer of the program is for. */
  private asked: ((around: Around) => void) | null = null;
  /** How many settings could be undone when each name was changed; and those of undone changes. */
  private done: number[] = [];
  private undone: number[] = [];
  /** The next click on the surface names its place. */
  private naming = false;

  constructor(
    private readonly page: NamesPage,
    feedback: Feedback,
  ) {
    this.finder = new Finder(
      { ...page, ended: () => page.send({ type: 'find', probe: page.probe(), list: 0, place: null, x_m: 0, y_m: 0 }) },
      feedback,
    );
    this.list = new PlacesList({
      find: (place, list) => this.find(place, list),
      rename: ({ place }) =>
        this.ask((around) => {
          const one = around.places.find((other) => other.place === place);
          if (one) this.form.rename(around, page.place(), one);
        }),
      remove: (place, list) => page.send({ type: 'unname', list, place: place.place }),
      save: () => page.send({ type: 'save' }),
    });
    this.form = new NameForm(({ list, place, name, sentence, at }) =>
      page.send({ type: 'name', list, place, name, sentence, x_m: at.x, y_m: at.y }),
    );
  }

  open(): void {
    this.ask((around) => this.list.show(around));
  }
  /** Names the probe's place. */
  nameHere(at = this.page.place()): void {
    this.setNaming(false);
    if (this.ask((around) => this.form.offer(around), at)) this.form.open(at);
  }
  /** The button: by keyboard the probe's place is named, by pointer the next place that is clicked. */
  nameByButton(event: Event): void {
    if (!(event instanceof MouseEvent) || event.detail === 0) return this.nameHere();
    this.setNaming(!this.naming);
    this.page.say(this.naming ? t('Click the place to name.') : t('Nothing is named.'), Importance.answer);
  }
  /** A click on the surface; false if it names nothing. */
  clicked(place: Place | null): boolean {
    if (!this.naming || place === null) return false;
    this.nameHere(place);
    return true;
  }
  sayWay(): void {
    const none = this.finder.reached === null ? t('You are led to no name.') : t('{name} was reached.', { name: this.finder.reached });
    this.page.say(this.finder.isLeading ? this.finder.words() : `${none} ${t('L lists the names.')}`, Importance.answer);
  }
  /** False: the probe is led to no name. */
  stopFinding(): boolean {
    if (!this.finder.isLeading) return false;
    this.finder.stop();
    this.page.say(t('No longer led.'), Importance.answer);
    return true;
  }

  receive(around: Around): void {
    if (around.serial !== this.serial) return;
    const { asked } = this;
    this.asked = null;
    asked?.(around);
  }
  /** A name was changed by one of the pages. */
  changed(): void {
    this.done.push(this.page.settingsSteps());
    this.undone = [];
    if (this.list.isOpen) this.open();
  }
  /** The connection is lost, or there is another scene. */
  forget(): void {
    this.asked = null;
    // They are about what was there.
    this.list.leave();
    if (this.form.leave()) this.page.say(t('The name was not given.'), Importance.answer);
    if (this.finder.isLeading) this.finder.stop();
  }

  /** Undoes or redoes the last change of a name, if no setting was changed since; false: there is none. */
  undoOrRedo(which: 'undo' | 'redo'): boolean {
    const [from, to] = which === 'undo' ? [this.done, this.undone] : [this.undone, this.done];
    if (from.length === 0 || from[from.length - 1] !== this.page.settingsSteps()) return false;
    to.push(from.pop()!);
    this.page.send({ type: 'undo_name', redo: which === 'redo' });
    if (this.list.isOpen) this.open();
    return true;
  }

  private find(place: AroundPlace, list: number): void {
    const { x, y } = this.page.place();
    this.page.send({ type: 'find', probe: this.page.probe(), list, place: place.place, x_m: x, y_m: y });
    this.finder.begin(place.name);
  }

  /** False, and said: there is no scene. */
  private ask(then: (around: Around) => void, at = this.page.place()): boolean {
    if (this.page.surface() === null) {
      this.page.say(noScene, Importance.answer);
      return false;
    }
    this.serial += 1;
    this.asked = then;
    this.page.send({ type: 'look_around', serial: this.serial, x_m: at.x, y_m: at.y });
    return true;
  }

  private setNaming(naming: boolean): void {
    this.naming = naming;
    element('name-here').setAttribute('aria-pressed', String(naming));
  }
}
