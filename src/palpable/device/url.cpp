// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/url.hpp"

#include "palpable/core/text/number_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace palpable::device {
namespace {

std::string shown(double number) {
  std::string text(32, ' ');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}

}  // namespace

Result<DeviceUrl> DeviceUrl::parse(std::string_view url) {
  const auto usage = [&](std::string message) {
    return Error{ErrorCode::usage, std::move(message), url_as_place(url)};
  };
  DeviceUrl parsed;
  parsed.url_ = url;
  const auto colon = url.find(':');
  if (colon == std::string_view::npos && !url.empty())
    return usage("a device is named by a scheme and a colon: write " + public_url(url) + ":");
  if (colon == std::string_view::npos || colon == 0)
    return usage("a device is named by a scheme and a colon, such as sim: or pointer:");
  parsed.scheme_ = url.substr(0, colon);
  std::ranges::transform(parsed.scheme_, parsed.scheme_.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string_view rest = url.substr(colon + 1);
  const auto question = rest.find('?');
  parsed.path_ = rest.substr(0, question);
  rest = question == std::string_view::npos ? std::string_view{} : rest.substr(question + 1);
  while (!rest.empty()) {
    const auto part = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    const auto equals = part.find('=');
    if (equals == std::string_view::npos || equals == 0)
      return usage("an option is written name=value, not \"" + std::string(part) + "\"");
    if (!parsed.options_.emplace(part.substr(0, equals), part.substr(equals + 1)).second)
      return usage("the option " + std::string(part.substr(0, equals)) + " is given twice");
  }
  return parsed;
}

Result<int> DeviceUrl::path_number(int most) const {
  if (path_.empty()) return -1;
  const auto number = finite_number(path_);
  if (!number || *number != std::floor(*number) || *number < 0.0 || *number > most)
    return Error{ErrorCode::usage, "the number of a device is 0 to " + std::to_string(most),
                 scheme_ + ":" + path_};
  return static_cast<int>(*number);
}

std::optional<std::string> DeviceUrl::extract(const std::string& name) {
  known_ += (known_.empty() ? "" : ", ") + name;
  const auto option = options_.extract(name);
  if (option.empty()) return std::nullopt;
  if (option.mapped().empty()) fail(name + " is given without a value");
  return option.mapped();
}

double DeviceUrl::take_number(const std::string& name, double otherwise, double least, double most) {
  const auto text = extract(name);
  if (!text) return otherwise;
  const auto number = finite_number(*text);
  if (number && *number >= least && *number <= most) return *number;
  fail(name + " must be a number from " + shown(least) + " to " + shown(most) + ", not \"" + *text + "\"");
  return otherwise;
}

int DeviceUrl::take_count(const std::string& name, int otherwise, int least, int most) {
  const double number = take_number(name, otherwise, least, most);
  if (number == std::floor(number)) return static_cast<int>(number);
  fail(name + " must be a whole number");
  return otherwise;
}

std::string DeviceUrl::take_word(const std::string& name, const std::vector<std::string>& allowed) {
  const auto text = extract(name);
  if (!text) return allowed.front();
  if (std::find(allowed.begin(), allowed.end(), *text) != allowed.end()) return *text;
  std::string list = allowed.front();
  for (std::size_t i = 1; i < allowed.size(); ++i) list += ", " + allowed[i];
  fail(name + " must be one of " + list + ", not \"" + *text + "\"");
  return allowed.front();
}

std::string DeviceUrl::take_text(const std::string& name) { return extract(name).value_or(std::string()); }

Result<void> DeviceUrl::finish() {
  const auto usage = [&](std::string message) {
    return Error{ErrorCode::usage, std::move(message), url_as_place(url_)};
  };
  if (!first_error_.empty()) return usage(first_error_);
  if (!options_.empty())
    return usage(scheme_ + ": has no option " + options_.begin()->first +
                 (known_.empty() ? " (it has none)" : " (known: " + known_ + ")"));
  is_valid_ = true;
  return only_check_ ? Result<void>(usage("is only checked")) : Result<void>{};
}

void DeviceUrl::fail(std::string message) {
  if (first_error_.empty()) first_error_ = std::move(message);
}

std::string public_url(std::string_view url) {
  std::string shown(url);
  for (const std::string_view before : {"?token=", "&token="})
    for (auto at = shown.find(before); at != std::string::npos; at = shown.find(before, at + 1)) {
      const auto begin = at + before.size();
      shown.replace(begin, std::min(shown.find('&', begin), shown.size()) - begin, "…");
    }
  return shown;
}

std::string url_as_place(std::string_view url) {
  std::string place = public_url(url);
  if (place.ends_with(':')) place.pop_back();
  return place;
}

}  // namespace palpable::device
