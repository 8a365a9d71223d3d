// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The catalogues are complete, and no sentence of the pages is outside of them.
import { relative } from 'node:path';
import { describe, expect, it } from 'vitest';
import german from '../languages/de.json';
import spanish from '../languages/es.json';
import germanProgram from '../languages/program/de.json';
import spanishProgram from '../languages/program/es.json';
import { allMessages, programMessages, sources, stringsOf } from '../scripts/messages.mjs';
import { chosenLanguage, firstKnown } from './language';
import { argumentsOf, format, rulesOf } from './message';

const catalogues: Record<string, Record<string, string>> = { de: german, es: spanish };
const messages = allMessages();

/** Two words, or one that begins with a capital: what a person may read. */
const looksLikeWords = (text: string) => /\p{L}{2,}[^\p{L}]* \p{L}/u.test(text) || /^\p{Lu}\p{Ll}/u.test(text) || /\{\} \p{L}/u.test(text);
/** Strings that nobody reads: of the browser, of formats, of other programs, and errors of our own code. */
const notForReading: [file: RegExp, text: RegExp][] = [
  [/./, /^(Home|End|Delete|Backspace|Escape|Enter|Tab|Arrow\w*|Page(Down|Up)|Content-Type|Files|use strict)$/],
  [/./, /^\((prefers|forced|pointer|hover)-?/],
  [/./, /Path=\/; SameSite=Strict/],
  [/./, /^(asked where|no headset|no finder|no WebAssembly|no WebXR|too slow|looked for|yes or no|Control|NotAllowedError|SecurityError|NotFoundError|OverconstrainedError|InvalidStateError|NotSupportedError)$/],
  [/codec|dom\.ts|message\.ts|touch_module|depth_picture|second_view|qr_picture|trace_files|head\/finder|instrument/, /./],
  [/language\.ts/, /^(English|Deutsch|Español)$/],
  [/connection\.ts/, /^(the session has ended|another scene was opened|shown out|opened in another tab)$/],
  [/marble3d|view_flat|plot/, /px /],
  [/headset\/headset\.ts/, /^it has ended meanwhile$/],
];

/** The places of fmt's arguments. */
const placesOf = (message: string) => [...message.matchAll(/\{[^}]*\}/g)].map(([place]) => place).sort();

describe('the catalogues', () => {
  it.each(Object.keys(catalogues))('%s holds every message, with the same arguments', (language) => {
    const catalogue = catalogues[language]!;
    expect(messages.filter((message) => !(message in catalogue))).toEqual([]);
    const differing = Object.entries(catalogue).filter(([english, text]) => argumentsOf(english).join() !== argumentsOf(text).join());
    expect(differing).toEqual([]);
  });

  it('hold the same messages', () => {
    expect(Object.keys(german).sort()).toEqual(Object.keys(spanish).sort());
    expect(Object.keys(germanProgram).sort()).toEqual(Object.keys(spanishProgram).sort());
  });

  it.each(Object.entries({ de: germanProgram, es: spanishProgram }))('%s has the arguments of the program’s sentences', (_, catalogue) => {
    const differing = Object.entries(catalogue).filter(([english, text]) => placesOf(english).join() !== placesOf(text).join());
    expect(differing).toEqual([]);
  });

  it('hold every sentence of the program that is one', () => expect(programMessages().filter((message) => !(message in germanProgram))).toEqual([]));

  it('hold every sentence of the sources', () => {
    const outside = sources().flatMap((path) =>
      stringsOf(path)
        .filter(({ text, isMessage }) => !isMessage && looksLikeWords(text) && !(text in german))
        .filter(({ text }) => !notForReading.some(([file, pattern]) => file.test(path) && pattern.test(text)))
        .map(({ text, line }) => `${relative('.', path)}:${line}: ${text}`),
    );
    expect(outside).toEqual([]);
  });
});

describe('a message', () => {
  const rules = rulesOf('de');
  it('takes the form of its number, and figures of its language', () => {
    const message = '{count, plural, one {# Meter von {name}} other {# Meter}}!';
    expect(format(message, { count: 1, name: 'hier' }, rules)).toBe('1 Meter von hier!');
    expect(format(message, { count: 1.5, name: 'hier' }, rules)).toBe('1,5 Meter!');
    expect(format('{x}', { x: 12345.25 }, rulesOf('en'))).toBe('12345.25');
  });
  it('shows values as they are, whatever they contain', () => expect(format('a {name}', { name: '{x} #' }, rules)).toBe('a {x} #'));
  it('is refused where it is malformed', () => {
    for (const wrong of ['{', '{count, plural, one {x}', '{a b}']) expect(() => argumentsOf(wrong)).toThrow();
    expect(() => format('{a}', {}, rules)).toThrow();
  });
});

describe('the language', () => {
  it('is the first that the page has', () => {
    expect(firstKnown(['fr', 'es-MX', 'de'])).toBe('es');
    expect(firstKnown(['fr'])).toBe('en');
  });
  it('is chosen by a cookie, or behind the # of a file', () => {
    expect(chosenLanguage('a=b; palpable-language=de', '')).toBe('de');
    expect(chosenLanguage('', '#of-list&language=es')).toBe('es');
    expect(chosenLanguage('palpable-language=xx', '#language=')).toBe(null);
  });
});
