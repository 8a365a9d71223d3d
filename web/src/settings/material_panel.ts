// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The panel for materials: how one region of the scene answers a touch.
import { element } from '../dom';
import { shown, type Settings } from './controls';
import { pictureForms, type Law } from '../generated/protocol';
import type { Material } from './materials';

type Numbers = { [K in keyof Material]: Material[K] extends number ? K : never }[keyof Material];

interface Slider {
  id: string;
  key: Numbers;
  /** Of what is kept, to what the slider shows. */
  scale: number;
  unit: string;
  texture?: true;
}

const sliders: Slider[] = [
  { id: 'material-stiffness', key: 'stiffness_N_per_m', scale: 1, unit: 'N/m' },
  { id: 'material-damping', key: 'damping_Ns_per_m', scale: 1, unit: 'N·s/m' },
  { id: 'material-friction', key: 'friction', scale: 1, unit: '' },
  { id: 'material-stickiness', key: 'stickiness', scale: 100, unit: '%' },
  { id: 'texture-pitch', key: 'pitch_m', scale: 1e3, unit: 'mm', texture: true },
  { id: 'texture-height', key: 'height_m', scale: 1e6, unit: 'µm', texture: true },
  { id: 'texture-angle', key: 'angle_deg', scale: 1, unit: '°', texture: true },
];

/** The size of the picture that a texture was made from: more than its pitch says. */
function sideOf({ texture, pitch_m }: Material, key: Numbers): string {
  return texture === 'picture' && key === 'pitch_m' ? `, picture ${shown(pitch_m * pictureForms * 1e3)} mm` : '';
}

export class MaterialPanel {
  private settings: Settings;
  private law: Law | undefined;
  private readonly region = element<HTMLSelectElement>('region');
  private readonly texture = element<HTMLSelectElement>('texture');
  /** Regions whose texture is or was from a picture: only the program has it. */
  private readonly pictured = new Set<number>();

  constructor(
    settings: Settings,
    private readonly changed: (settings: Settings, what: string) => void,
  ) {
    this.settings = settings;
    for (const { id, key, scale } of sliders)
      element<HTMLInputElement>(id).addEventListener('input', ({ target }) =>
        this.take({ [key]: (target as HTMLInputElement).valueAsNumber / scale }, id),
      );
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

  /** Edits the region with this label from now on; false if there is none. */
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
    for (const { id, key, scale, unit, texture } of sliders) {
      const input = element<HTMLInputElement>(id);
      input.disabled = texture === true && (!canTexture || material.texture === 'none');
      const value = material[key] * scale;
      input.value = String(value);
      const words = input.disabled ? (canTexture ? 'no texture' : 'not in this law') : `${shown(value)} ${unit}${sideOf(material, key)}`.trim();
      input.setAttribute('aria-valuetext', words);
      element(`${id}-value`).textContent = words;
    }
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
