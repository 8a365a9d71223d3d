// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/options.hpp"

#include "palpable/cli/suggest.hpp"

#include <charconv>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// Errors that list what is allowed, in place of CLI11's own.
CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](std::string& typed) { return unknown_word(typed, words); },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

template <class Number>
CLI::Validator within(Range range) {
  const char* const what = std::is_integral_v<Number> ? "a whole number" : "a number";
  return {[range, what](std::string& typed) -> std::string {
            Number value{};
            const char* const end = typed.data() + typed.size();
            const auto [stop, fault] = std::from_chars(typed.data(), end, value);
            if (fault == std::errc{} && stop == end && value >= range.least && value <= range.most) return {};
            return fmt::format("'{}' is not {} from {} to {}", typed, what, range.least, range.most);
          },
          fmt::format("[{} to {}]", range.least, range.most)};
}

}  // namespace

void Options::argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->required();
}

void Options::optional_argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help);
}

void Options::optional_arguments(const std::string& name, std::vector<std::string>& values, int most,
                                 const std::string& help) {
  app_.add_option(name, values, help)->expected(0, most);
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
  app_.add_option(name, value, help)->group(heading_)->check(one_of(words))->capture_default_str();
}

void Options::number(const std::string& name, double& value, Range range, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->check(within<double>(range))->capture_default_str();
}

void Options::number(const std::string& name, std::optional<double>& value, Range range,
                     const std::string& help) {
  app_.add_option_function<double>(
          name, [&value](double given) { value = given; }, help)
      ->group(heading_)
      ->check(within<double>(range));
}

void Options::integer(const std::string& name, int& value, Range range, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->check(within<int>(range));
}

void Options::integer(const std::string& name, std::optional<int>& value, Range range,
                      const std::string& help) {
  app_.add_option_function<int>(
          name, [&value](int given) { value = given; }, help)
      ->group(heading_)
      ->check(within<int>(range));
}

}  // namespace palpable::cli
