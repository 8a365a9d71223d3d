// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A slider that holds exactly the value that it shows and says.
import { element } from '../dom';

export interface RangeState {
  min: number;
  max: number;
  value: number;
  /** The text beside it, also for screen readers. */
  words(value: number): string;
  /** The reason why it is disabled; null if it is enabled. */
  disabled: string | null;
}

/** Rounds to four significant digits. */
export function figure(value: number): number {
  return Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(4));
}

/** The smallest of 1, 2, 5, 10, … that is at least a hundredth of the range. */
export function stepOf(min: number, max: number): number {
  const least = (max - min) / 100;
  if (!(least > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(least));
  return figure(power * ([1, 2, 5, 10].find((factor) => factor * power >= least * (1 - 1e-9)) ?? 10));
}

/** The nearest multiple of the step within the range. */
export function snapped(value: number, min: number, max: number): number {
  const step = stepOf(min, max);
  return figure(Math.min(max, Math.max(min, Math.round(value / step) * step)));
}

/** The slider's value after a key; null if the key does not move it. */
export function keyValue(key: string, value: number, min: number, max: number): number | null {
  const step = stepOf(min, max);
  const steps: Record<string, number> = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
  if (key === 'Home') return figure(min);
  if (key === 'End') return figure(max);
  const count = steps[key];
  return count === undefined ? null : snapped(value + count * step, min, max);
}

/** `id` names the input, `id`-value the text beside it. */
export class RangeInput {
  private readonly input: HTMLInputElement;
  private state: RangeState | null = null;

  constructor(
    private readonly id: string,
    changed: (value: number) => void,
  ) {
    this.input = element<HTMLInputElement>(id);
    this.input.step = 'any';
    const take = (value: number) => {
      this.put(value);
      changed(value);
    };
    this.input.addEventListener('input', () => {
      if (this.state) take(snapped(this.input.valueAsNumber, this.state.min, this.state.max));
    });
    this.input.addEventListener('keydown', (event) => {
      if (this.state === null || event.ctrlKey || event.altKey || event.metaKey) return;
      const value = keyValue(event.key, this.input.valueAsNumber, this.state.min, this.state.max);
      if (value === null) return;
      event.preventDefault();
      if (value !== this.input.valueAsNumber) take(value);
    });
  }

  show(state: RangeState): void {
    this.state = state;
    this.input.disabled = state.disabled !== null;
    // A value outside the slider's range widens the range.
    this.input.min = String(Math.min(state.min, state.value));
    this.input.max = String(Math.max(state.max, state.value));
    this.put(figure(state.value));
  }

  private put(value: number): void {
    if (this.state === null) return;
    const words = this.state.disabled ?? this.state.words(value);
    this.input.value = String(value);
    this.input.setAttribute('aria-valuetext', words);
    element(`${this.id}-value`).textContent = words;
  }
}
