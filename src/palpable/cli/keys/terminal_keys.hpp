// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include <termios.h>

namespace palpable::cli {

/// A key that a user pressed in a terminal.
struct TerminalKey {
  enum class Name { character, left, right, up, down, page_up, page_down, home, end };
  Name name = Name::character;
  /// For `character`: the lower-case letter.
  char character = '\0';
  /// For an arrow: pressed together with Shift.
  bool shift = false;
  bool operator==(const TerminalKey&) const = default;
};

/// Removes the first key from the bytes that a terminal sent (ECMA-48, xterm). nullopt if there is none, or
/// if the bytes may be the start of an escape sequence; sequences of other keys are skipped.
std::optional<TerminalKey> take_key(std::string& bytes);

/// Reads keys from standard input. A terminal is switched to unbuffered input without echo, and back in the
/// destructor. One thread.
class TerminalKeys {
 public:
  TerminalKeys();
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Waits for the next key, at most `patience`.
  std::optional<TerminalKey> next(std::chrono::milliseconds patience);
  /// Waits for a line that the user types, at most `patience`; a terminal shows it meanwhile. Characters of a
  /// line that is not complete are kept for the next call. At the end of the input what there is of a line.
  std::optional<std::string> next_line(std::chrono::milliseconds patience);
  /// Whether a key can be taken without waiting.
  bool waiting() const { return !bytes_.empty(); }
  /// Whether standard input has ended and all keys were taken.
  bool ended() const { return ended_ && bytes_.empty(); }

 private:
  /// Reads what comes within `patience`; false if nothing did.
  bool read_more(std::chrono::milliseconds patience);
  /// Whether a terminal sends whole lines and shows them.
  void set_lines(bool lines);

  std::string bytes_;
  bool reads_lines_ = false;
  bool ended_ = false;
  std::optional<termios> before_;
};

}  // namespace palpable::cli
