// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/ask_to_hold.hpp"

#include "palpable/cli/say_aloud.hpp"

#include <poll.h>
#include <unistd.h>

namespace palpable::cli {

void wait_for_line(int descriptor) {
  constexpr int kPatience_ms = 50;
  while (!interrupted()) {
    pollfd waited{descriptor, POLLIN, 0};
    if (::poll(&waited, 1, kPatience_ms) <= 0) continue;
    // Byte by byte: what follows the line belongs to others.
    char c = 0;
    if (::read(descriptor, &c, 1) <= 0 || c == '\n') return;
  }
}

std::function<void(const std::string& sentence)> ask_to_hold(Speech speech, Console& console) {
  return [speech, &console](const std::string& sentence) {
    const bool waits = ::isatty(STDIN_FILENO) == 1;
    const std::string words = sentence + (waits ? "; then press Enter." : ".");
    console.say(words);
    if (speech == Speech::on) say_aloud(words, console);
    if (waits) wait_for_line(STDIN_FILENO);
  };
}

}  // namespace palpable::cli
