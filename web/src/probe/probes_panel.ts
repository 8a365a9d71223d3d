// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The panel of several probes: the selected one, and the force on each.
import { fixed, t } from '../language';
import { element } from '../dom';
import type { ProbeState } from '../generated/protocol';
import { newtons } from './probes';
import { millimetreFigure } from '../figures';

export interface ProbesTarget {
  choose(probe: number): void;
  add(): void;
  take(): void;
  describeProbes(): void;
}

export class ProbesPanel {
  private readonly choice = element<HTMLSelectElement>('probe');
  private readonly rows = element<HTMLTableSectionElement>('probe-rows');
  private offered = '';

  constructor(target: ProbesTarget) {
    this.choice.addEventListener('change', () => target.choose(Number(this.choice.value)));
    element('probe-add').addEventListener('click', () => target.add());
    element('probe-take').addEventListener('click', () => target.take());
    element('probe-all').addEventListener('click', () => target.describeProbes());
  }

  /** `numbers`: those that can be selected here. */
  offer(numbers: readonly number[], chosen: number, canAdd: boolean): void {
    element<HTMLButtonElement>('probe-take').disabled = chosen === 0;
    element<HTMLButtonElement>('probe-add').disabled = !canAdd;
    if (this.offered !== numbers.join()) {
      this.offered = numbers.join();
      this.choice.replaceChildren(...numbers.map((probe) => new Option(probe === 0 ? t('1, the first') : String(probe + 1), String(probe))));
    }
    this.choice.value = String(chosen);
  }

  /** One row per probe if there are several. Cells are reused, so that a reading cursor stays in place. */
  show(states: readonly ProbeState[], scale = 1): void {
    element('probe-table').hidden = states.length < 2;
    while (this.rows.rows.length > states.length) this.rows.deleteRow(-1);
    while (this.rows.rows.length < states.length) this.rows.append(emptyRow());
    states.forEach((one, k) => {
      const figures = [one.probe + 1, t('{x}, {y}', { x: millimetreFigure(one.x_m, scale), y: millimetreFigure(one.y_m, scale) }), millimetreFigure(one.surface_m, scale), fixed(newtons(one), 2)];
      figures.forEach((figure, column) => {
        const cell = this.rows.rows[k]!.cells[column]!;
        if (cell.textContent !== String(figure)) cell.textContent = String(figure);
      });
    });
  }
}

function emptyRow(): HTMLTableRowElement {
  const row = document.createElement('tr');
  const head = document.createElement('th');
  head.scope = 'row';
  row.append(head);
  for (let k = 0; k < 3; ++k) row.insertCell();
  return row;
}
