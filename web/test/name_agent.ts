// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A simulated blind person who looks for names: reads the accessibility tree and announcements alone, presses keys alone.
import type { CDPSession, Page } from 'playwright-core';
import { has, treeOf } from './listener';

interface Heard {
  said: string;
  /** The option that is selected in a list box which has the focus; null: none. */
  option: string | null;
  focusedRole: string;
  /** Millimetres of an arrow key, without and with Shift, as the hint of the surface says. */
  steps: [number, number];
}

export interface Search {
  reached: boolean;
  presses: number;
  /** What was heard last. */
  last: string;
}

/** A pause between two announcements (ms), with a margin. */
const pause = 1150;

export class NameAgent {
  private presses = 0;
  private constructor(
    private readonly page: Page,
    private readonly session: CDPSession,
  ) {}
  static async at(page: Page): Promise<NameAgent> {
    return new NameAgent(page, await page.context().newCDPSession(page));
  }

  async hear(): Promise<Heard> {
    const { nodes, said } = await treeOf(this.session);
    const focused = nodes.filter((node) => has(node, 'focused') && node.role?.value !== 'RootWebArea');
    const stage = nodes.find((node) => node.role?.value === 'application');
    const selected = nodes.find((node) => node.role?.value === 'option' && has(node, 'selected'));
    const steps = /move ([\d.]+)\s*mm,?\s*with Shift ([\d.]+)\s*mm/.exec(String(stage?.description?.value ?? '').replace(/\s+/g, ' '));
    return {
      said,
      option: selected ? String(selected.name?.value ?? '') : null,
      focusedRole: String(focused[focused.length - 1]?.role?.value ?? ''),
      steps: steps ? [Number(steps[1]), Number(steps[2])] : [1, 5],
    };
  }

  private async press(key: string, times = 1): Promise<void> {
    for (let k = 0; k < times; ++k) await this.page.keyboard.press(key);
    this.presses += times;
  }

  private async until(fits: (heard: Heard) => boolean, most = 10_000): Promise<Heard> {
    const end = Date.now() + most;
    for (;;) {
      const heard = await this.hear();
      if (fits(heard) || Date.now() > end) return heard;
      await this.page.waitForTimeout(60);
    }
  }

  /** Looks for a name from where the probe is, until it is said to be there. */
  async find(name: string): Promise<Search> {
    this.presses = 0;
    await this.press('l');
    await this.until(({ option, focusedRole }) => option !== null && /listbox|option/i.test(focusedRole));
    const is = (option: string | null) => option !== null && (option === name || option.startsWith(`${name},`));
    // The list box selects what begins with the typed letters.
    for (const letter of name) {
      if (is((await this.hear()).option)) break;
      await this.press(letter === ' ' ? 'Space' : letter);
    }
    const { option } = await this.until((heard) => is(heard.option), 3000);
    if (!is(option)) {
      await this.press('Escape');
      return { reached: false, presses: this.presses, last: `the list says ${option}` };
    }
    await this.press('Enter');
    return this.follow(name);
  }

  /** Follows the words. */
  private async follow(name: string): Promise<Search> {
    const about = new RegExp(`(${escaped(name)}: .*millimetre|Here: ${escaped(name)}|No longer)`, 'i');
    let { said, steps } = await this.until((heard) => about.test(heard.said));
    for (let round = 0; round < 12 && this.presses < 150; ++round) {
      if (said.includes(`Here: ${name}`)) return { reached: true, presses: this.presses, last: said };
      const away = offset(said);
      if (away === null) break;
      const [fine, coarse] = steps;
      for (const [distance, positive, negative] of [[away.x, 'ArrowRight', 'ArrowLeft'], [away.y, 'ArrowUp', 'ArrowDown']] as const) {
        const key = distance > 0 ? positive : negative;
        const long = Math.round(Math.abs(distance) / coarse);
        await this.press(`Shift+${key}`, long);
        // Near the place short steps are enough, and cheaper than to go back.
        const rest = distance - Math.sign(distance) * long * coarse;
        if (long === 0 || Math.abs(rest) > 2 * fine) await this.press(rest > 0 ? positive : negative, Math.round(Math.abs(rest) / fine));
      }
      // What is said next may still be about an earlier step.
      await this.page.waitForTimeout(pause);
      const before = said;
      ({ said } = await this.until((heard) => heard.said !== before && about.test(heard.said), 4000));
    }
    return { reached: said.includes(`Here: ${name}`), presses: this.presses, last: said };
  }

  /** Asks where it is, and hears whether that is the place of a name. */
  async isAt(name: string): Promise<boolean> {
    await this.page.waitForTimeout(pause);
    await this.page.keyboard.press('p');
    const { said } = await this.until((heard) => /from the middle|at the middle/.test(heard.said));
    return said.toLowerCase().includes(name.toLowerCase());
  }
}

const escaped = (text: string) => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

/** Millimetres to the right and up that a sentence tells. */
function offset(said: string): { x: number; y: number } | null {
  const away = { x: 0, y: 0 };
  let found = false;
  for (const [, amount, unit, way] of said.matchAll(/([\d.]+) (millimetres?|metres?) (left|right|up|down)/g)) {
    found = true;
    const value = Number(amount) * (unit!.startsWith('metre') ? 1000 : 1);
    if (way === 'right') away.x += value;
    if (way === 'left') away.x -= value;
    if (way === 'up') away.y += value;
    if (way === 'down') away.y -= value;
  }
  return found ? away : null;
}
