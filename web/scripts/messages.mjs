// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The messages of the pages: every t('…') of the sources, and the texts of the HTML. Without an argument it prints them;
// `node scripts/messages.mjs de` prints those that languages/de.json lacks.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const web = join(dirname(fileURLToPath(import.meta.url)), '..');

/** The TypeScript of the pages, without tests and generated files. */
export function sources(folder = join(web, 'src')) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return entry.name === 'generated' ? [] : sources(path);
    return /(?<!\.test|\.d)\.ts$/.test(entry.name) ? [path] : [];
  });
}

/** Every string of a source: its text ({} for what is put into it), its line, and whether it is an argument of t(). */
export function stringsOf(path) {
  const file = ts.createSourceFile(path, readFileSync(path, 'utf8'), ts.ScriptTarget.Latest, true);
  const found = [];
  const visit = (node) => {
    if (ts.isImportDeclaration(node) || ts.isLiteralTypeNode(node)) return;
    const isText = ts.isStringLiteral(node) || ts.isNoSubstitutionTemplateLiteral(node);
    if (isText || ts.isTemplateExpression(node)) {
      const text = isText ? node.text : node.head.text + node.templateSpans.map(({ literal }) => `{}${literal.text}`).join('');
      const { parent } = node;
      const isMessage = ts.isCallExpression(parent) && parent.expression.getText() === 't' && parent.arguments[0] === node;
      found.push({ text, isMessage, line: file.getLineAndCharacterOfPosition(node.getStart()).line + 1 });
    }
    ts.forEachChild(node, visit);
  };
  visit(file);
  return found;
}

const voids = new Set(['area', 'br', 'col', 'hr', 'img', 'input', 'link', 'meta']);
const entities = { nbsp: '\u00a0', amp: '&', lt: '<', gt: '>', quot: '"' };
const plain = (text) => text.replace(/&(\w+);/g, (all, name) => entities[name] ?? all);
const clean = (text) => text.replace(/\s+/g, ' ');
const hasWords = (text) => /\p{L}{2}/u.test(text);

/** The messages of an HTML file, as static_text.ts finds them. */
export function messagesOfHtml(path) {
  const html = readFileSync(path, 'utf8').replace(/<!--[^]*?-->|<script[^]*?<\/script>|<!doctype[^>]*>/g, '');
  const found = [];
  const open = [{ name: '', parts: [], count: 0 }];
  const close = () => {
    const { parts } = open.pop();
    if (parts.some((part) => !part.startsWith('{') && hasWords(part))) found.push(clean(parts.join('')).trim());
  };
  for (const [, end, name, attributes, text] of html.matchAll(/<(\/?)([a-z0-9-]+)((?:\s+[a-z-]+(?:="[^"]*")?)*)\s*\/?>|([^<]+)/g)) {
    const top = open[open.length - 1];
    if (text !== undefined) {
      top.parts.push(plain(text));
    } else if (end === '/') {
      close();
    } else {
      top.parts.push(`{${top.count++}}`);
      for (const [, key, value] of attributes.matchAll(/([a-z-]+)="([^"]*)"/g))
        if (['aria-label', 'aria-roledescription', 'title', 'placeholder', 'alt', 'label', 'data-empty', 'data-when-paused'].includes(key) && hasWords(value)) found.push(clean(plain(value)));
      if (!voids.has(name)) open.push({ name, parts: [], count: 0 });
    }
  }
  return found;
}

/** The texts that the program's C++ gives to tr(), phrase() and counted(), where they stand there. */
export function programMessages() {
  const folders = ['describe', 'page', 'page/share', 'onefile', 'session/touch'].map((name) => join(web, '..', 'src', 'palpable', name));
  const files = folders.flatMap((folder) => readdirSync(folder).filter((name) => /(?<!_test)\.cpp$/.test(name)).map((name) => join(folder, name)));
  const found = files.flatMap((path) => {
    const code = readFileSync(path, 'utf8').replace(/\/\/.*/g, '').replace(/"\s*\n\s*"/g, '');
    const calls = [...code.matchAll(/\b(?:tr|phrase|counted)\(((?:[^();"]|"(?:[^"\\]|\\.)*"|\([^()]*\))*)/g)].map(([, words]) => words);
    return calls.flatMap((words) => [...words.matchAll(/"((?:[^"\\]|\\.)*)"/g)].map(([, text]) => text));
  });
  return [...new Set(found)].filter((text) => /\p{L}{2}/u.test(text.replace(/\{[^}]*\}/g, '')));
}

/** Every message of the pages, each once. */
export function allMessages() {
  const ofSources = sources().flatMap((path) => stringsOf(path).filter(({ isMessage }) => isMessage).map(({ text }) => text));
  const ofHtml = ['index.html', 'shelf.html'].flatMap((name) => messagesOfHtml(join(web, name)));
  return [...new Set([...ofSources, ...ofHtml])];
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [language] = process.argv.slice(2);
  const known = language ? JSON.parse(readFileSync(join(web, 'languages', `${language}.json`), 'utf8')) : {};
  console.log(JSON.stringify(allMessages().filter((message) => !(message in known)), null, 1));
}
