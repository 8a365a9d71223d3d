// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The home page as a whole: shelf, question, making; one of them has the person's attention.
import { known, t } from '../language';
import { element } from '../dom';
import { enter } from '../enter';
import { protocolVersion, type Shelf, type ShelfScene } from '../generated/protocol';
import { bindArrivals } from './arrivals';
import { showCards } from './cards';
import { obstacleTo } from './kinds';
import { Making } from './making';
import { Refusal, tell } from './program';
import { Question } from './question';
import { SaveAsQuestion, showSaved } from './save_as';
import { sentWords } from './sent';
import { setSent } from '../sent_language';

export class ShelfPage {
  private shelf: Shelf | null = null;
  private readonly question = new Question({
    make: (wanted) => void this.follow(() => tell({ type: 'make', ...wanted }, 'job')),
    closed: () => this.show('open'),
    refused: (sentence) => this.alert(sentence),
    say: (words) => this.say(words),
  });
  private readonly saving = new SaveAsQuestion({
    save: (wanted) => void this.follow(() => tell({ type: 'save_as', ...wanted }, 'job'), t('Saving the scene')),
    closed: () => this.show('open'),
  });
  private readonly making = new Making();
  /** What is open besides the shelf. */
  private now: 'open' | 'question' | 'making' | 'save-as' | 'saved' = 'open';

  async start(): Promise<void> {
    bindArrivals({ files: (files) => this.open(files), refused: (sentence) => this.alert(sentence) });
    element('forget-all').onclick = () => {
      if (confirm(t('Remove all scenes of this list? They cannot be brought back.'))) void this.forget(null);
    };
    // From the touch back to this page: it is as it was left, but the shelf may have changed.
    window.addEventListener('pageshow', ({ persisted }) => {
      if (!persisted) return;
      this.show('open');
      void this.look();
    });
    if (location.hash.length > 1) {
      const refused = await enter();
      if (refused !== null) return this.alert(refused.sentence);
    }
    await this.look();
    // Screen readers begin to read there.
    if (document.activeElement === null || document.activeElement === document.body) element('choose').focus({ preventScroll: true });
  }

  private async look(): Promise<void> {
    await this.attempt(async () => this.showShelf(await tell({ type: 'look' }, 'shelf')));
  }

  /** Does something that may be refused; the refusal is shown. */
  private async attempt(act: () => Promise<void>): Promise<void> {
    try {
      await act();
    } catch (refusal) {
      if (!(refusal instanceof Refusal)) throw refusal;
      this.alert(refusal.message);
    }
  }

  private showShelf(shelf: Shelf): void {
    this.shelf = shelf;
    if (shelf.version !== protocolVersion) this.alert(t('This page and the program are of different versions: reload the page.'));
    const touch = (scene: ShelfScene) => void this.follow(() => tell({ type: 'open', scene: scene.scene }, 'job'));
    const saveAs = (scene: ShelfScene) => this.askHowToSave(scene);
    showCards(element('samples'), shelf.samples, { touch, saveAs });
    showCards(element('recent'), shelf.recent, { touch, saveAs, forget: (scene) => {
        if (confirm(t('Remove {title}? It cannot be brought back.', { title: known(scene.title) }))) void this.forget(scene);
      } });
    element('lately').hidden = shelf.recent.length === 0;
    element('touching').hidden = shelf.touching === null;
    element('touching-name').textContent = shelf.touching;
  }

  private async forget(scene: ShelfScene | null): Promise<void> {
    await this.attempt(async () => {
      this.showShelf(await tell({ type: 'forget', scene: scene?.scene ?? null }, 'shelf'));
      this.say(scene === null ? t('The list is empty.') : t('{title} is removed.', { title: known(scene.title) }));
      element(element('lately').hidden ? 'choose' : 'lately-title').focus();
    });
  }

  private open(files: readonly File[]): void {
    if (this.shelf === null || files.length === 0) return;
    if (this.now === 'making') return this.alert(t('A scene is being made: cancel it first.'));
    const obstacle = obstacleTo(files, this.shelf.most_files, this.shelf.most_file_bytes);
    if (obstacle !== null) return this.alert(obstacle);
    this.alert('');
    this.question.ask(files);
    this.show('question');
  }

  private askHowToSave(scene: ShelfScene): void {
    if (this.now === 'making') return this.alert(t('A scene is being made: cancel it first.'));
    this.alert('');
    this.saving.ask(scene);
    this.show('save-as');
  }

  private async follow(begin: () => Promise<{ job: number }>, title = t('Making the scene')): Promise<void> {
    if (this.now === 'making') return;
    const before = this.now;
    this.alert('');
    element('making-title').textContent = title;
    this.show('making');
    try {
      const end = await this.making.follow(begin, (words) => this.say(words));
      if (end.state === 'touching') return location.assign('/touch');
      if (end.state === 'saved') {
        const words = showSaved(end);
        this.show('saved');
        return this.say(words);
      }
      // What was chosen can be tried as something else.
      this.show(before);
      this.say(end.state === 'failed' ? '' : t('Cancelled.'));
      if (end.state === 'failed') this.alert(end.sentence);
    } catch (refusal) {
      this.show(before);
      this.say('');
      if (!(refusal instanceof Refusal)) throw refusal;
      this.alert(refusal.message);
    }
  }

  private show(what: ShelfPage['now']): void {
    this.now = what;
    for (const part of ['open', 'question', 'making', 'save-as', 'saved']) element(part).hidden = part !== what;
    if (what === 'question') this.question.focus();
    else if (what === 'save-as') this.saving.focus();
    else element({ open: 'choose', making: 'making-title', saved: 'saved-title' }[what]).focus();
  }

  private alert(sentence: string): void {
    const banner = element('banner');
    banner.hidden = sentence === '';
    setSent(banner, sentWords(sentence));
    if (sentence !== '') banner.scrollIntoView({ block: 'nearest' });
  }

  private say(words: string): void {
    setSent(element('said'), words);
  }
}
