// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The settings panel.
import { known, t } from '../language';
import { element } from '../dom';
import type { Law } from '../generated/protocol';
import { ParameterPanel } from './parameter_panel';
import { ranges, type Preferences } from './preferences';
import { RangeInput } from './range_input';
import { withLaw, type Settings } from './settings';

interface Slider {
  id: string;
  min: number;
  max: number;
  read(settings: Settings): number;
  write(settings: Settings, value: number): Settings;
  words(value: number): string;
}

const pageSlider = (key: keyof typeof ranges, words: Slider['words'], id: string = key): Slider => ({
  id,
  ...ranges[key],
  read: ({ page }) => page[key],
  write: (settings, value) => ({ ...settings, page: { ...settings.page, [key]: value } }),
  words,
});
const percent = (value: number) => t('{value} %', { value });
const soundSlider = (sound: 'contact' | 'slide' | 'height' | 'edge' | 'name' | 'find'): Slider =>
  pageSlider(`${sound}Volume`, (value) => (value === 0 ? t('0 %, off') : percent(value)), `${sound}-volume`);
const soundSliders = (['contact', 'slide', 'height', 'edge', 'name', 'find'] as const).map(soundSlider);

const sliders: Slider[] = [
  {
    id: 'height-factor',
    min: 0,
    max: 4,
    read: ({ touch }) => touch.heightFactor,
    write: (settings, heightFactor) => ({ ...settings, touch: { ...settings.touch, heightFactor } }),
    words: (value) => t('× {value}', { value }),
  },
  pageSlider('volume', percent),
  pageSlider('tilt', (value) => t('{value}°', { value })),
  ...soundSliders,
];
const depthSliders = [
  pageSlider('eyeDistance', (value) => t('{value} mm', { value }), 'eye-distance'),
  pageSlider('screenDistance', (value) => t('{value} cm', { value: value / 10 }), 'screen-distance'),
  pageSlider('depthBefore', (value) => (value === 0 ? t('0 %, all behind it') : value === 100 ? t('100 %, all before it') : percent(value)), 'depth-before'),
  pageSlider('depthShare', (value) => (value === 100 ? t('100 %, true') : percent(value)), 'depth-share'),
];
const headsetSlider = pageSlider('headsetSize', percent, 'headset-size');
sliders.push(...depthSliders, headsetSlider);
/** The preferences' controls: by id, the preference. */
const checks = { sound: 'sound', speech: 'speech', vibration: 'vibration', gamepads: 'gamepads', 'depth-comfort': 'depthComfort', 'second-view': 'secondView', 'swap-eyes': 'swapEyes' } as const;
const selects = { surface: 'surface', view: 'view', 'depth-mode': 'depthMode', theme: 'theme' } as const;
const keysOf = <T extends object>(table: T) => Object.keys(table) as (keyof T & string)[];

function optionOf({ name, title, unavailable }: Law): HTMLOptionElement {
  const option = new Option(unavailable === null ? known(title) : `${known(title)}: ${known(unavailable)}`, name);
  option.disabled = unavailable !== null;
  return option;
}

export class Controls {
  private laws: readonly Law[] = [];
  private used: Readonly<Record<string, number>> = {};
  private isRelief = true;
  private readonly ranges: RangeInput[];
  private readonly parameters: ParameterPanel;

  constructor(
    private settings: Settings,
    private readonly changed: (settings: Settings, what: string) => void,
  ) {
    this.ranges = sliders.map((slider) => new RangeInput(slider.id, (value) => this.take(slider.write(this.settings, value), slider.id)));
    this.parameters = new ParameterPanel((name, value) => {
      const { touch } = this.settings;
      this.take({ ...this.settings, touch: { ...touch, set: { ...touch.set, [name]: value } } }, name);
    });
    for (const id of keysOf(checks))
      element<HTMLInputElement>(id).addEventListener('change', ({ target }) => this.takePage(checks[id], (target as HTMLInputElement).checked, id));
    for (const id of keysOf(selects))
      element<HTMLSelectElement>(id).addEventListener('change', ({ target }) => this.takePage(selects[id], (target as HTMLSelectElement).value, id));
    element<HTMLSelectElement>('law').addEventListener('change', ({ target }) => this.takeLaw((target as HTMLSelectElement).value));
    this.show(settings, {});
  }

  setLaws(laws: readonly Law[]): void {
    this.laws = laws;
    element<HTMLSelectElement>('law').replaceChildren(...laws.map(optionOf));
    this.show(this.settings, this.used);
  }

  /** `used`: the effective values of the law's parameters, by name. */
  show(settings: Settings, used: Readonly<Record<string, number>>): void {
    this.settings = settings;
    this.used = used;
    const law = this.law();
    element<HTMLSelectElement>('law').value = settings.touch.law;
    this.parameters.show(law?.parameters ?? [], used, settings.touch.set, settings.materials.length);
    const isFlat = settings.page.view === 'flat' || element<HTMLSelectElement>('view').disabled;
    const noDepth = isFlat ? t('in 3D only') : settings.page.depthMode === 'plain' ? t('in a depth mode') : null;
    const noSound = settings.page.sound ? null : t('sound is off');
    const disabled: Record<string, string | null> = {
      volume: noSound,
      ...Object.fromEntries(soundSliders.map(({ id }) => [id, noSound])),
      'height-factor': this.isRelief ? null : t('reliefs only'),
      tilt: isFlat ? t('in 3D only') : null,
      [headsetSlider.id]: isFlat ? t('in 3D only') : null,
      ...Object.fromEntries(depthSliders.map(({ id }) => [id, noDepth])),
    };
    sliders.forEach(({ id, min, max, read, words }, k) => this.ranges[k]!.show({ min, max, value: read(settings), words, disabled: disabled[id] ?? null }));
    for (const id of keysOf(checks)) element<HTMLInputElement>(id).checked = settings.page[checks[id]];
    for (const id of keysOf(selects)) element<HTMLSelectElement>(id).value = settings.page[selects[id]];
    for (const id of ['depth-comfort', 'swap-eyes']) element<HTMLInputElement>(id).disabled = noDepth !== null;
    element<HTMLSelectElement>('depth-mode').disabled = isFlat;
    if (isFlat) element<HTMLSelectElement>('depth-mode').value = 'plain';
    // Without WebGL the preference is kept for another browser; meanwhile the view is from above.
    if (element<HTMLSelectElement>('view').disabled) element<HTMLSelectElement>('view').value = 'flat';
    // The preference for cells is kept for the next field; meanwhile the picture is shown.
    if (element<HTMLOptionElement>('surface-cells').disabled && settings.page.surface === 'cells') element<HTMLSelectElement>('surface').value = 'picture';
  }

  /** Only a relief's height can be changed. */
  offerHeight(isRelief: boolean): void {
    this.isRelief = isRelief;
    this.show(this.settings, this.used);
  }

  /** Only a field has cells to show. */
  offerCells(there: boolean): void {
    const option = element<HTMLOptionElement>('surface-cells');
    option.hidden = option.disabled = !there;
    this.show(this.settings, this.used);
  }

  law(): Law | undefined {
    return this.laws.find(({ name }) => name === this.settings.touch.law);
  }

  private takePage(key: keyof Preferences, value: boolean | string, id: string): void {
    this.take({ ...this.settings, page: { ...this.settings.page, [key]: value } }, id);
  }

  private takeLaw(name: string): void {
    const law = this.laws.find((one) => one.name === name);
    if (law) this.take({ ...this.settings, touch: withLaw(this.settings.touch, this.law(), law) }, 'law');
  }

  private take(settings: Settings, what: string): void {
    this.show(settings, { ...this.used, ...settings.touch.set });
    this.changed(settings, what);
  }
}
