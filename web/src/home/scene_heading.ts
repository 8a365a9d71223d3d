// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What the page shows and calls of the scene: its name, the maker's description, the name of what is touched.
import { element } from '../dom';
import type { Scene } from '../generated/protocol';

export function showHeading({ name, description }: Pick<Scene, 'name' | 'description'>): void {
  element('scene-name').textContent = name;
  const line = element('scene-description');
  line.textContent = description;
  line.title = description ?? '';
  line.hidden = description === null;
  document.title = `${name} – Palpable`;
}

/** The program has not let this page in, or has not answered. */
export function showNoScene(): void {
  element('scene-name').textContent = 'No scene';
}

export const stageLabel = ({ kind, name }: Pick<Scene, 'kind' | 'name'>) => `${kind === 'contours' ? 'Lines' : 'Surface'} of ${name} to touch`;
