// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace palpable::page::shelf {

/// What a scene of this kind (SceneCard::kind) can be saved as: names for protocol::SaveAs::form.
std::vector<std::string> forms_of(std::string_view kind);

/// How a scene is saved as another file.
struct SaveWords {
  /// ".html".
  std::string suffix;
  /// Options of `palpable export`, without the scene and the output.
  std::vector<std::string> options;
  /// The file is the scene's own, which nothing is to be made of.
  bool is_copy = false;
};

/// Errors: usage, with a sentence for the person, for a form that a scene of this kind does not have, and for
/// an unknown paper.
Result<SaveWords> save_words(const protocol::SaveAs& wanted, std::string_view kind);

}  // namespace palpable::page::shelf
