// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Generates both sides' message definitions from protocol.json: node scripts/protocol.mjs [--ts FILE] [--cpp FILE]
// A file whose content would not change is not written, so that nothing is rebuilt without need.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const protocol = JSON.parse(readFileSync(join(here, '..', 'protocol.json'), 'utf8'));
const licence = '// Copyright 2026 The Palpable authors\n// SPDX-License-Identifier: Apache-2.0\n// Generated from web/protocol.json by web/scripts/protocol.mjs.\n';

const pascal = (name) => name.replace(/(^|_)([a-z])/g, (_, __, letter) => letter.toUpperCase());
const isObject = ({ type }) => Object.hasOwn(protocol.objects, type);

function checkFields(where, fields, known) {
  for (const [name, spec] of Object.entries(fields))
    if (!['number', 'integer', 'boolean', 'string', ...known].includes(spec.type))
      throw new Error(`protocol.json: ${where}.${name}: there is no type ${spec.type}, or it is defined further down`);
}
Object.entries(protocol.objects).forEach(([name, { fields }], k, all) => checkFields(name, fields, all.slice(0, k).map(([earlier]) => earlier)));
for (const messages of [protocol.from_page, protocol.to_page, protocol.from_shelf, protocol.to_shelf])
  for (const [name, { fields }] of Object.entries(messages)) checkFields(name, fields, Object.keys(protocol.objects));

/** Levels of objects and lists within a message of these fields, the message itself included. */
function depthOf(fields) {
  const below = Object.values(fields).map((spec) => (spec.max_count ? 1 : 0) + (isObject(spec) ? depthOf(protocol.objects[spec.type].fields) : 0));
  return 1 + Math.max(0, ...below);
}

// TypeScript.

const tsScalars = { number: 'number', integer: 'number', boolean: 'boolean', string: 'string' };

function tsType(spec) {
  const value = (tsScalars[spec.type] ?? pascal(spec.type)) + (spec.nullable ? ' | null' : '');
  if (!spec.max_count) return value;
  return spec.nullable ? `(${value})[]` : `${value}[]`;
}

function tsInterface(name, { doc, fields }, type) {
  const lines = Object.entries(fields).map(([field, spec]) => {
    const comment = spec.doc ? `  /** ${spec.doc} */\n` : '';
    return `${comment}  ${field}: ${tsType(spec)};`;
  });
  return `/** ${doc} */\nexport interface ${pascal(name)} {\n${type ? `  type: '${name}';\n` : ''}${lines.join('\n')}\n}\n`;
}

const withoutDoc = (key, value) => (key === 'doc' ? undefined : value);

function ts() {
  const all = (messages, type) => Object.entries(messages).map(([name, m]) => tsInterface(name, m, type)).join('\n');
  const direction = (messages, union) => `${all(messages, true)}\nexport type ${union} = ${Object.keys(messages).map(pascal).join(' | ')};\n`;
  const specs = (messages) =>
    JSON.stringify(Object.fromEntries(Object.entries(messages).map(([name, m]) => [name, m.fields])), withoutDoc, 2);
  return `${licence}import type { Specs } from '../codec';\n
export const protocolVersion = ${protocol.version};
/** The side of a picture that is a texture, in pitches. */
export const pictureForms = ${protocol.picture_forms};
/** Probes at once. */
export const mostProbes = ${protocol.most_probes};\n
${all(protocol.objects, false)}
${direction(protocol.from_page, 'FromPage')}
${direction(protocol.to_page, 'ToPage')}
${direction(protocol.from_shelf, 'FromShelf')}
${direction(protocol.to_shelf, 'ToShelf')}
export const objectSpecs: Specs = ${specs(protocol.objects)};\n
export const fromPageSpecs: Specs = ${specs(protocol.from_page)};\n
export const toPageSpecs: Specs = ${specs(protocol.to_page)};\n
export const toShelfSpecs: Specs = ${specs(protocol.to_shelf)};\n
/** ${protocol.raster.doc} */
export const raster = ${JSON.stringify(protocol.raster, withoutDoc)} as const;
`;
}

// C++.

const cppScalars = { number: 'double', integer: 'std::int64_t', boolean: 'bool', string: 'std::string' };

function cppType(spec) {
  const value = cppScalars[spec.type] ?? pascal(spec.type);
  const element = spec.nullable ? `std::optional<${value}>` : value;
  return spec.max_count ? `std::vector<${element}>` : element;
}

function cppLimits(spec) {
  const bounds = ['number', 'integer'].includes(spec.type) ? [`.lowest = ${spec.min}`, `.highest = ${spec.max}`] : [];
  const longest = spec.type === 'string' ? [`.longest = ${spec.max}`] : [];
  const most = spec.max_count ? [`.most = ${spec.max_count}`] : [];
  return `Limits{${[...bounds, ...longest, ...most].join(', ')}}`;
}

function cppStruct(name, { doc, fields }, isMessage) {
  // Without a member initializer, an optional or a list would ask for one in every list of designated values.
  const initial = (spec) => (spec.max_count || spec.nullable || spec.type === 'string' || isObject(spec) ? '{}' : { boolean: ' = false', integer: ' = 0', number: ' = 0.0' }[spec.type]);
  const members = Object.entries(fields).map(
    ([field, spec]) => `${spec.doc ? `  /// ${spec.doc}\n` : ''}  ${cppType(spec)} ${field}${initial(spec)};`);
  const visits = Object.entries(fields).map(([field, spec]) => `    visit("${field}", self.${field}, ${cppLimits(spec)});`);
  const unused = visits.length ? '' : '[[maybe_unused]] ';
  return `/// ${doc}
struct ${pascal(name)} {
${isMessage ? `  static constexpr std::string_view kType = "${name}";\n` : ''}${members.join('\n')}${members.length ? '\n' : ''}  bool operator==(const ${pascal(name)}&) const = default;
  template <class Self, class Visit>
  static void each_field(${unused}Self& self, ${unused}Visit&& visit) {
${visits.join('\n')}${visits.length ? '\n' : ''}  }
};
`;
}

function cpp() {
  const all = (messages, isMessage) => Object.entries(messages).map(([name, m]) => cppStruct(name, m, isMessage)).join('\n');
  const direction = (messages, union) => `${all(messages, true)}\nusing ${union} = std::variant<${Object.keys(messages).map(pascal).join(', ')}>;\n`;
  const kinds = Object.entries(protocol.raster.kinds).map(([name, n]) => `${name} = ${n}`).join(', ');
  return `${licence}#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpable::page::protocol {

constexpr std::int64_t kVersion = ${protocol.version};
/// The side of a picture that is a texture, in pitches.
constexpr int kPictureForms = ${protocol.picture_forms};
/// Probes at once.
constexpr std::size_t kMostProbes = ${protocol.most_probes};
/// Levels of objects and lists within a message from a page, the message itself included.
constexpr int kDeepestFromPage = ${Math.max(...Object.values({ ...protocol.from_page, ...protocol.from_shelf }).map(({ fields }) => depthOf(fields)))};

/// What a field may hold: numbers lowest…highest, strings of at most \`longest\` bytes, lists of at most \`most\`.
struct Limits {
  double lowest = 0.0;
  double highest = 0.0;
  std::size_t longest = 0;
  std::size_t most = 0;
};

${all(protocol.objects, false)}
${direction(protocol.from_page, 'FromPage')}
${direction(protocol.to_page, 'ToPage')}
${direction(protocol.from_shelf, 'FromShelf')}
${direction(protocol.to_shelf, 'ToShelf')}
/// ${protocol.raster.doc}
constexpr std::uint32_t kRasterMagic = ${protocol.raster.magic}U;
enum class RasterKind : std::uint32_t { ${kinds} };

}  // namespace palpable::page::protocol
`;
}

function write(file, text) {
  if (existsSync(file) && readFileSync(file, 'utf8') === text) return;
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
}

for (let i = 2; i + 1 < process.argv.length; i += 2) {
  if (process.argv[i] === '--ts') write(process.argv[i + 1], ts());
  else if (process.argv[i] === '--cpp') write(process.argv[i + 1], cpp());
  else throw new Error(`protocol.mjs: unknown option ${process.argv[i]}`);
}
