// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/check.hpp"
#include "palpable/core/reason.hpp"

#include <string>
#include <utility>
#include <variant>

namespace palpable {

/// The kind of an error; the values are the exit codes of the command line (docs/cli.md).
enum class ErrorCode { failed = 1, usage = 2, invalid_input = 3, device = 4, interrupted = 130 };

/// An external error: one sentence for the user and the place (a file, an address, an argument).
struct Error {
  ErrorCode code = ErrorCode::failed;
  /// One sentence without the place and without a full stop.
  std::string message;
  /// The file, device or argument that the message is about; may be empty.
  std::string place;
  /// For programs: what the caller could change. The message does not name any option.
  Reason reason = Reason::unspecified;

  /// "place: message", or the message alone.
  std::string sentence() const { return place.empty() ? message : place + ": " + message; }
};

inline Error invalid_input(std::string message, std::string place = {}, Reason reason = Reason::unspecified) {
  return {ErrorCode::invalid_input, std::move(message), std::move(place), reason};
}

/// A value or an Error, with the member names of std::expected. Calling value() or operator* on an error is a
/// bug and aborts.
template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  T& value() & { return PALPABLE_CHECK(has_value()), std::get<0>(content_); }
  const T& value() const& { return PALPABLE_CHECK(has_value()), std::get<0>(content_); }
  T&& value() && { return PALPABLE_CHECK(has_value()), std::get<0>(std::move(content_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  Error& error() & { return PALPABLE_CHECK(!has_value()), std::get<1>(content_); }
  const Error& error() const& { return PALPABLE_CHECK(!has_value()), std::get<1>(content_); }
  Error&& error() && { return PALPABLE_CHECK(!has_value()), std::get<1>(std::move(content_)); }

 private:
  std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::in_place_index<1>, std::move(error)) {}
  bool has_value() const { return error_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  const Error& error() const& { return PALPABLE_CHECK(!has_value()), std::get<1>(error_); }
  Error&& error() && { return PALPABLE_CHECK(!has_value()), std::get<1>(std::move(error_)); }

 private:
  std::variant<std::monostate, Error> error_;
};

}  // namespace palpable
