// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::device {

/// A device URL, scheme:path?name=value&name=value. Options are taken one by one; an option that is left at
/// the end is an error, so that a misspelt one is never ignored silently.
class DeviceUrl {
 public:
  /// Errors (usage): no scheme, an option without a value or given twice.
  static Result<DeviceUrl> parse(std::string_view url);

  /// The whole URL, as it was parsed.
  const std::string& text() const { return url_; }
  const std::string& scheme() const { return scheme_; }
  const std::string& path() const { return path_; }

  /// The path as the number of a device, 0 to `most`; -1 if it is empty. Errors: usage.
  Result<int> path_number(int most) const;

  /// The option as a number in [least, most], or `otherwise` if it is not given. An invalid value is reported
  /// by finish().
  double take_number(const std::string& name, double otherwise, double least, double most);
  /// The same of a whole number.
  int take_count(const std::string& name, int otherwise, int least, int most);
  /// The option as one of `allowed`; the first of them if it is not given.
  std::string take_word(const std::string& name, const std::vector<std::string>& allowed);
  /// The option as text; empty if it is not given.
  std::string take_text(const std::string& name);
  /// The error if a value was invalid or an option is left. Call it before using the values, and before
  /// anything is opened.
  Result<void> finish();

  /// From now on finish() returns an error in any case, so that a driver's open() opens nothing.
  void check_only() { only_check_ = true; }
  /// finish() was called, and found nothing wrong.
  bool is_valid() const { return is_valid_; }

 private:
  /// The text of an option, which is not empty; nullopt if it is not given.
  std::optional<std::string> extract(const std::string& name);
  void fail(std::string message);

  std::string url_;
  std::string scheme_;
  std::string path_;
  std::map<std::string, std::string> options_;
  /// The names that were asked for: the options that there are.
  std::string known_;
  bool only_check_ = false;
  bool is_valid_ = false;
  std::string first_error_;
};

/// A URL as it may be shown and kept: the value of the option token is replaced by "…".
std::string public_url(std::string_view url);
/// The same as the place of an error: "2diy:" without its colon, which the sentence has.
std::string url_as_place(std::string_view url);

}  // namespace palpable::device
