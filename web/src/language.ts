// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The language of the page. A message is identified by its English text (docs/adr/0013); languages/*.json hold the others.
// The language is chosen when the page is loaded and does not change until it is loaded again.
import german from '../languages/de.json';
import spanish from '../languages/es.json';
import { format, rulesOf, type Values } from './message';

export const languages = { en: 'English', de: 'Deutsch', es: 'Español' } as const;
export type Language = keyof typeof languages;

const catalogues: Record<Language, Readonly<Record<string, string>>> = { en: {}, de: german, es: spanish };

const isLanguage = (text: string | undefined): text is Language => text !== undefined && text in languages;

/** The first of the languages that a person reads which the page has. */
export function firstKnown(preferred: readonly string[]): Language {
  return preferred.map((tag) => tag.toLowerCase().split('-')[0]).find(isLanguage) ?? 'en';
}

const cookieName = 'palpable-language';

/** What was chosen on the page: in its cookie; in a page that is a file, behind the # of its address. Null: nothing. */
export function chosenLanguage(cookies: string, hash: string): Language | null {
  const chosen = new RegExp(`(?:^|; )${cookieName}=(\\w+)`).exec(cookies)?.[1] ?? /(?:^#|&)language=(\w+)/.exec(hash)?.[1];
  return isLanguage(chosen) ? chosen : null;
}

/** Empty where a page may have none, as in a frame without rights. */
function cookies(): string {
  try {
    return document.cookie;
  } catch {
    return '';
  }
}

/** Keeps the choice and loads the page again in this language. */
export function choose(language: Language): void {
  try {
    document.cookie = `${cookieName}=${language}; Path=/; SameSite=Strict; Max-Age=${365 * 24 * 3600}`;
  } catch {
    // Then it stands in the address, as that of a page from a disk, which keeps no cookies.
  }
  if (chosenLanguage(cookies(), '') !== language) {
    const others = location.hash.slice(1).split('&').filter((part) => part !== '' && !part.startsWith('language='));
    location.hash = [...others, `language=${language}`].join('&');
  }
  location.reload();
}

const inBrowser = typeof document !== 'undefined';
export const language: Language = inBrowser ? (chosenLanguage(cookies(), location.hash) ?? firstKnown(navigator.languages)) : 'en';
const rules = rulesOf(language);

/** A message of the catalogue in the page's language. Numbers are written as the language does. */
export function t(english: string, values: Values = {}): string {
  return format(catalogues[language][english] ?? english, values, rules);
}

/** A text that the program sent: in the page's language where it is one of the catalogue's. */
export function known(text: string): string {
  return catalogues[language][text] ?? text;
}

const fixedFigures = new Map<number, Intl.NumberFormat>();

/** A number with so many digits after the point. */
export function fixed(value: number, digits: number): string {
  let figures = fixedFigures.get(digits);
  if (figures === undefined) {
    figures = new Intl.NumberFormat(language, { useGrouping: false, minimumFractionDigits: digits, maximumFractionDigits: digits });
    fixedFigures.set(digits, figures);
  }
  return figures.format(value);
}

/** A number with at most so many significant digits. */
export function rounded(value: number, digits: number): string {
  return rules.figure(Number(value.toPrecision(digits)));
}

/** "a, b and c". */
export function listed(words: readonly string[]): string {
  return new Intl.ListFormat(language, { type: 'conjunction' }).format(words).replace(/, and (?=[^,]*$)/, ' and ');
}
