// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <string>
#include <utility>
#include <vector>

namespace palpable {

/// A vendor's library that is opened at run time, so that Palpable neither contains nor needs it. It stays
/// loaded until the program ends: some of these libraries cannot be loaded twice.
class SharedLibrary {
 public:
  /// Opens `file`, or if it is empty the first that is found of `names` (such as "libdhd.so", also with a
  /// version behind it: "libdhd.so.3"), where the system looks for libraries and in /usr/local/lib and
  /// /opt/*/lib. Errors (device): none is found; one is found but cannot be loaded, with the system's reason
  /// (another architecture, a library that it needs).
  static Result<SharedLibrary> open(const std::string& file, const std::vector<std::string>& names);

  /// Stores the function of this name in `function`. Errors (device): the library has none.
  template <class Function>
  Result<void> bind(Function*& function, const char* name) const {
    auto found = address_of(name);
    if (!found) return std::move(found).error();
    function = reinterpret_cast<Function*>(*found);
    return {};
  }

 private:
  SharedLibrary(void* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
  Result<void*> address_of(const char* name) const;

  void* handle_;
  std::string name_;
};

}  // namespace palpable
