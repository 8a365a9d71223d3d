// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/command.hpp"
#include "palpable/formats/tactile/tactile_sheet.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::cli {

/// A drawing that is printed, and its key in print: what stands above it, and a line for each key of the
/// sheet, in their order.
struct KeyedDrawing {
  formats::TactileSheet sheet;
  std::vector<std::string> heading;
  std::vector<std::string> key_lines;
  /// How the key calls what it names: "Streets".
  std::string named = "Names";
  /// Names that are not on the drawing.
  std::size_t not_drawn = 0;
};

struct PrintOptions {
  formats::SheetOptions sheet;
  formats::BrailleOptions braille;
  /// A table of liblouis.
  std::string table;
};

/// Writes a drawing for swell paper with sheets of its key (.svg), or as braille dots with pages of its key
/// (.brf), by the output's suffix. Without liblouis the braille is uncontracted, which a note says, as it
/// does of keys without room. Errors: usage for options out of range; as write_file_atomically().
Result<Answer> write_drawing(const KeyedDrawing& drawing, const PrintOptions& options,
                             const std::filesystem::path& output, Console& console);

/// Writes an export that is one text. Errors: that of `text`; as write_file_atomically().
Result<Answer> write_text(const Result<std::string>& text, const std::filesystem::path& output);

/// The files that a drawing into this .svg may write or replace: the drawing, and sheets of its key.
std::vector<std::string> drawing_files(const std::filesystem::path& output);

/// A name of at most sixty characters, so that a key has a bounded number of pages.
std::string shortened(const std::string& name);

}  // namespace palpable::cli
