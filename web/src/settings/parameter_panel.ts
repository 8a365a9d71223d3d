// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The sliders and switches of a law's parameters, generated from the law's descriptor.
import { known, t } from '../language';
import { element } from '../dom';
import type { Parameter } from '../generated/protocol';
import { figure, RangeInput } from './range_input';

/** Metres are shown in millimetres. */
export function scaleOf({ unit }: Pick<Parameter, 'unit'>): { scale: number; unit: string } {
  return unit === 'm' ? { scale: 1000, unit: 'mm' } : { scale: 1, unit };
}

/** Whether it is 0 for no or 1 for yes. */
export function isSwitch({ unit }: Pick<Parameter, 'unit'>): boolean {
  return unit === 'yes or no';
}

const idOf = (name: string) => `parameter-${name}`;

export class ParameterPanel {
  private readonly container = element('parameters');
  private controls: { parameter: Parameter; range: RangeInput | null }[] = [];

  constructor(private readonly changed: (name: string, value: number) => void) {}

  /** `used`: the effective values; `set`: those that the user has set; by name. */
  show(parameters: readonly Parameter[], used: Readonly<Record<string, number>>, set: Readonly<Record<string, number>>, materials: number): void {
    if (JSON.stringify(parameters) !== JSON.stringify(this.controls.map(({ parameter }) => parameter))) this.build(parameters);
    for (const { parameter, range } of this.controls) {
      const { scale, unit } = scaleOf(parameter);
      const value = used[parameter.name] ?? parameter.min;
      if (range === null) {
        element<HTMLInputElement>(idOf(parameter.name)).checked = value > 0;
        continue;
      }
      const differs = set[parameter.name] === undefined && materials > 1 && isOfMaterials(parameter.name) ? `, ${t('each region its own')}` : '';
      range.show({
        min: figure(parameter.min * scale),
        max: figure(parameter.max * scale),
        value: value * scale,
        words: (shown) => `${t('{value} {unit}', { value: shown, unit }).trim()}${differs}`,
        disabled: null,
      });
    }
  }

  private build(parameters: readonly Parameter[]): void {
    this.container.replaceChildren(...parameters.map((parameter) => (isSwitch(parameter) ? this.switchElement(parameter) : sliderElement(parameter))));
    this.controls = parameters.map((parameter) => ({
      parameter,
      range: isSwitch(parameter) ? null : new RangeInput(idOf(parameter.name), (value) => this.changed(parameter.name, value / scaleOf(parameter).scale)),
    }));
  }

  private switchElement({ name, title }: Parameter): HTMLElement {
    const label = document.createElement('label');
    label.className = 'check';
    label.htmlFor = idOf(name);
    const input = document.createElement('input');
    input.type = 'checkbox';
    input.id = idOf(name);
    input.addEventListener('change', () => this.changed(name, input.checked ? 1 : 0));
    label.append(input, ` ${known(title)}`);
    return label;
  }
}

/** Whether every region has its own value of this parameter. */
function isOfMaterials(name: string): boolean {
  return ['stiffness_N_per_m', 'damping_Ns_per_m', 'static_friction', 'dynamic_friction'].includes(name);
}

function sliderElement({ name, title }: Parameter): HTMLElement {
  const row = document.createElement('div');
  row.className = 'slider';
  const label = document.createElement('label');
  label.htmlFor = idOf(name);
  label.textContent = known(title);
  const value = document.createElement('span');
  value.id = `${idOf(name)}-value`;
  value.setAttribute('aria-hidden', 'true');
  const input = document.createElement('input');
  input.type = 'range';
  input.id = idOf(name);
  row.append(label, ' ', value, input);
  return row;
}
