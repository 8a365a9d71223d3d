// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's own name
class App;
class FormatterBase;
}  // namespace CLI

namespace palpable::cli {

/// The formatter of help texts: "INPUT..." for several arguments, "NUMBER, 0.1 to 10" for a number and its
/// range, "a|b|c" for a choice.
std::shared_ptr<CLI::FormatterBase> help_format();

/// Converts CLI11's message about a wrong number of values, "--size: 1 required TEXT missing", to a sentence.
std::string mismatch_sentence(const std::string& complaint);

}  // namespace palpable::cli
