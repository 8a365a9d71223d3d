// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from 'node:fs';
import { afterEach, expect, it, vi } from 'vitest';
import type { Stage } from '../view/stage';
import { ViewActions } from './view_actions';

afterEach(() => vi.unstubAllGlobals());

it('says under the surface what the arrows do: they move the probe, or the picture', () => {
  const html = readFileSync(new URL('../../index.html', import.meta.url), 'utf8');
  const hint = /<p id="stage-keys"[^]*?<\/p>/.exec(html)?.[0] ?? '';
  expect(hint).toContain('id="arrows-move-probe">');
  expect(hint).toContain('id="arrows-move-picture" hidden>');
  const elements = new Map(['move-view', 'arrows-move-probe', 'arrows-move-picture'].map((id) => [id, { hidden: false, setAttribute: () => undefined }]));
  vi.stubGlobal('document', { getElementById: (id: string) => elements.get(id) ?? null });
  const stage = { isMovingView: false, setViewMoving: (moving: boolean) => (stage.isMovingView = moving) };
  const actions = new ViewActions(stage as unknown as Stage, () => undefined);
  const shown = () => ['arrows-move-probe', 'arrows-move-picture'].filter((id) => elements.get(id)?.hidden === false);
  actions.toggleMoving();
  expect(shown()).toEqual(['arrows-move-picture']);
  actions.toggleMoving();
  expect(shown()).toEqual(['arrows-move-probe']);
});
