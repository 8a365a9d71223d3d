// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/arguments/title_options.hpp"

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <utility>

#include <fmt/format.h>

namespace palpable::cli {
namespace {

Error usage(std::string message, const char* option) {
  return {ErrorCode::usage, std::move(message), option};
}

std::string trimmed(const std::string& text) {
  constexpr const char* kWhite = " \t\r\n";
  const auto begin = text.find_first_not_of(kWhite);
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(kWhite) - begin + 1);
}

Result<void> check(const std::string& text, std::size_t longest, const char* option) {
  if (!is_utf8(text)) return usage("the text is not UTF-8", option);
  if (has_control_characters(text)) return usage("the text holds control characters", option);
  if (text.size() > longest)
    return usage(fmt::format("the text has {} bytes, and {} are allowed", text.size(), longest), option);
  return {};
}

}  // namespace

void add_title_options(Options& options, TitleArguments& arguments) {
  options.text("--title", arguments.title, "What the scene is called: shown, and spoken when a touch begins");
  options.text("--describe", arguments.description,
               "A description of the scene for the user; @FILE reads it from a text file");
}

Result<TitleArguments> read_title(TitleArguments arguments) {
  if (arguments.description.starts_with('@')) {
    if (arguments.description.size() == 1)
      return usage("@ is followed by the name of a text file", "--describe");
    // White space around the description does not count.
    constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 20U;
    static_assert(kMaxBytes > models::kMaxDescriptionBytes);
    auto text = read_text_file(arguments.description.substr(1), kMaxBytes);
    if (!text) return text.error();
    arguments.description = with_plain_lines(*text);
  }
  TitleArguments title{trimmed(arguments.title), trimmed(arguments.description)};
  if (title.title.find('\n') != std::string::npos) return usage("a title is one line", "--title");
  if (const auto fits = check(title.title, models::kMaxTitleBytes, "--title"); !fits) return fits.error();
  if (const auto fits = check(title.description, models::kMaxDescriptionBytes, "--describe"); !fits)
    return fits.error();
  return title;
}

void apply_title(const TitleArguments& title, models::Scene& scene) {
  if (!title.title.empty()) scene.title = title.title;
  if (!title.description.empty()) scene.description = title.description;
}

}  // namespace palpable::cli
