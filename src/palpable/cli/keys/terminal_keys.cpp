// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/keys/terminal_keys.hpp"

#include <array>
#include <cctype>

#include <poll.h>
#include <unistd.h>

namespace palpable::cli {
namespace {

constexpr char kEscape = '\x1b';

/// An escape sequence without its "ESC [" and its last character.
std::optional<TerminalKey> key_of(const std::string& parameters, char last) {
  using enum TerminalKey::Name;
  const bool shift = parameters.ends_with(";2");
  switch (last) {
    case 'A':
      return TerminalKey{up, '\0', shift};
    case 'B':
      return TerminalKey{down, '\0', shift};
    case 'C':
      return TerminalKey{right, '\0', shift};
    case 'D':
      return TerminalKey{left, '\0', shift};
    case 'H':
      return TerminalKey{home};
    case 'F':
      return TerminalKey{end};
    case '~':
      if (parameters == "1" || parameters == "7") return TerminalKey{home};
      if (parameters == "4" || parameters == "8") return TerminalKey{end};
      if (parameters == "5") return TerminalKey{page_up};
      if (parameters == "6") return TerminalKey{page_down};
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<TerminalKey> take_key(std::string& bytes) {
  while (!bytes.empty()) {
    if (bytes.front() != kEscape) {
      const auto character = static_cast<unsigned char>(bytes.front());
      bytes.erase(0, 1);
      return TerminalKey{TerminalKey::Name::character, static_cast<char>(std::tolower(character))};
    }
    if (bytes.size() < 2) return std::nullopt;
    if (bytes[1] != '[' && bytes[1] != 'O') {
      bytes.erase(0, 1);
      continue;
    }
    std::size_t end = 2;
    while (end < bytes.size() &&
           (std::isdigit(static_cast<unsigned char>(bytes[end])) != 0 || bytes[end] == ';'))
      ++end;
    if (end == bytes.size()) return std::nullopt;
    const auto key = key_of(bytes.substr(2, end - 2), bytes[end]);
    bytes.erase(0, end + 1);
    if (key) return key;
  }
  return std::nullopt;
}

TerminalKeys::TerminalKeys() {
  termios settings{};
  if (tcgetattr(STDIN_FILENO, &settings) != 0) return;
  before_ = settings;
  set_lines(false);
}

TerminalKeys::~TerminalKeys() {
  if (before_) tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

void TerminalKeys::set_lines(bool lines) {
  reads_lines_ = lines;
  if (!before_) return;
  termios settings = *before_;
  if (!lines) settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &settings);
}

bool TerminalKeys::read_more(std::chrono::milliseconds patience) {
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (poll(&wait, 1, static_cast<int>(patience.count())) <= 0) return false;
  std::array<char, 256> read_bytes{};
  const ssize_t count = read(STDIN_FILENO, read_bytes.data(), read_bytes.size());
  if (count > 0)
    bytes_.append(read_bytes.data(), static_cast<std::size_t>(count));
  else
    ended_ = true;
  return true;
}

std::optional<std::string> TerminalKeys::next_line(std::chrono::milliseconds patience) {
  if (!reads_lines_) set_lines(true);
  constexpr std::size_t kLongest = 16384;
  if (bytes_.find('\n') == std::string::npos && !ended_ && bytes_.size() < kLongest) read_more(patience);
  const std::size_t end = bytes_.find('\n');
  if (end == std::string::npos && !ended_ && bytes_.size() < kLongest) return std::nullopt;
  std::string line = bytes_.substr(0, end);
  bytes_.erase(0, end == std::string::npos ? end : end + 1);
  set_lines(false);
  return line;
}

std::optional<TerminalKey> TerminalKeys::next(std::chrono::milliseconds patience) {
  if (auto key = take_key(bytes_)) return key;
  if (ended_) {
    bytes_.clear();
    return std::nullopt;
  }
  if (!read_more(patience)) {
    // The Escape key alone: nothing followed it.
    if (bytes_ == std::string(1, kEscape)) bytes_.clear();
    return std::nullopt;
  }
  return take_key(bytes_);
}

}  // namespace palpable::cli
