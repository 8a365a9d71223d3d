// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The scene's heading: its name, the maker's description, and the label of the stage.
import { known, t } from '../language';
import { element } from '../dom';
import type { Scene } from '../generated/protocol';

/** The first sentence of a text, and what comes after it: a short text is not taken apart. */
export function shortForm(text: string): { short: string; rest: string } {
  const fitsOneLine = 90;
  if (text.length <= fitsOneLine) return { short: text, rest: '' };
  const end = /[.!?](?=\s)/.exec(text);
  if (end === null) return { short: text, rest: '' };
  return { short: text.slice(0, end.index + 1), rest: text.slice(end.index + 1).trim() };
}

export function showHeading({ name: given, description }: Pick<Scene, 'name' | 'description'>): void {
  const name = known(given);
  element('scene-name').textContent = name;
  const { short, rest } = shortForm(known(description ?? ''));
  element('scene-short').textContent = short;
  element('scene-rest').textContent = rest;
  element('scene-more').hidden = rest === '';
  element('scene-description').hidden = description === null;
  document.title = `${name} – Palpable`;
}

/** For a page without a scene: refused, or not connected. */
export function showNoScene(): void {
  element('scene-name').textContent = t('No scene');
}

export function stageLabel({ kind, name }: Pick<Scene, 'kind' | 'name'>): string {
  const values = { name: known(name) };
  return kind === 'contours' ? t('Lines of {name} to touch', values) : t('Surface of {name} to touch', values);
}

/** The link to the scenes: to the home page of the program, or from one of a demo's files, which its list opens so, to the list. */
export function showWayBack(hasHome: boolean): void {
  const link = element<HTMLAnchorElement>('all-scenes');
  const isOfList = location.hash.split('&')[0] === '#of-list';
  link.hidden = !hasHome && !isOfList;
  if (!link.hidden) link.setAttribute('href', hasHome ? '/' : 'index.html');
}
