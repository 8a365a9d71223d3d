// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/note.hpp"
#include "palpable/core/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace palpable::cli {

/// The options that would change the fact behind a reason, as "--calibration FILE"; empty if there are none.
std::string_view hint_for(Reason reason);

/// An error or a note with the options that would help: "…: give --calibration FILE".
std::string sentence_of(const Error& error);
std::string sentence_of(const Note& note);
std::vector<std::string> sentences_of(const std::vector<Note>& notes);

}  // namespace palpable::cli
