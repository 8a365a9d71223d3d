// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import german from '../languages/de.json';
import spanish from '../languages/es.json';
import germanProgram from '../languages/program/de.json';
import spanishProgram from '../languages/program/es.json';
import { isEnglish } from './sent_language';

const isSentence = (text: string) => (text.match(/\p{L}{2,}/gu) ?? []).length >= 5;

/** Without the words of the message format. */
const withoutForms = (text: string) => text.replace(/\w+, plural, one|\bother(?= \{)/g, '');

describe.each(Object.entries({ de: { ...german, ...germanProgram }, es: { ...spanish, ...spanishProgram } }) as ['de' | 'es', Record<string, string>][])('on a page in %s', (language, catalogue) => {
  it('no translated text is taken for English', () => expect(Object.values(catalogue).map(withoutForms).filter((text) => isEnglish(text, language))).toEqual([]));

  it('nearly all English sentences are', () => {
    const sentences = Object.keys(catalogue).filter(isSentence);
    const missed = sentences.filter((text) => !isEnglish(text, language));
    expect(missed.length / sentences.length, missed.join('\n')).toBeLessThan(0.05);
  });

  it('refusals of files are', () => {
    for (const refusal of ['Straße und Platz.png: the two pictures have different sizes', 'la casa.palp: is damaged: the checksum does not match', 'leer.stl: the mesh has no triangles that can be used'])
      expect(isEnglish(refusal, language), refusal).toBe(true);
  });
});

it('on an English page nothing is marked', () => expect(isEnglish('the file is damaged', 'en')).toBe(false));
