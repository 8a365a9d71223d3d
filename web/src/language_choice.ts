// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The choice of the language on a page.
import { element } from './dom';
import { choose, language, languages, type Language } from './language';

/** Fills the list of languages, each named in itself; another choice loads the page again. */
export function offerLanguages(): void {
  const list = element<HTMLSelectElement>('language');
  for (const [code, name] of Object.entries(languages)) {
    const option = new Option(name, code, code === language, code === language);
    option.lang = code;
    list.append(option);
  }
  list.addEventListener('change', () => choose(list.value as Language));
}
