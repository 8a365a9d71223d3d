// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import german from '../../languages/de.json';
import spanish from '../../languages/es.json';
import { format, rulesOf, type Values } from '../message';
import { reasons, sentWords, steps } from './sent';

/** The program's sources without tests, with the parts of each string joined. */
const code = readdirSync('../src/palpable', { recursive: true, encoding: 'utf8' })
  .filter((name) => /(?<!_test)\.cpp$/.test(name))
  .map((name) => readFileSync(`../src/palpable/${name}`, 'utf8'))
  .join('\n')
  .replace(/"\s*\n\s*"/g, '');

describe('what the program sends while a scene is made', () => {
  it('is listed as it stands in the program', () => {
    expect(steps.filter((step) => !code.includes(`"${step}"`))).toEqual([]);
    expect(reasons.filter((reason) => !code.includes(reason.replace(/\(?\{.*/, '')))).toEqual([]);
  });
  it.each(Object.entries({ german, spanish }))('has a text in %s', (_, catalogue) => {
    const known: Record<string, string> = catalogue;
    expect([...steps, ...reasons].filter((text) => !(text in known))).toEqual([]);
  });
  it('is found behind the name of a file', () => {
    const inGerman = (text: string, values: Values = {}) => format((german as Record<string, string>)[text]!, values, rulesOf('de'));
    expect(sentWords('a: b.png: is empty', inGerman)).toBe('a: b.png: ist leer');
    expect(sentWords('cancelled', inGerman)).toBe('abgebrochen');
    expect(sentWords('b.png: is damaged: its decoder crashed on it (signal 11)', inGerman)).toBe('b.png: ist beschädigt: Der Dekodierer ist daran abgestürzt (Signal 11)');
    expect(sentWords('x: another reason', inGerman)).toBe('x: another reason');
  });
});
