// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include <termios.h>

namespace palpable::cli {

/// A key that a person pressed in a terminal.
struct TerminalKey {
  enum class Name { character, left, right, up, down, page_up, page_down, home };
  Name name = Name::character;
  /// Of `character`: its lower-case letter.
  char character = '\0';
  /// Of an arrow: together with Shift.
  bool shift = false;
  bool operator==(const TerminalKey&) const = default;
};

/// Takes the first key out of the bytes that a terminal sent (ECMA-48, xterm). nullopt where there is none,
/// or where what follows may complete an escape sequence; sequences of other keys are skipped.
std::optional<TerminalKey> take_key(std::string& bytes);

/// The keys of standard input, one by one: a terminal is switched to sending each key at once and without
/// echo, and back when this ends. One thread.
class TerminalKeys {
 public:
  TerminalKeys();
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Waits for the next key, at most that long.
  std::optional<TerminalKey> next(std::chrono::milliseconds patience);
  /// Whether a key can be taken without waiting.
  bool waiting() const { return !bytes_.empty(); }
  /// Standard input has ended, and every key of it was taken.
  bool ended() const { return ended_ && bytes_.empty(); }

 private:
  std::string bytes_;
  bool ended_ = false;
  std::optional<termios> before_;
};

}  // namespace palpable::cli
