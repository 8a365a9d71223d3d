// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A page that is a file of its own (`palpable export SCENE -o x.html`).
import { t } from '../language';
import { element } from '../dom';
import { noProgress } from '../guide/memory';
import { TouchPage } from '../home/touch_page';
import { defaults } from '../settings/preferences';
import { offerLanguages } from '../language_choice';
import { translatePage } from '../static_text';
import { isComplete, picture, unpacked } from './embedded';
import { LocalProgram } from './local_program';
import { TouchModule, type Row } from './touch_module';

declare global {
  interface Window {
    /** For other programs: the forces that `palpable probe` gives for these rows. */
    palpable?: { probe(rows: readonly Row[], options?: object): Promise<number[][]> };
  }
}

const damaged = t('This file is damaged: its scene cannot be read. Get it again from where it came from.');
const tooOld = t('This browser is too old for this page: it needs WebAssembly and DecompressionStream.');

async function openTouch(): Promise<TouchModule> {
  if (typeof WebAssembly === 'undefined' || typeof DecompressionStream === 'undefined') throw new Error(tooOld);
  const [wasm, scene, pixels, second] = await Promise.all([unpacked('data-touch'), unpacked('data-scene'), picture('data-picture'), picture('data-second')]).catch(() => {
    throw new Error(damaged);
  });
  const touch = await TouchModule.load(wasm);
  touch.open(scene, pixels, second);
  return touch;
}

function start(): void {
  translatePage();
  offerLanguages();
  const opened = openTouch();
  window.palpable = { probe: async (rows, options = {}) => (await opened).probe(rows, options) };
  // There is no other file to save to, and nothing is kept in a browser that belongs to somebody else's address.
  element('save').hidden = true;
  element('stored-data').textContent = t('Nothing is stored, and no data leaves this page: it asks no address for anything.');
  new TouchPage(
    (receiver) => new LocalProgram(receiver, opened),
    // From above: quick on every phone. In 3D is a setting.
    { read: () => ({ ...defaults, view: 'flat' }), keep: () => undefined },
    // Not offered at every opening, since nothing is kept; "Guided start" begins it.
    { read: () => ({ ...noProgress, offered: true }), keep: () => undefined },
  ).start();
}

if (isComplete()) start();
