// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import { afterEach, expect, it, vi } from 'vitest';
import type { Stage } from '../view/stage';
import { ViewActions } from './view_actions';

afterEach(() => vi.unstubAllGlobals());

it('says under the surface what the arrows do: they move the probe, the picture or, in a depth mode, the head', () => {
  const html = readFileSync(new URL('../../index.html', import.meta.url), 'utf8');
  const hint = /<p id="stage-keys"[^]*?<\/p>/.exec(html)?.[0] ?? '';
  const hints = ['arrows-move-probe', 'arrows-move-picture', 'arrows-move-head'];
  hints.forEach((id, k) => expect(hint).toContain(`id="${id}"${k === 0 ? '' : ' hidden'}>`));
  const elements = new Map(['move-view', 'move-head', ...hints].map((id) => [id, { hidden: false, setAttribute: () => undefined }]));
  vi.stubGlobal('document', { getElementById: (id: string) => elements.get(id) ?? null });
  const stage = { moving: 'probe', fit: null as object | null, setMoving: (moves: string) => (stage.moving = moves) };
  const said: string[] = [];
  const actions = new ViewActions(stage as unknown as Stage, (words) => said.push(words));
  const shown = () => hints.filter((id) => elements.get(id)?.hidden === false);
  actions.toggleMoving();
  expect(shown()).toEqual(['arrows-move-picture']);
  actions.toggleHead();
  expect(shown()).toEqual(['arrows-move-picture']);
  expect(said.at(-1)).toMatch(/in a depth mode only/);
  stage.fit = {};
  actions.toggleHead();
  expect(shown()).toEqual(['arrows-move-head']);
  actions.follow();
  expect(shown()).toEqual(['arrows-move-head']);
  stage.fit = null;
  actions.follow();
  expect(shown()).toEqual(['arrows-move-probe']);
});
