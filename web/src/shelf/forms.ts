// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// What a scene can be saved as, in plain words.

import { t } from '../language';

export interface Form {
  /** `save_as.form` in protocol.json. */
  form: string;
  words: string;
  /** Whether it is drawn on paper. */
  onPaper: boolean;
}

const all: Form[] = [
  { form: 'phone', words: t('to touch on a phone or tablet: one page (.html)'), onPaper: false },
  { form: 'swell', words: t('to print on swell paper, with names in braille (.svg)'), onPaper: true },
  { form: 'braille', words: t('to emboss in braille dots (.brf)'), onPaper: true },
  { form: 'pins', words: t('for a display of 60 × 40 pins (.pbm)'), onPaper: false },
  { form: 'words', words: t('to read: the map in words (.txt)'), onPaper: false },
  { form: 'print', words: t('to print in 3D (.stl)'), onPaper: false },
  { form: 'model', words: t('for other programs: a model with its colours (.glb)'), onPaper: false },
  { form: 'scene', words: t('for Palpable on another computer (.palp)'), onPaper: false },
];

/** Those of a scene, the likeliest first. A form that this page does not know is left out. */
export const formsOf = (names: readonly string[]): readonly Form[] => all.filter(({ form }) => names.includes(form));
