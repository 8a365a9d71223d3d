// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the chosen files are, and the few options that matter. The files are sent while the person answers.
import { t } from '../language';
import { element } from '../dom';
import type { Make } from '../generated/protocol';
import { offerChoices } from './choices';
import { kindsOf, sizeWords } from './kinds';
import { Refusal, sendFile, tell, type Sending } from './program';

export interface QuestionTarget {
  make(wanted: Omit<Make, 'type'>): void;
  closed(): void;
  refused(sentence: string): void;
  say(words: string): void;
}

interface Chosen {
  file: File;
  sending: Sending;
  line: HTMLLIElement;
}

export class Question {
  private chosen: Chosen[] = [];

  constructor(private readonly target: QuestionTarget) {
    element<HTMLFormElement>('question').onsubmit = (event) => {
      event.preventDefault();
      void this.submit();
    };
    element('put-back').onclick = () => {
      this.discard();
      this.target.closed();
    };
    element('swap').onclick = () => {
      this.chosen.reverse();
      this.list();
      this.target.say(this.words());
    };
  }

  /** Begins to send the files, and asks what they are. */
  ask(files: readonly File[]): void {
    this.discard();
    this.chosen = files.map((file) => {
      const line = document.createElement('li');
      const name = document.createElement('span');
      name.textContent = file.name;
      const howFar = document.createElement('span');
      howFar.className = 'how-far';
      howFar.textContent = sizeWords(file.size);
      line.append(name, howFar);
      const sending = sendFile(file, (fraction) => (howFar.textContent = fraction < 1 ? t('{percent} % of {size}', { percent: Math.round(100 * fraction), size: sizeWords(file.size) }) : sizeWords(file.size)));
      // It is dealt with when the answer is submitted.
      sending.done.catch(() => undefined);
      return { file, sending, line };
    });
    this.list();
    this.offerKinds(files);
    element<HTMLFormElement>('question').reset();
    element<HTMLDetailsElement>('more').open = false;
    this.offerFields();
    this.target.say(this.words());
  }

  /** Which files were chosen, and of a pair which is the left one. */
  private words(): string {
    const names = this.chosen.map(({ file }) => file.name);
    if (names.length !== 2) return t('Chosen: {names}.', { names: names.join(', ') });
    return t('Chosen: {left} is the left one, {right} the right one.', { left: names[0]!, right: names[1]! });
  }

  focus(): void {
    element('kinds').querySelector<HTMLInputElement>('input:checked')?.focus();
  }

  private list(): void {
    element('chosen').replaceChildren(...this.chosen.map(({ line }) => line));
    element('swap').hidden = this.chosen.length !== 2;
  }

  private offerKinds(files: readonly File[]): void {
    element('kinds-title').textContent = files.length === 1 ? t('This file is') : t('These files are');
    offerChoices(element('kinds'), 'what', kindsOf(files).map(({ what, words }) => ({ value: what, words })), () => this.offerFields());
  }

  private get what(): string {
    return element('kinds').querySelector<HTMLInputElement>('input:checked')?.value ?? 'decide';
  }

  private offerFields(): void {
    for (const field of element('more').querySelectorAll<HTMLElement>('[data-for]'))
      field.hidden = !field.dataset.for!.split(' ').includes(this.what);
  }

  /** What the person has set, where it is offered. */
  private wanted(files: string[]): Omit<Make, 'type'> {
    const text = (id: string) => {
      const field = element<HTMLInputElement | HTMLSelectElement>(id);
      return field.closest<HTMLElement>('.field')!.hidden || field.value.trim() === '' ? null : field.value.trim();
    };
    const number = (id: string) => (text(id) === null ? null : Number(text(id)));
    return {
      files,
      what: this.what,
      title: text('title'),
      size_mm: number('size'),
      exaggerate: number('exaggerate'),
      ground: text('ground'),
      background: text('background'),
      moved_mm: number('moved'),
    };
  }

  private async submit(): Promise<void> {
    const make = element<HTMLButtonElement>('make');
    make.disabled = true;
    try {
      const sent = await Promise.all(this.chosen.map(({ sending }) => sending.done));
      this.target.make(this.wanted(sent.map(({ file }) => file)));
    } catch (refusal) {
      if (!(refusal instanceof Refusal)) throw refusal;
      this.target.refused(refusal.message);
    } finally {
      make.disabled = false;
    }
  }

  private discard(): void {
    for (const { sending } of this.chosen) {
      sending.stop();
      sending.done.then(({ file }) => tell({ type: 'discard', file }, 'shelf')).catch(() => undefined);
    }
    this.chosen = [];
  }
}
