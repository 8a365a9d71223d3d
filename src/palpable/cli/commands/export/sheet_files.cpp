// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/sheet_files.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/atomic_files.hpp"
#include "palpable/formats/tactile/braille_cells.hpp"

#include <algorithm>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Braille of lines; without liblouis uncontracted, with a note.
Result<std::vector<formats::BrailleLine>> braille_of(const std::vector<std::string>& lines,
                                                     const std::string& table, Console& console) {
  auto translated = formats::translated_braille(lines, table);
  if (translated || translated.error().code == ErrorCode::usage) return translated;
  console.note(fmt::format("The braille is uncontracted, without accents: {}.", translated.error().message));
  std::vector<formats::BrailleLine> plain;
  for (const std::string& line : lines) plain.push_back(formats::plain_braille(line));
  return plain;
}

Result<void> add_text(AtomicFiles& files, const std::filesystem::path& path, const std::string& text) {
  return files.add(path, std::as_bytes(std::span(text)));
}

/// "town-key.svg", "town-key-2.svg".
std::filesystem::path key_path(const std::filesystem::path& output, std::size_t page) {
  std::filesystem::path path = output;
  path.replace_filename(output.stem().string() + (page == 0 ? "-key" : fmt::format("-key-{}", page + 1)) +
                        output.extension().string());
  return path;
}

/// The key in print, without the names that the table cannot write, which are said: first those whose
/// keys stand on the drawing.
std::vector<std::string> key_lines(const KeyedDrawing& drawing, const std::vector<std::size_t>& without_room,
                                   const std::string& table, Console& console) {
  const auto writable = formats::writable_in_braille(drawing.key_lines, table);
  const auto writable_heading = formats::writable_in_braille(drawing.heading, table);
  std::vector<std::string> lines, without_key;
  std::size_t unwritable = 0;
  for (std::size_t i = 0; i < drawing.heading.size(); ++i)
    if (!writable_heading || (*writable_heading)[i])
      lines.push_back(drawing.heading[i]);
    else
      console.note(fmt::format("The key is without the heading that {} cannot write (--braille-table): {}.",
                               table, drawing.heading[i]));
  for (std::size_t i = 0; i < drawing.key_lines.size(); ++i) {
    const bool has_key = std::find(without_room.begin(), without_room.end(), i) == without_room.end();
    if (writable && !(*writable)[i])
      ++unwritable;
    else
      (has_key ? lines : without_key).push_back(drawing.key_lines[i]);
  }
  if (!without_key.empty()) lines.push_back(drawing.named + " whose keys are not on the drawing");
  lines.insert(lines.end(), without_key.begin(), without_key.end());
  if (drawing.not_drawn > 0)
    lines.push_back(fmt::format("{} that are not on the drawing: {}", drawing.named, drawing.not_drawn));
  if (unwritable > 0)
    console.note(fmt::format("{} of {} names cannot be written with {} (--braille-table).", unwritable,
                             drawing.key_lines.size(), table));
  return lines;
}

constexpr std::size_t kMostSheets = 1000;

/// Sheets of this drawing's key from an earlier export, beyond those that are written, go.
void remove_older_sheets(const std::filesystem::path& output, std::size_t written, AtomicFiles& files) {
  constexpr std::size_t kBegin = 400;
  for (std::size_t page = written; page < kMostSheets; ++page) {
    const auto path = key_path(output, page);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) continue;
    std::string begin(kBegin, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    begin.resize(static_cast<std::size_t>(file.gcount()));
    if (formats::is_key_sheet(begin)) files.remove_after(path);
  }
}

/// Adds the drawing and, for an SVG, its key, which is left out where nothing has a key; their paths.
Result<std::vector<std::string>> add_drawing(const KeyedDrawing& drawing, const PrintOptions& options,
                                             const std::filesystem::path& output, Console& console,
                                             AtomicFiles& files) {
  const bool is_svg = output.extension() == ".svg";
  // Which keys have room decides the order of the key's lines.
  auto encoded = is_svg ? formats::encode_sheet(drawing.sheet, options.sheet)
                        : formats::encode_braille_sheet(drawing.sheet, {}, options.braille);
  if (!encoded) return encoded.error();
  std::vector<formats::BrailleLine> lines;
  if (!drawing.key_lines.empty()) {
    auto braille =
        braille_of(key_lines(drawing, encoded->without_room, options.table, console), options.table, console);
    if (!braille) return braille.error();
    lines = *std::move(braille);
    if (!is_svg) encoded = formats::encode_braille_sheet(drawing.sheet, lines, options.braille);
    if (!encoded) return encoded.error();
  }
  std::vector<std::string> paths{output.string()};
  if (const auto added = add_text(files, output, encoded->text); !added) return added.error();
  if (is_svg) {
    const auto pages = formats::encode_key_sheets(lines, options.sheet);
    for (std::size_t page = 0; page < pages.size(); ++page) {
      paths.push_back(key_path(output, page).string());
      if (const auto added = add_text(files, paths.back(), pages[page]); !added) return added.error();
    }
    remove_older_sheets(output, pages.size(), files);
  }
  if (!encoded->without_room.empty())
    console.note(fmt::format("{} of {} keys found no room on the drawing; {} has room for more.",
                             encoded->without_room.size(), drawing.key_lines.size(),
                             is_svg ? "a larger --width or --paper" : "larger paper (--paper)"));
  return paths;
}

/// The first of them is what was asked for.
Answer answer_of(const std::vector<std::string>& files) {
  Answer answer;
  answer.json["output"] = files.front();
  answer.json["files"] = files;
  answer.text = fmt::format("{}\n", fmt::join(files, "\n"));
  return answer;
}

}  // namespace

std::string shortened(const std::string& name) {
  constexpr std::size_t kMost = 60;
  std::size_t characters = 0;
  for (std::size_t k = 0; k < name.size(); ++k)
    if ((static_cast<unsigned char>(name[k]) & 0xC0U) != 0x80U && ++characters > kMost)
      return name.substr(0, k) + "...";
  return name;
}

std::vector<std::string> drawing_files(const std::filesystem::path& output) {
  std::vector<std::string> files{output.string()};
  std::error_code error;
  for (std::size_t page = 0; page < kMostSheets; ++page)
    if (const auto path = key_path(output, page); std::filesystem::exists(path, error))
      files.push_back(path.string());
  return files;
}

Result<Answer> write_drawing(const KeyedDrawing& drawing, const PrintOptions& options,
                             const std::filesystem::path& output, Console& console) {
  AtomicFiles files;
  const auto paths = add_drawing(drawing, options, output, console, files);
  if (!paths) return paths.error();
  if (const auto written = files.commit(); !written) return written.error();
  return answer_of(*paths);
}

Result<Answer> write_text(const Result<std::string>& text, const std::filesystem::path& output) {
  if (!text) return text.error();
  if (const auto written = write_file_atomically(output, std::as_bytes(std::span(*text))); !written)
    return written.error();
  return answer_of({output.string()});
}

}  // namespace palpable::cli
