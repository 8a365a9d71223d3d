// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Not everything that the program says is translated (docs/page.md, Languages). What stays English on a German or Spanish page is marked
// as English, so that screen readers and voices pronounce it as such.
import { language, type Language } from './language';

/** Frequent words of each language that the others do not have. Words of several languages ("die", "no", "was", "in") are left out. */
const frequent: Record<Language, RegExp> = {
  en: /^(the|of|and|is|are|it|its|that|this|these|not|with|for|from|by|to|be|been|than|have|cannot|does|did|there|which|what|when|where|only|other|without|too|at|or|but|into|them|they|were|you|your|can|must|file|picture|nothing|damaged)$/u,
  de: /^(der|das|den|dem|des|ein|eine|einen|einem|einer|und|ist|sind|nicht|mit|für|von|vom|zu|zum|zur|auf|aus|bei|es|sich|wird|werden|kann|dieser|diese|dieses|hier|keine|kein|keinen|noch|oder|ohne|hat|im|wenn|du|dein|deine|nur|über|nach|wie|dort|dann|sie|er|als|mehr|auch)$/u,
  es: /^(el|la|los|las|un|una|unos|unas|y|de|del|que|es|son|está|están|con|para|por|en|se|su|al|lo|sin|como|más|hay|este|esta|esto|puede|pueden|aquí|ningún|ninguna|nada|desde|hasta|otra|otro|vez|tu|donde|cuando|pero)$/u,
};

/** Whether a sentence on a page in this language is English: it has more of English's frequent words than of the page's. */
export function isEnglish(text: string, on: Language = language): boolean {
  if (on === 'en') return false;
  const words = text.toLowerCase().match(/[\p{L}’']+/gu) ?? [];
  const count = (of: Language) => words.filter((word) => frequent[of].test(word)).length;
  return count('en') > count(on);
}

/** Shows a text, marked as English where the page is not and it is. */
export function setSent(element: HTMLElement, text: string): void {
  element.textContent = text;
  if (isEnglish(text)) element.lang = 'en';
  else element.removeAttribute('lang');
}
