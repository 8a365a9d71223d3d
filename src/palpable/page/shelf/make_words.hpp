// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/page/protocol.gen.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace palpable::page::shelf {

/// How a scene is made, as command lines of `palpable make` without the output.
struct MakeWords {
  std::vector<std::string> words;
  /// A faster command whose scene is touched until that of `words` is ready; empty: none.
  std::vector<std::string> quick_words;
};

/// The command for files that a home page has sent and what the person said of them. Errors: usage, with a
/// sentence for the person, for an unknown choice or a number of files that does not fit it.
Result<MakeWords> make_words(const protocol::Make& wanted, const std::vector<std::filesystem::path>& files);

}  // namespace palpable::page::shelf
