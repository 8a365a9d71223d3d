// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The settings of the page and of the touch: the panels show and change the store, and the page follows it.
import { t } from '../language';
import { element } from '../dom';
import type { Change, Edit, Law, Materials, Settings as ProgramSettings } from '../generated/protocol';
import { Controls } from '../settings/controls';
import { MaterialPanel } from '../settings/material_panel';
import type { Preferences } from '../settings/preferences';
import type { Settings } from '../settings/settings';
import { SettingsStore } from '../settings/settings_store';

/** The user's preferences beyond this visit. */
export interface KeptPreferences {
  read(): Preferences;
  /** Called after the first change, with all preferences. */
  keep(preferences: Preferences): void;
}

export interface SettingsPage {
  send(message: Change | Edit): void;
  say(words: string): void;
  /** The settings have changed, or the system's colours. */
  follow(settings: Settings): void;
  /** The user has changed a setting. */
  changed(settings: Settings, what: string): void;
}

const undoWords = (changed: string | null) => (changed === null ? t('Nothing to undo.') : t('Undone: {changed}.', { changed }));
const redoWords = (changed: string | null) => (changed === null ? t('Nothing to redo.') : t('Redone: {changed}.', { changed }));

export class TouchSettings {
  readonly controls: Controls;
  private readonly store: SettingsStore;
  private readonly materials: MaterialPanel;

  constructor(
    private readonly preferences: KeptPreferences,
    private readonly page: SettingsPage,
  ) {
    const initial: Settings = { touch: { law: '', set: {}, heightFactor: 1 }, page: preferences.read(), materials: [] };
    this.store = new SettingsStore(initial, (change) => page.send(change));
    this.controls = new Controls(initial, (settings, what) => this.change(settings, what));
    this.materials = new MaterialPanel(initial, (settings, what) => this.change(settings, what));
  }

  get now(): Settings {
    return this.store.settings;
  }

  /** How many changes can be undone. */
  get steps(): number {
    return this.store.steps;
  }

  change(settings: Settings, what: string): void {
    this.store.change(settings, what);
    this.apply();
    this.page.changed(settings, what);
  }
  changePage(page: Partial<Settings['page']>, what: string): void {
    this.change({ ...this.now, page: { ...this.now.page, ...page } }, what);
  }
  toggleSound(): void {
    const sound = !this.now.page.sound;
    this.changePage({ sound }, 'sound');
    this.page.say(sound ? t('Sound on.') : t('Sound off.'));
  }
  /** False: there is nothing to undo or redo, which is said. */
  undoOrRedo(which: 'undo' | 'redo'): boolean {
    const changed = this.store.undoOrRedo(which);
    if (changed !== null) this.apply();
    this.page.say(which === 'undo' ? undoWords(changed) : redoWords(changed));
    return changed !== null;
  }
  reset(): void {
    this.store.reset();
    this.apply();
    this.page.say(t('All settings were reset.'));
  }
  /** Selects the region with this label for editing. */
  editRegion(label: number): void {
    const found = this.materials.choose(label);
    this.page.say(found ? t('Editing {name}.', { name: this.materials.name() }) : t('There is no region here.'));
  }

  // The program.

  connected(): void {
    this.store.connected();
  }
  setLaws(laws: readonly Law[]): void {
    this.store.setLaws(laws);
    this.controls.setLaws(laws);
    this.materials.show(this.now, this.controls.law());
  }
  receive(settings: ProgramSettings): void {
    if (this.store.receive(settings)) this.apply();
  }
  receiveMaterials(materials: Materials): void {
    if (this.store.receiveMaterials(materials)) this.apply();
  }

  /** Shows the settings in the panels and on the page, and keeps the user's preferences. */
  apply(): void {
    const { settings, used } = this.store;
    this.controls.show(settings, used);
    this.materials.show(settings, this.controls.law());
    element<HTMLButtonElement>('undo').disabled = !this.store.canUndo;
    element<HTMLButtonElement>('redo').disabled = !this.store.canRedo;
    if (this.store.wasUsed) this.preferences.keep(settings.page);
    this.page.follow(settings);
  }
}
