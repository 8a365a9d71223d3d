// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The texts of the HTML. A text with elements in it is one message: {0} stands for its first element and so on.
import { language, t } from './language';

const attributes = ['aria-label', 'aria-roledescription', 'title', 'placeholder', 'alt', 'label', 'data-empty', 'data-when-paused'];

const clean = (text: string): string => text.replace(/\s+/g, ' ');
const hasWords = (text: string | null): boolean => /\p{L}{2}/u.test(text ?? '');

/** An element's own text as a message, and the elements that stand in it; null if it has none. */
export function messageOf(element: Element): { message: string; inside: Element[] } | null {
  const nodes = [...element.childNodes].filter(({ nodeType }) => nodeType === 1 || nodeType === 3);
  if (!nodes.some((node) => node.nodeType === 3 && hasWords(node.nodeValue))) return null;
  const inside: Element[] = [];
  const parts = nodes.map((node) => (node.nodeType === 3 ? (node.nodeValue ?? '') : `{${inside.push(node as Element) - 1}}`));
  return { message: clean(parts.join('')).trim(), inside };
}

function translateText(element: Element): void {
  const own = messageOf(element);
  if (own === null) return;
  const marks = Object.fromEntries(own.inside.map((_, k) => [k, `\u0001${k}\u0001`]));
  const parts = t(own.message, marks).split('\u0001');
  element.replaceChildren(...parts.map((part, k) => (k % 2 === 1 ? own.inside[Number(part)]! : part)));
}

/** Puts the page's HTML into its language. */
export function translatePage(root: Element = document.documentElement): void {
  if (language === 'en') return;
  root.setAttribute('lang', language);
  for (const element of root.querySelectorAll('*')) {
    if (element.localName === 'script' || element.localName === 'style') continue;
    for (const name of attributes) {
      const value = element.getAttribute(name);
      if (hasWords(value)) element.setAttribute(name, t(clean(value!)));
    }
    translateText(element);
  }
}
