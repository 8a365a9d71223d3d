// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/export_formats.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

struct Kind {
  Exported what;
  std::string_view one;  ///< "a relief"
  std::string_view is;   ///< the verb after it
};

constexpr std::array kKinds{
    Kind{Exported::relief, "a relief", "is"},    Kind{Exported::map, "a map", "is"},
    Kind{Exported::field, "a field", "is"},      Kind{Exported::grid, "a grid", "is"},
    Kind{Exported::contours, "contours", "are"}, Kind{Exported::recording, "a recording", "is"}};

constexpr std::string_view kGrid = "--grid", kBand = "--band", kInterval = "--interval", kWidth = "--width",
                           kLines = "--lines", kColumns = "--braille-columns", kRows = "--braille-rows",
                           kTable = "--braille-table", kPaper = "--paper";

struct Format {
  Exported what;
  std::string_view suffix;
  std::array<std::string_view, 5> options{};  ///< those that it reads; empty ones are none
};

using enum Exported;
constexpr std::array kFormats{Format{relief, ".stl"},
                              Format{relief, ".glb"},
                              Format{relief, ".svg", {kInterval, kWidth, kPaper, kTable}},
                              Format{relief, ".brf", {kInterval, kColumns, kRows, kPaper, kTable}},
                              Format{relief, ".pbm", {kInterval}},
                              Format{relief, ".npz"},
                              Format{relief, ".png"},
                              Format{relief, ".html"},
                              Format{map, ".txt"},
                              Format{map, ".svg", {kWidth, kPaper, kTable}},
                              Format{map, ".brf", {kColumns, kRows, kPaper, kTable}},
                              Format{map, ".pbm"},
                              Format{map, ".stl"},
                              Format{map, ".glb"},
                              Format{map, ".npz"},
                              Format{map, ".png"},
                              Format{map, ".html"},
                              Format{field, ".stl"},
                              Format{field, ".ply"},
                              Format{field, ".glb"},
                              Format{field, ".vdb", {kGrid, kBand}},
                              Format{field, ".npz", {kGrid}},
                              Format{field, ".svg", {kInterval, kWidth, kPaper, kTable}},
                              Format{field, ".brf", {kInterval, kColumns, kRows, kPaper, kTable}},
                              Format{field, ".pbm", {kInterval}},
                              Format{field, ".html"},
                              Format{grid, ".npz"},
                              Format{grid, ".svg", {kInterval, kWidth, kPaper, kTable}},
                              Format{grid, ".brf", {kInterval, kColumns, kRows, kPaper, kTable}},
                              Format{grid, ".pbm", {kInterval}},
                              Format{grid, ".html"},
                              Format{contours, ".svg", {kWidth, kPaper, kTable}},
                              Format{contours, ".brf", {kColumns, kRows, kPaper, kTable}},
                              Format{contours, ".pbm"},
                              Format{contours, ".stl", {kLines}},
                              Format{contours, ".glb", {kLines}},
                              Format{contours, ".npz"},
                              Format{contours, ".png"},
                              Format{contours, ".html"},
                              Format{recording, ".csv"},
                              Format{recording, ".npz"}};

const Kind& kind_of(Exported what) {
  return *std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return kind.what == what; });
}

bool reads(const Format& format, std::string_view option) {
  return std::find(format.options.begin(), format.options.end(), option) != format.options.end();
}

/// ".a, .b or .c"
std::string alternatives(const std::vector<std::string_view>& words) {
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// "a field as .vdb or .npz", for each kind of which a format reads the option; empty if none does.
std::string uses_of(std::string_view option) {
  std::vector<std::string> uses;
  for (const Kind& kind : kKinds) {
    std::vector<std::string_view> suffixes;
    for (const Format& format : kFormats)
      if (format.what == kind.what && reads(format, option)) suffixes.push_back(format.suffix);
    if (!suffixes.empty()) uses.push_back(fmt::format("{} as {}", kind.one, alternatives(suffixes)));
  }
  return fmt::format("{}", fmt::join(uses, ", or "));
}

}  // namespace

Exported exported_kind(const models::Scene& scene) {
  if (scene.map) return Exported::map;
  if (models::is_field(scene.model)) return Exported::field;
  if (std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model)) return Exported::grid;
  if (std::holds_alternative<std::shared_ptr<const models::Contours>>(scene.model)) return Exported::contours;
  return Exported::relief;
}

std::vector<std::string> export_suffixes() {
  std::vector<std::string> suffixes;
  for (const Format& format : kFormats)
    if (std::find(suffixes.begin(), suffixes.end(), format.suffix) == suffixes.end())
      suffixes.emplace_back(format.suffix);
  return suffixes;
}

Result<void> check_export(Exported what, const std::filesystem::path& output) {
  std::vector<std::string_view> suffixes;
  for (const Format& format : kFormats)
    if (format.what == what) suffixes.push_back(format.suffix);
  if (std::find(suffixes.begin(), suffixes.end(), output.extension().string()) != suffixes.end()) return {};
  const Kind& kind = kind_of(what);
  return Error{ErrorCode::usage,
               fmt::format("{} {} exported as {}", kind.one, kind.is, alternatives(suffixes)),
               output.string()};
}

std::optional<std::string> note_on_unread(Exported what, const std::filesystem::path& output,
                                          const std::vector<std::string>& given) {
  const std::string suffix = output.extension().string();
  const auto is_read = [&](std::string_view option) {
    return std::any_of(kFormats.begin(), kFormats.end(), [&](const Format& format) {
      return format.what == what && format.suffix == suffix && reads(format, option);
    });
  };
  std::vector<std::string> sentences;
  for (const std::string& option : given)
    if (const std::string uses = uses_of(option); !uses.empty() && !is_read(option))
      sentences.push_back(fmt::format("{} has no effect on {} as {}: it is for {}.", option,
                                      kind_of(what).one, suffix, uses));
  if (sentences.empty()) return std::nullopt;
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace palpable::cli
