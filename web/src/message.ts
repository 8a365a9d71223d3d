// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Messages with arguments, in the part of ICU's MessageFormat that the catalogues use: {name}, {name, plural, one {…}
// other {…}} and in it # for the number. A language's own rules say which form a number takes (Intl.PluralRules).

export type Values = Readonly<Record<string, string | number>>;

type Part = string | { name: string; forms: Record<string, Part[]> | null };

/** How a language writes: its plural forms and its figures. */
export interface Rules {
  form(count: number): string;
  figure(value: number): string;
}

export function rulesOf(language: string): Rules {
  const plural = new Intl.PluralRules(language);
  const figures = new Intl.NumberFormat(language, { useGrouping: false, maximumFractionDigits: 12 });
  return { form: (count) => plural.select(count), figure: (value) => figures.format(value) };
}

/** The message with its values; throws for one that is malformed, or has an argument without a value. */
export function format(message: string, values: Values, rules: Rules): string {
  return write(parsed(message), values, rules, null);
}

/** The names of a message's arguments, sorted; with `plural` those that decide a form, marked. */
export function argumentsOf(message: string): string[] {
  const names = new Set<string>();
  const gather = (parts: readonly Part[]): void => {
    for (const part of parts) {
      if (typeof part === 'string') continue;
      names.add(part.forms === null ? part.name : `${part.name}, plural`);
      for (const form of Object.values(part.forms ?? {})) gather(form);
    }
  };
  gather(parsed(message));
  return [...names].sort();
}

function write(parts: readonly Part[], values: Values, rules: Rules, count: number | null): string {
  return parts
    .map((part) => {
      if (typeof part === 'string') return count === null ? part : part.replaceAll('#', rules.figure(count));
      const value = values[part.name];
      if (value === undefined) throw new Error(`a message lacks {${part.name}}`);
      if (part.forms === null) return typeof value === 'number' ? rules.figure(value) : value;
      const form = part.forms[rules.form(Number(value))] ?? part.forms['other'];
      return write(form ?? [], values, rules, Number(value));
    })
    .join('');
}

const kept = new Map<string, Part[]>();

function parsed(message: string): Part[] {
  let parts = kept.get(message);
  if (parts === undefined) {
    parts = new Parser(message).parts();
    kept.set(message, parts);
  }
  return parts;
}

class Parser {
  private at = 0;

  constructor(private readonly text: string) {}

  /** Up to the end, or to the brace that ends a form. */
  parts(): Part[] {
    const parts: Part[] = [];
    while (this.at < this.text.length && this.text[this.at] !== '}') {
      if (this.text[this.at] === '{') {
        parts.push(this.argument());
        continue;
      }
      const end = this.text.slice(this.at).search(/[{}]/);
      const literal = end < 0 ? this.text.slice(this.at) : this.text.slice(this.at, this.at + end);
      this.at += literal.length;
      parts.push(literal);
    }
    return parts;
  }

  private argument(): Part {
    const name = this.take(/\{\s*(\w+)\s*/y)[1]!;
    if (this.text[this.at] === '}') {
      this.at += 1;
      return { name, forms: null };
    }
    this.take(/,\s*plural\s*,\s*/y);
    const forms: Record<string, Part[]> = {};
    while (this.text[this.at] !== '}') {
      const form = this.take(/(\w+)\s*\{/y)[1]!;
      forms[form] = this.parts();
      this.take(/\}\s*/y);
    }
    this.at += 1;
    return { name, forms };
  }

  private take(pattern: RegExp): RegExpExecArray {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (found === null) throw new Error(`a message is malformed at ${this.at}: ${this.text}`);
    this.at = pattern.lastIndex;
    return found;
  }
}
