// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Simulates a user who works by keyboard and hearing alone.
import type { CDPSession, Page } from 'playwright-core';

const ask = (session: CDPSession) => session.send('Accessibility.getFullAXTree');
type AxNode = Awaited<ReturnType<typeof ask>>['nodes'][number];

/** Whether a node of the accessibility tree has a property, as focused. */
export const has = (node: AxNode, name: string) => node.properties?.some((one) => one.name === name && one.value.value === true) ?? false;

/** The accessibility tree, and the text of its live region. */
export async function treeOf(session: CDPSession): Promise<{ nodes: AxNode[]; said: string }> {
  const { nodes } = await ask(session);
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  const textUnder = (id: string): string => {
    const node = byId.get(id);
    if (node === undefined) return '';
    if (node.role?.value === 'StaticText') return String(node.name?.value ?? '');
    return (node.childIds ?? []).map(textUnder).join('');
  };
  const status = nodes.find((node) => node.role?.value === 'status');
  return { nodes, said: status ? textUnder(status.nodeId) : '' };
}

export interface Node {
  role: string;
  name: string;
  focused: boolean;
}

/** A user of a screen reader: this class reads only the accessibility tree and presses only keys. */
export class Listener {
  private constructor(
    private readonly page: Page,
    private readonly session: CDPSession,
  ) {}
  static async at(page: Page): Promise<Listener> {
    return new Listener(page, await page.context().newCDPSession(page));
  }

  private async tree(): Promise<{ nodes: Node[]; said: string }> {
    const { nodes, said } = await treeOf(this.session);
    return {
      said,
      nodes: nodes.map((node) => ({
        role: String(node.role?.value ?? ''),
        name: String(node.name?.value ?? ''),
        focused: has(node, 'focused'),
      })),
    };
  }

  /** The focused element. */
  async focused(): Promise<Node> {
    const focused = (await this.tree()).nodes.filter((node) => node.focused && node.role !== 'RootWebArea');
    return focused[focused.length - 1] ?? { role: '', name: '', focused: false };
  }

  /** Presses Tab (or Shift+Tab) until a control of this role, and with this name, has the focus. */
  async tabTo(role: string, name = /./, key = 'Tab'): Promise<Node> {
    const met: string[] = [];
    for (let k = 0; k < 60; ++k) {
      await this.page.keyboard.press(key);
      const now = await this.focused();
      if (now.role === role && name.test(now.name)) return now;
      met.push(`${now.role} ${now.name}`);
    }
    throw new Error(`${key} never came to ${role} ${name}; it came to ${met.join(', ')}`);
  }

  /** Waits until a matching sentence is said. */
  async hears(about: RegExp): Promise<RegExpExecArray> {
    const heard = await this.within(150, about);
    if (heard instanceof Array) return heard;
    throw new Error(`nothing was said about ${about}; last: ${heard}`);
  }
  /** The matching sentence, or what else was said last after so many tenths of a second. */
  private async within(tenths: number, about: RegExp): Promise<RegExpExecArray | string> {
    let said = '';
    for (let k = 0; k < tenths; ++k) {
      ({ said } = await this.tree());
      const match = about.exec(said);
      if (match) return match;
      await this.page.waitForTimeout(100);
    }
    return said;
  }

  /** Does something again and again until a matching sentence is said. A busy machine joins quick steps to one, whose
   * places between are not felt; a person then tries again. */
  async tries(deed: () => Promise<unknown>, about: RegExp): Promise<RegExpExecArray> {
    let heard: RegExpExecArray | string = '';
    for (let k = 0; k < 12; ++k) {
      await deed();
      heard = await this.within(30, about);
      if (heard instanceof Array) return heard;
    }
    throw new Error(`nothing was said about ${about} after 12 tries; last: ${heard as string}`);
  }

  /** Presses a key and waits for something to be said that fits: something new, or, after the longest wait between two
   * sentences, the same again. */
  async ask(key: string, about: RegExp): Promise<RegExpExecArray> {
    await this.page.waitForTimeout(1100);
    const before = (await this.tree()).said;
    await this.page.keyboard.press(key);
    for (let k = 0; k < 100; ++k) {
      const { said } = await this.tree();
      const match = said !== before || k >= 15 ? about.exec(said) : null;
      if (match) return match;
      await this.page.waitForTimeout(100);
    }
    throw new Error(`after ${key} nothing was said about ${about}; last: ${(await this.tree()).said}`);
  }

  async walk(millimetres: number, positive: string, negative: string): Promise<void> {
    const key = millimetres > 0 ? positive : negative;
    const whole = Math.abs(Math.round(millimetres));
    for (let k = 0; k < Math.floor(whole / 5); ++k) await this.page.keyboard.press(`Shift+${key}`);
    for (let k = 0; k < whole % 5; ++k) await this.page.keyboard.press(key);
  }
}
