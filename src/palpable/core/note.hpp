// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/reason.hpp"

#include <string>
#include <utility>

namespace palpable {

/// Information about a result: one sentence with its full stop, and a reason if the caller could have changed
/// it. A plain string converts to a note.
struct Note {
  Note(std::string text, Reason why = Reason::unspecified) : sentence(std::move(text)), reason(why) {}
  Note(const char* text, Reason why = Reason::unspecified) : sentence(text), reason(why) {}
  friend bool operator==(const Note&, const Note&) = default;

  std::string sentence;
  Reason reason;
};

}  // namespace palpable
