// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/say_aloud.hpp"

#include "palpable/voice/speaker.hpp"

namespace palpable::cli {

void say_aloud(std::string_view sentence, Console& console) {
  auto speaker = voice::open_speaker();
  if (!speaker) return console.note(speaker.error().sentence());
  if (const auto said = (*speaker)->say(sentence); !said) return console.note(said.error().sentence());
  (*speaker)->finish();
}

}  // namespace palpable::cli
