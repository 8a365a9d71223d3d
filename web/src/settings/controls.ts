// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The settings panel: what it shows and what a person changes in it.
import { element } from '../dom';
import type { Law } from '../generated/protocol';
import type { Material } from './materials';
import type { Preferences } from './preferences';

/** What the program keeps (protocol.json, "change"). */
export interface TouchSettings {
  law: string;
  stiffness: number;
  damping_Ns_per_m: number;
  friction: number;
  exaggeration: number;
  neighbourhood_px: number;
}

export interface Settings {
  touch: TouchSettings;
  page: Preferences;
  /** By label. */
  materials: Material[];
}

interface Slider {
  id: string;
  read(settings: Settings): number;
  write(settings: Settings, value: number): Settings;
  words(value: number, law: Law | undefined): string;
}

const touchSlider = (id: string, key: keyof TouchSettings, words: Slider['words']): Slider => ({
  id,
  read: ({ touch }) => touch[key] as number,
  write: (settings, value) => ({ ...settings, touch: { ...settings.touch, [key]: value } }),
  words,
});
const pageSlider = (id: keyof Preferences, words: Slider['words']): Slider => ({
  id,
  read: ({ page }) => page[id] as number,
  write: (settings, value) => ({ ...settings, page: { ...settings.page, [id]: value } }),
  words,
});

const sliders: Slider[] = [
  touchSlider('stiffness', 'stiffness', (value, law) => `${shown(value)} ${law?.stiffness_unit ?? ''}`),
  touchSlider('damping', 'damping_Ns_per_m', (value) => `${shown(value)} N·s/m`),
  touchSlider('friction', 'friction', (value) => shown(value)),
  touchSlider('exaggeration', 'exaggeration', (value) => `× ${shown(value)}`),
  touchSlider('neighbourhood', 'neighbourhood_px', (value) => `${shown(value)} px`),
  pageSlider('volume', (value) => `${shown(value)} %`),
  pageSlider('tilt', (value) => `${shown(value)}°`),
];
const checks = ['sound', 'speech', 'vibration'] as const;
const selects = ['surface', 'view', 'theme'] as const;

/** At most three digits after the point, and none that say nothing. */
export function shown(value: number): string {
  return String(Number(value.toFixed(value < 10 ? 2 : 0)));
}

export class Controls {
  private laws: Law[] = [];

  constructor(
    private settings: Settings,
    private readonly changed: (settings: Settings, what: string) => void,
  ) {
    for (const slider of sliders)
      element<HTMLInputElement>(slider.id).addEventListener('input', ({ target }) =>
        this.take(slider.write(this.settings, (target as HTMLInputElement).valueAsNumber), slider.id),
      );
    for (const id of checks)
      element<HTMLInputElement>(id).addEventListener('change', ({ target }) => this.takePage(id, (target as HTMLInputElement).checked));
    for (const id of selects)
      element<HTMLSelectElement>(id).addEventListener('change', ({ target }) => this.takePage(id, (target as HTMLSelectElement).value));
    element<HTMLSelectElement>('law').addEventListener('change', ({ target }) => this.takeLaw((target as HTMLSelectElement).value));
    this.show(settings);
  }

  setLaws(laws: Law[]): void {
    this.laws = laws;
    element<HTMLSelectElement>('law').replaceChildren(...laws.map(({ name, title }) => new Option(title, name)));
    this.show(this.settings);
  }

  show(settings: Settings): void {
    this.settings = settings;
    const law = this.law();
    const stiffness = element<HTMLInputElement>('stiffness');
    if (law !== undefined) {
      stiffness.min = String(law.stiffness_min);
      stiffness.max = String(law.stiffness_max);
      stiffness.step = String((law.stiffness_max - law.stiffness_min) / 100);
    }
    element('neighbourhood-row').hidden = !(law?.has_neighbourhood ?? false);
    element('stiffness-name').textContent = law?.stiffness_unit === 'N' ? 'Force' : 'Stiffness';
    element<HTMLInputElement>('friction').disabled = law !== undefined && !law.has_friction;
    element<HTMLSelectElement>('law').value = settings.touch.law;
    for (const slider of sliders) {
      const input = element<HTMLInputElement>(slider.id);
      const words = input.disabled ? 'not in this law' : slider.words(slider.read(settings), law);
      input.value = String(slider.read(settings));
      input.setAttribute('aria-valuetext', words);
      element(`${slider.id}-value`).textContent = words;
    }
    for (const id of checks) element<HTMLInputElement>(id).checked = settings.page[id];
    for (const id of selects) element<HTMLSelectElement>(id).value = settings.page[id];
    // A liking for cells is kept for the next field; meanwhile the picture is what is seen.
    if (element<HTMLOptionElement>('surface-cells').disabled && settings.page.surface === 'cells') element<HTMLSelectElement>('surface').value = 'picture';
    element<HTMLInputElement>('volume').disabled = !settings.page.sound;
    element<HTMLInputElement>('tilt').disabled = settings.page.view === 'flat';
  }

  /** Only a field has cells to show. */
  offerCells(there: boolean): void {
    const option = element<HTMLOptionElement>('surface-cells');
    option.hidden = option.disabled = !there;
    this.show(this.settings);
  }

  law(): Law | undefined {
    return this.laws.find(({ name }) => name === this.settings.touch.law);
  }

  private takePage(id: string, value: boolean | string): void {
    this.take({ ...this.settings, page: { ...this.settings.page, [id]: value } }, id);
  }

  /** Another law may mean another stiffness: it begins with its own. */
  private takeLaw(name: string): void {
    const before = this.law();
    const law = this.laws.find((other) => other.name === name);
    if (law === undefined) return;
    const same = before !== undefined && before.stiffness_unit === law.stiffness_unit;
    const stiffness = same ? this.settings.touch.stiffness : law.stiffness_default;
    this.take({ ...this.settings, touch: { ...this.settings.touch, law: name, stiffness } }, 'law');
  }

  private take(settings: Settings, what: string): void {
    this.show(settings);
    this.changed(settings, what);
  }
}
