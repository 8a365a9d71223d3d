// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/options.hpp"

#include "palpable/cli/input_files.hpp"
#include "palpable/cli/output_files.hpp"
#include "palpable/cli/suggest.hpp"
#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace palpable::cli {
namespace {

/// A check whose error lists the allowed words, instead of CLI11's own.
CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](std::string& typed) { return unknown_word(typed, words); },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

template <class Number>
CLI::Validator within(Range range) {
  const char* const what = std::is_integral_v<Number> ? "a whole number" : "a number";
  return {[range, what](std::string& typed) -> std::string {
            const auto whole = whole_number(typed);
            const auto value = std::is_integral_v<Number> && !whole ? std::nullopt : finite_number(typed);
            if (value && *value >= range.least && *value <= range.most) return {};
            return fmt::format("'{}' is not {} from {} to {}", typed, what, range.least, range.most);
          },
          fmt::format("[{} to {}]", range.least, range.most)};
}

/// For a text: an empty one is probably a mistake (an unset variable in a script).
CLI::Validator not_empty() {
  return {[](std::string& typed) -> std::string { return typed.empty() ? "the value is empty" : ""; }, ""};
}

}  // namespace

void Options::argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->required()->check(not_empty());
}

void Options::optional_argument(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->check(not_empty());
}

void Options::optional_arguments(const std::string& name, std::vector<std::string>& values, int most,
                                 const std::string& help) {
  app_.add_option(name, values, help)->expected(0, most)->check(not_empty());
}

void Options::arguments(const std::string& name, std::vector<std::string>& values, int most,
                        const std::string& help) {
  app_.add_option(name, values, help)->expected(1, most)->check(not_empty());
}

void Options::flag(const std::string& name, bool& value, const std::string& help) {
  app_.add_flag(name, value, help)->group(heading_)->disable_flag_override();
}

void Options::text(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->check(not_empty());
}

void Options::texts(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  app_.add_option(name, values, help)->group(heading_)->allow_extra_args(false)->check(not_empty());
}

void Options::required_text(const std::string& name, std::string& value, const std::string& help) {
  app_.add_option(name, value, help)->group(heading_)->required()->check(not_empty());
}

void Options::required_output(const std::string& name, std::string& value,
                              const std::vector<std::string>& suffixes, const std::string& help) {
  required_text(name, value, help);
  outputs_.push_back({&app_, app_.get_options().back(), &value, suffixes});
}

void Options::output(const std::string& name, std::string& value, const std::vector<std::string>& suffixes,
                     const std::string& help) {
  text(name, value, help);
  outputs_.push_back({&app_, app_.get_options().back(), &value, suffixes});
}

void Options::last_output_writes(OutputOption::FilesFor files_for) {
  outputs_.back().files_for = std::move(files_for);
}

void Options::output_folder(const std::string& name, std::string& value, const std::string& help) {
  output(name, value, {}, help);
  outputs_.back().kind = OutputOption::Kind::folder;
}

std::function<Result<void>()> Options::output_check(const std::string& name, const std::string& value,
                                                    const std::vector<std::string>& suffixes) const {
  return [app = &app_, outputs = &outputs_, option = app_.get_option(name), value = &value, suffixes] {
    std::vector<OutputOption> all = *outputs;
    all.push_back({app, option, value, suffixes});
    return check_outputs(*app, all);
  };
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

std::function<std::vector<std::string>()> Options::given() const {
  return [app = &app_] {
    std::vector<std::string> names;
    for (const CLI::Option* option : app->get_options())
      if (option->count() > 0) names.push_back(option->get_name());
    return names;
  };
}

std::function<std::vector<std::string>()> Options::repeated() const {
  return [app = &app_, outputs = &outputs_] {
    const std::vector<std::string> no_result{"--help", "--json", "--progress-to", "--quiet", "--threads"};
    std::vector<std::string> arguments, options;
    for (const CLI::Option* option : app->get_options()) {
      const auto& values = option->results();
      const auto is_option = [option](const OutputOption& output) { return output.option == option; };
      const bool is_output = std::any_of(outputs->begin(), outputs->end(), is_option);
      if (option->get_positional()) {
        // A name that begins with a dash would be read as an option.
        for (const std::string& value : values)
          arguments.push_back(value.starts_with("-") ? "./" + value : value);
      } else if (!is_output &&
                 std::find(no_result.begin(), no_result.end(), option->get_name()) == no_result.end()) {
        const bool is_flag = option->get_expected_max() == 0;
        for (const std::string& value : values)
          options.push_back(is_flag ? option->get_name() : option->get_name() + "=" + value);
      }
    }
    arguments.insert(arguments.begin(), app->get_name());
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  };
}

std::function<std::vector<std::filesystem::path>()> Options::input_files() const {
  return [app = &app_, outputs = &outputs_] {
    return InputFiles(input_words(*app, *outputs)).regular_files(InputFiles::Folders::included);
  };
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

void Options::count(const std::string& name, std::uint64_t& value, const std::string& help) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<std::int64_t>::max());
  CLI::Validator check = within<std::int64_t>({0.0, kMost});
  check.description("[0 or more]");
  app_.add_option(name, value, help)->group(heading_)->check(check);
}

}  // namespace palpable::cli
