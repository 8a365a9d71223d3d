// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The panel for the material of one region.
import { t } from '../language';
import { element } from '../dom';
import { pictureForms, type Law } from '../generated/protocol';
import type { Material } from './materials';
import { figure, RangeInput } from './range_input';
import type { Settings } from './settings';

type Numbers = { [K in keyof Material]: Material[K] extends number ? K : never }[keyof Material];

interface Slider {
  id: string;
  key: Numbers;
  /** Factor from the stored value to the slider's value. */
  scale: number;
  unit: string;
  /** The slider's range. */
  min: number;
  max: number;
  texture?: true;
}

const sliders: Slider[] = [
  { id: 'material-stiffness', key: 'stiffness_N_per_m', scale: 1, unit: 'N/m', min: 20, max: 2000 },
  { id: 'material-damping', key: 'damping_Ns_per_m', scale: 1, unit: 'N·s/m', min: 0, max: 5 },
  { id: 'material-friction', key: 'friction', scale: 1, unit: '', min: 0, max: 1 },
  { id: 'material-stickiness', key: 'stickiness', scale: 100, unit: '%', min: 0, max: 100 },
  { id: 'texture-pitch', key: 'pitch_m', scale: 1e3, unit: 'mm', min: 0.5, max: 20, texture: true },
  { id: 'texture-height', key: 'height_m', scale: 1e6, unit: 'µm', min: 0, max: 500, texture: true },
  { id: 'texture-angle', key: 'angle_deg', scale: 1, unit: '°', min: -90, max: 90, texture: true },
];

/** The size of the picture that a texture was made from, in addition to its pitch. */
function sideOf({ texture, pitch_m }: Material, key: Numbers): string {
  return texture === 'picture' && key === 'pitch_m' ? `, ${t('picture {side} mm', { side: figure(pitch_m * pictureForms * 1e3) })}` : '';
}

export class MaterialPanel {
  private settings: Settings;
  private law: Law | undefined;
  private readonly ranges: RangeInput[];
  private readonly region = element<HTMLSelectElement>('region');
  private readonly texture = element<HTMLSelectElement>('texture');
  /** Regions whose texture is or was from a picture, which only the program has. */
  private readonly pictured = new Set<number>();

  constructor(
    settings: Settings,
    private readonly changed: (settings: Settings, what: string) => void,
  ) {
    this.settings = settings;
    this.ranges = sliders.map(({ id, key, scale }) => new RangeInput(id, (value) => this.take({ [key]: value / scale }, id)));
    this.texture.addEventListener('change', () => this.take({ texture: this.texture.value }, 'texture'));
    this.region.addEventListener('change', () => this.show(this.settings, this.law));
  }

  show(settings: Settings, law: Law | undefined): void {
    this.settings = settings;
    this.law = law;
    const { materials } = settings;
    element('material').hidden = materials.length === 0 || !law?.has_materials;
    if (this.region.options.length !== materials.length || materials.some(({ name }, k) => this.region.options[k]?.text !== name)) {
      const chosen = Math.min(Math.max(this.region.selectedIndex, 0), materials.length - 1);
      this.region.replaceChildren(...materials.map(({ name }, label) => new Option(name, String(label))));
      this.region.selectedIndex = chosen;
    }
    const material = materials[this.chosen()];
    if (material !== undefined) this.showOne(material);
  }

  /** Selects the region with this label for editing; false if there is none. */
  choose(label: number): boolean {
    if (this.settings.materials[label] === undefined) return false;
    this.region.selectedIndex = label;
    this.show(this.settings, this.law);
    return true;
  }

  name(): string {
    return this.settings.materials[this.chosen()]?.name ?? '';
  }

  private showOne(material: Material): void {
    const canTexture = this.law?.has_texture ?? false;
    this.texture.disabled = !canTexture;
    const ofPicture = this.texture.querySelector<HTMLOptionElement>('option[value=picture]');
    if (material.texture === 'picture') this.pictured.add(this.chosen());
    if (ofPicture !== null) ofPicture.disabled = !this.pictured.has(this.chosen());
    this.texture.value = material.texture;
    sliders.forEach(({ key, scale, unit, min, max, texture }, k) => {
      const noTexture = canTexture ? t('no texture') : t('not in this law');
      const disabled = texture === true && (!canTexture || material.texture === 'none') ? noTexture : null;
      const words = (value: number) => t('{value} {unit}', { value, unit }).trim() + sideOf(material, key);
      this.ranges[k]!.show({ min, max, value: material[key] * scale, words, disabled });
    });
  }

  private chosen(): number {
    return Math.max(this.region.selectedIndex, 0);
  }

  private take(wish: Partial<Material>, what: string): void {
    const label = this.chosen();
    const materials = this.settings.materials.map((material, k) => (k === label ? { ...material, ...wish } : material));
    this.changed({ ...this.settings, materials }, `${what} ${label}`);
  }
}
