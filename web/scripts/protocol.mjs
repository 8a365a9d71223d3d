// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Makes both sides' message definitions of protocol.json: node scripts/protocol.mjs [--ts FILE] [--cpp FILE]
// A file whose content would not change is left alone, so that nothing is built again for nothing.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const protocol = JSON.parse(readFileSync(join(here, '..', 'protocol.json'), 'utf8'));
const licence = '// Copyright 2026 The Palpable authors\n// SPDX-License-Identifier: Apache-2.0\n// Made from web/protocol.json by web/scripts/protocol.mjs.\n';

const pascal = (name) => name.replace(/(^|_)([a-z])/g, (_, __, letter) => letter.toUpperCase());
const tsTypes = { number: 'number', integer: 'number', boolean: 'boolean', string: 'string', strings: 'string[]', numbers: 'number[]' };
const cppTypes = {
  number: 'double', integer: 'std::int64_t', boolean: 'bool', string: 'std::string', strings: 'std::vector<std::string>',
  numbers: 'std::vector<double>',
};

function tsMessage(name, { doc, fields }) {
  const lines = Object.entries(fields).map(([field, spec]) => {
    const comment = spec.doc ? `  /** ${spec.doc} */\n` : '';
    return `${comment}  ${field}: ${tsTypes[spec.type]};`;
  });
  return `/** ${doc} */\nexport interface ${pascal(name)} {\n  type: '${name}';\n${lines.join('\n')}\n}\n`;
}

const withoutDoc = (key, value) => (key === 'doc' ? undefined : value);

function ts() {
  const direction = (messages, union) =>
    Object.entries(messages).map(([name, m]) => tsMessage(name, m)).join('\n') +
    `\nexport type ${union} = ${Object.keys(messages).map(pascal).join(' | ')};\n`;
  const specs = (messages) =>
    JSON.stringify(Object.fromEntries(Object.entries(messages).map(([name, m]) => [name, m.fields])), withoutDoc, 2);
  return `${licence}import type { Specs } from '../codec';\n
export const protocolVersion = ${protocol.version};
/** The side of a picture that is a texture, in pitches. */
export const pictureForms = ${protocol.picture_forms};
/** Probes at once, the hand among them. */
export const mostProbes = ${protocol.most_probes};\n
${direction(protocol.from_page, 'FromPage')}
${direction(protocol.to_page, 'ToPage')}
export const fromPageSpecs: Specs = ${specs(protocol.from_page)};\n
export const toPageSpecs: Specs = ${specs(protocol.to_page)};\n
/** ${protocol.raster.doc} */
export const raster = ${JSON.stringify(protocol.raster, withoutDoc)} as const;
`;
}

function cppField(field, spec) {
  const limits = {
    number: `Limits{${spec.min}, ${spec.max}}`, integer: `Limits{${spec.min}, ${spec.max}}`, boolean: 'Limits{}',
    string: `Limits{.longest = ${spec.max}}`, strings: `Limits{.longest = ${spec.max}, .most = ${spec.max_count}}`,
    numbers: `Limits{.lowest = ${spec.min}, .highest = ${spec.max}, .most = ${spec.max_count}}`,
  }[spec.type];
  return `    visit("${field}", self.${field}, ${limits});`;
}

function cppMessage(name, { doc, fields }) {
  const initial = { number: ' = 0.0', integer: ' = 0', boolean: ' = false', string: '', strings: '', numbers: '' };
  const members = Object.entries(fields).map(
    ([field, spec]) => `${spec.doc ? `  /// ${spec.doc}\n` : ''}  ${cppTypes[spec.type]} ${field}${initial[spec.type]};`);
  const visits = Object.entries(fields).map(([field, spec]) => cppField(field, spec));
  const unused = visits.length ? '' : '[[maybe_unused]] ';
  return `/// ${doc}
struct ${pascal(name)} {
  static constexpr std::string_view kType = "${name}";
${members.join('\n')}${members.length ? '\n' : ''}  bool operator==(const ${pascal(name)}&) const = default;
  template <class Self, class Visit>
  static void each_field(${unused}Self& self, ${unused}Visit&& visit) {
${visits.join('\n')}${visits.length ? '\n' : ''}  }
};
`;
}

function cpp() {
  const direction = (messages, union) =>
    Object.entries(messages).map(([name, m]) => cppMessage(name, m)).join('\n') +
    `\nusing ${union} = std::variant<${Object.keys(messages).map(pascal).join(', ')}>;\n`;
  const kinds = Object.entries(protocol.raster.kinds).map(([name, n]) => `${name} = ${n}`).join(', ');
  return `${licence}#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace palpable::page::protocol {

constexpr std::int64_t kVersion = ${protocol.version};
/// The side of a picture that is a texture, in pitches.
constexpr int kPictureForms = ${protocol.picture_forms};
/// Probes at once, the hand among them.
constexpr std::size_t kMostProbes = ${protocol.most_probes};

/// What a field may hold: numbers lowest…highest, strings of at most \`longest\` bytes, lists of at most \`most\`.
struct Limits {
  double lowest = 0.0;
  double highest = 0.0;
  std::size_t longest = 0;
  std::size_t most = 0;
};

${direction(protocol.from_page, 'FromPage')}
${direction(protocol.to_page, 'ToPage')}
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
