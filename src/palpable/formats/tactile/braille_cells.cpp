// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/braille_cells.hpp"

#include "palpable/core/system/child_process.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace palpable::formats {
namespace {

/// Six-dot patterns as North American braille ASCII, by dots 1 to 6 as bits 0 to 5.
constexpr std::string_view kBrailleAscii =
    R"( A1B'K2L@CIF/MSP"E3H9O6R^DJG>NTQ,*5<-U8V.%[$+X!&;:4\0Z7(_?W]#Y)=)";
static_assert(kBrailleAscii.size() == 64);

constexpr BrailleCell kCapital = 0b100000, kNumber = 0b111100, kUnknown = 0b111100;

/// `c` must be in the table.
BrailleCell cell_of_ascii(char c) { return static_cast<BrailleCell>(kBrailleAscii.find(c)); }

/// Unified English Braille of a mark; nullopt for others.
std::optional<BrailleCell> mark_cell(char c) {
  constexpr std::string_view kMarks = " ,;:.!?'-";
  constexpr std::string_view kInAscii = " 123468'-";
  static_assert(kMarks.size() == kInAscii.size());
  const std::size_t at = kMarks.find(c);
  return at == std::string_view::npos ? std::nullopt : std::optional(cell_of_ascii(kInAscii[at]));
}

/// The lines of Unicode braille patterns (U+2800 to U+28FF, three bytes each); other characters are blanks.
std::vector<BrailleLine> lines_of_patterns(std::string_view text) {
  std::vector<BrailleLine> lines(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte == '\n') {
      lines.emplace_back();
    } else if (byte == 0xE2 && i + 2 < text.size()) {
      const auto high = static_cast<unsigned char>(text[i + 1]),
                 low = static_cast<unsigned char>(text[i + 2]);
      const unsigned pattern = ((high & 0x3FU) << 6U) | (low & 0x3FU);
      lines.back().push_back(static_cast<BrailleCell>(pattern & 0x3FU));
      i += 2;
    } else if ((byte & 0xC0U) != 0x80U) {
      lines.back().push_back(0);
    }
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

/// A file in memory that a child can get; none if there is no memory.
Descriptor memory_file(const char* name) { return passable(Descriptor(::memfd_create(name, MFD_CLOEXEC))); }

bool write_whole(const Descriptor& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file.number(), text.data(), text.size());
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::lseek(file.number(), 0, SEEK_SET) == 0;
}

std::string read_whole(const Descriptor& file) {
  std::string text;
  const off_t size = ::lseek(file.number(), 0, SEEK_END);
  if (size <= 0) return text;
  text.resize(static_cast<std::size_t>(size));
  const ssize_t got = ::pread(file.number(), text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return text;
}

/// The exit code of a child that ends within ten seconds; a slower one is ended, and gives nullopt.
std::optional<int> wait_for(pid_t child) {
  constexpr int kMost_ms = 10000;
  const Descriptor end(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  pollfd ended{end.number(), POLLIN, 0};
  const bool in_time = ::poll(&ended, 1, kMost_ms) == 1;
  if (!in_time) ::kill(-child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return in_time && WIFEXITED(status) ? std::optional<int>(WEXITSTATUS(status)) : std::nullopt;
}

/// The characters of a text beyond ASCII, each as its bytes.
std::vector<std::string> beyond_ascii(std::string_view text) {
  std::vector<std::string> characters;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0xC0U) characters.emplace_back();
    if (byte >= 0x80U && !characters.empty()) characters.back() += c;
  }
  return characters;
}

/// Whether a character is written by its number, as another one is: the same cells around the digits.
bool is_by_number(const BrailleLine& cells, const BrailleLine& by_number) {
  constexpr std::size_t kBegin = 2;  // quotation mark, backslash; then x, or y or z beyond 16 bits
  if (cells.size() <= kBegin || by_number.size() <= kBegin) return cells == by_number;
  return std::equal(cells.begin(), cells.begin() + kBegin, by_number.begin()) &&
         cells.back() == by_number.back();
}

/// The folders of liblouis' tables, and the tables in them.
std::set<std::string> installed_tables() {
  std::set<std::string> tables;
  std::string folders = "/usr/share/liblouis/tables,/usr/local/share/liblouis/tables";
  if (const char* further = std::getenv("LOUIS_TABLEPATH")) folders += std::string(",") + further;
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(',', begin), folders.size());
    std::error_code ignored;
    for (const auto& file :
         std::filesystem::directory_iterator(folders.substr(begin, end - begin), ignored)) {
      const auto kind = file.path().extension();
      if (kind == ".ctb" || kind == ".utb" || kind == ".tbl") tables.insert(file.path().filename().string());
    }
    begin = end + 1;
  }
  return tables;
}

/// What stands before the first mark: "en" of "en-ueb-g1.ctb".
std::string language_of(const std::string& table) { return table.substr(0, table.find_first_of("-_.")); }

}  // namespace

char braille_ascii(BrailleCell cell) { return kBrailleAscii[cell & 63U]; }

std::string braille_ascii(std::span<const BrailleCell> line) {
  std::string text;
  for (const BrailleCell cell : line) text += braille_ascii(cell);
  return text;
}

BrailleLine plain_braille(std::string_view text) {
  BrailleLine line;
  bool in_number = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80U) continue;
    const bool is_digit = byte < 128 && std::isdigit(byte) != 0;
    if (is_digit) {
      if (!in_number) line.push_back(kNumber);
      line.push_back(cell_of_ascii(c == '0' ? 'J' : static_cast<char>('A' + (c - '1'))));
    } else if (byte < 128 && std::isalpha(byte) != 0) {
      if (std::isupper(byte) != 0) line.push_back(kCapital);
      line.push_back(cell_of_ascii(static_cast<char>(std::toupper(byte))));
    } else if (const auto mark = mark_cell(c)) {
      line.push_back(*mark);
    } else {
      line.insert(line.end(), {kUnknown, kCapital});
    }
    in_number = is_digit;
  }
  return line;
}

Result<void> check_braille_table(const std::string& table) {
  const auto tables = installed_tables();
  if (tables.empty() || tables.contains(table)) return {};
  std::set<std::string> same, languages;
  for (const std::string& one : tables) {
    languages.insert(language_of(one));
    if (language_of(one) == language_of(table)) same.insert(one);
  }
  const std::string there =
      same.empty() ? fmt::format("their names begin with {}", fmt::join(languages, ", "))
                   : fmt::format("of \"{}\" there are {}", language_of(table), fmt::join(same, ", "));
  return Error{ErrorCode::usage, fmt::format("liblouis has no braille table \"{}\"; {}", table, there), {}};
}

Result<std::vector<BrailleLine>> translated_braille(std::span<const std::string> lines,
                                                    const std::string& table) {
  constexpr std::string_view kOfNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  if (table.empty() || table.front() == '-' || table.find_first_not_of(kOfNames) != std::string::npos)
    return Error{ErrorCode::usage, "'" + table + "' is no table of liblouis, as en-ueb-g1.ctb", {}};
  std::string text;
  for (const std::string& line : lines) {
    for (const char c : line) {
      // A backslash begins a character by its number there.
      if (c == '\\') text += c;
      text += c == '\n' ? ' ' : c;
    }
    text += '\n';
  }
  Descriptor in = memory_file("palpable-text"), out = memory_file("palpable-braille");
  if (in.number() < 0 || out.number() < 0 || !write_whole(in, text))
    return Error{ErrorCode::failed, "no memory for the braille translation", {}};
  const std::array<int, 2> descriptors{in.number(), out.number()};
  const auto child = start_child(
      "/bin/sh", {"-c", "exec lou_translate \"$0\" <&3 >&4", "unicode.dis," + table}, descriptors);
  if (!child) return child.error();
  const auto code = wait_for(*child);
  constexpr int kNotFound = 127;
  if (code == kNotFound)
    return Error{ErrorCode::failed, "lou_translate is not installed: apt install liblouis-bin", {}};
  auto translated = lines_of_patterns(read_whole(out));
  if (code != 0 || translated.size() != lines.size())
    return Error{ErrorCode::failed, "lou_translate failed with the table " + table, {}};
  return translated;
}

Result<std::vector<bool>> writable_in_braille(std::span<const std::string> lines, const std::string& table) {
  std::vector<bool> writable(lines.size(), true);
  std::set<std::string> distinct;
  for (const std::string& line : lines)
    for (std::string& c : beyond_ascii(line)) distinct.insert(std::move(c));
  if (distinct.empty()) return writable;
  // U+E000 is for private use: no table knows it.
  std::vector<std::string> asked{"\xEE\x80\x80"};
  asked.insert(asked.end(), distinct.begin(), distinct.end());
  const auto cells = translated_braille(asked, table);
  if (!cells) return cells.error();
  std::set<std::string> unknown;
  for (std::size_t k = 1; k < asked.size(); ++k)
    if (is_by_number((*cells)[k], cells->front())) unknown.insert(asked[k]);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::string& c : beyond_ascii(lines[i]))
      if (unknown.contains(c)) writable[i] = false;
  return writable;
}

}  // namespace palpable::formats
