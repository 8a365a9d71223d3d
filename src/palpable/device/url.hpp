// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::device {

/// scheme:path?name=value&name=value. The options are taken out one by one; what is left at the end is an
/// error, so that a misspelt option is never silently ignored.
class DeviceUrl {
 public:
  /// Errors (usage): no scheme, an option without a value or given twice.
  static Result<DeviceUrl> parse(std::string_view url);

  const std::string& scheme() const { return scheme_; }
  const std::string& path() const { return path_; }

  /// The option as a number in [least, most], or `otherwise` where it is not given. A value that is no number
  /// or outside is remembered for finish().
  double take_number(const std::string& name, double otherwise, double least, double most);
  /// The option as one of `allowed`; the first of them where it is not given.
  std::string take_word(const std::string& name, const std::vector<std::string>& allowed);
  /// The option as it stands; empty where it is not given.
  std::string take_text(const std::string& name);
  /// An error if a value was wrong or an option remains; say it before using what was taken.
  Result<void> finish() const;

 private:
  void fail(std::string message);

  std::string url_;
  std::string scheme_;
  std::string path_;
  std::map<std::string, std::string> options_;
  std::string first_error_;
};

}  // namespace palpable::device
