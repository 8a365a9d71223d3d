// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/reason.hpp"

#include <string>
#include <utility>

namespace palpable {

/// What a person should know about a result: one sentence with its full stop, and where the caller could have
/// changed it, the reason. A plain sentence converts to a note.
struct Note {
  Note(std::string text, Reason why = Reason::unspecified) : sentence(std::move(text)), reason(why) {}
  Note(const char* text, Reason why = Reason::unspecified) : sentence(text), reason(why) {}
  friend bool operator==(const Note&, const Note&) = default;

  std::string sentence;
  Reason reason;
};

}  // namespace palpable
