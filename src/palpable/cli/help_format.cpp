// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/help_format.hpp"

#include <algorithm>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// CLI11 formats a type and its check as "FLOAT:[0.1 to 10]" or "TEXT:{a,b}".
std::string plain_type(const std::string& type) {
  const std::size_t colon = type.find(':');
  const std::string base = type.substr(0, colon);
  const bool is_number = base == "FLOAT" || base == "INT" || base == "UINT";
  std::string plain = is_number ? "NUMBER" : base;
  if (colon == std::string::npos || colon + 2 >= type.size()) return plain;
  std::string check = type.substr(colon + 2, type.size() - colon - 3);
  if (is_number) return plain + ", " + check;
  std::replace(check.begin(), check.end(), ',', '|');
  return check;
}

class PlainFormat final : public CLI::Formatter {
 public:
  PlainFormat() {
    label("Positionals", "Arguments");
    label("OPTIONS", "OPTION...");
    label("SUBCOMMAND", "COMMAND");
    column_width(34);
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return {};
    std::string words = " " + plain_type(option->get_type_name());
    if (!option->get_default_str().empty()) words += fmt::format(" (default {})", option->get_default_str());
    if (option->get_required()) words += " (required)";
    return words;
  }

  std::string make_option_usage(const CLI::Option* option) const override {
    const std::string name =
        make_option_name(option, true) + (option->get_items_expected_max() > 1 ? "..." : "");
    return option->get_required() ? name : "[" + name + "]";
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> help_format() { return std::make_shared<PlainFormat>(); }

std::string mismatch_sentence(const std::string& complaint) {
  const std::string name = complaint.substr(0, complaint.find_first_of(": "));
  const auto says = [&complaint](std::string_view words) {
    return complaint.find(words) != std::string::npos;
  };
  if (says("flag override"))
    return (name.starts_with("-") ? "" : "--") + name.substr(0, name.find(' ')) + " takes no value";
  if (says("At Most")) return name + " is given more than once";
  return name + " needs a value";
}

}  // namespace palpable::cli
