// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/options.hpp"

#include <CLI/CLI.hpp>

namespace palpable::cli {

void Options::argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->required();
}

void Options::optional_argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help);
}

void Options::arguments(const std::string& name, std::vector<std::string>& values, int most,
                        const std::string& help) {
  app_.add_option(name, values, help)->expected(1, most);
}

void Options::flag(const std::string& name, bool& value, const std::string& help) {
  app_.add_flag(name, value, help)->group(heading_);
}

void Options::text(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_);
}

void Options::texts(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  app_.add_option(name, values, help)->group(heading_)->allow_extra_args(false);
}

void Options::required_text(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->required();
}

void Options::choice(const std::string& name, std::string& value, const std::vector<std::string>& words,
                     const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->check(CLI::IsMember(words))->capture_default_str();
}

void Options::number(const std::string& name, double& value, Range range, const std::string& help) {
  app_.add_option(name, value, help)
      ->group(heading_)
      ->check(CLI::Range(range.least, range.most))
      ->capture_default_str();
}

void Options::number(const std::string& name, std::optional<double>& value, Range range,
                     const std::string& help) {
  app_.add_option_function<double>(
          name, [&value](double given) { value = given; }, help)
      ->group(heading_)
      ->check(CLI::Range(range.least, range.most));
}

void Options::integer(const std::string& name, int& value, Range range, const std::string& help) {
  app_.add_option(name, value, help)
      ->group(heading_)
      ->check(CLI::Range(static_cast<int>(range.least), static_cast<int>(range.most)));
}

}  // namespace palpable::cli
