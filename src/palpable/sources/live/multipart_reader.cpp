// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/live/multipart_reader.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// The value of the field `name` (in small letters) of a header; empty if it has none.
std::string_view field(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const auto end = std::min(header.find('\n'), header.size());
    const auto line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    const auto colon = line.find(':');
    if (colon != std::string_view::npos && lower(trimmed(line.substr(0, colon))) == name)
      return trimmed(line.substr(colon + 1));
  }
  return {};
}

/// A whole number of nothing but digits.
std::optional<std::uint64_t> number(std::string_view text, int base) {
  std::uint64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The boundary without the lines that many cameras write into it.
std::string boundary_of(std::string_view type) {
  constexpr std::string_view kName = "boundary=";
  const auto at = lower(type).find(kName);
  if (at == std::string::npos) return {};
  auto value = type.substr(at + kName.size());
  if (value.starts_with('"')) {
    value.remove_prefix(1);
    value = value.substr(0, value.find('"'));
  } else {
    value = trimmed(value.substr(0, value.find(';')));
  }
  value.remove_prefix(std::min(value.find_first_not_of('-'), value.size()));
  return std::string(value);
}

/// Errors for an answer of another kind, by its first line.
Result<void> check_status(std::string_view line) {
  if (!line.starts_with("HTTP/") || line.find(' ') == std::string_view::npos)
    return invalid_input("does not answer as an HTTP server");
  const auto status = number(line.substr(line.find(' ') + 1).substr(0, 3), 10).value_or(0);
  constexpr std::uint64_t kOk = 200, kRedirect = 300, kError = 400, kUnauthorised = 401, kForbidden = 403;
  if (status == kOk) return {};
  if (status == kUnauthorised || status == kForbidden)
    return invalid_input(fmt::format("refuses access (status {}); names and passwords are not sent", status));
  if (status >= kRedirect && status < kError)
    return invalid_input(fmt::format("leads to another address (status {}), which is not followed", status));
  return invalid_input(fmt::format("answers with status {} instead of a stream of pictures", status));
}

Error too_large(std::string_view what) {
  return invalid_input(fmt::format("sends {} of more than {} MiB", what, kMostPartBytes >> 20U));
}

}  // namespace

Result<void> ChunkedBody::begin_piece() {
  const std::string_view line = trimmed(std::string_view(line_).substr(0, line_.find(';')));
  if (after_piece_ && trimmed(line_).empty()) {
    after_piece_ = false;
  } else {
    const auto length = after_piece_ ? std::nullopt : number(line, 16);
    if (!length) return invalid_input("sends pieces without their length");
    if (*length == 0) return invalid_input("has ended the stream");
    left_ = *length;
    after_piece_ = true;
  }
  line_.clear();
  return {};
}

Result<void> ChunkedBody::add(std::string_view bytes, std::string& body) {
  constexpr std::size_t kMostLine = 1024;
  while (!bytes.empty()) {
    if (left_ > 0) {
      const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size()));
      body.append(bytes.substr(0, n));
      bytes.remove_prefix(n);
      left_ -= n;
      continue;
    }
    const char c = bytes.front();
    bytes.remove_prefix(1);
    if (c == '\n') {
      if (auto begun = begin_piece(); !begun) return begun;
    } else if (line_.size() == kMostLine) {
      return invalid_input("sends pieces without their length");
    } else {
      line_.push_back(c);
    }
  }
  return {};
}

Result<void> MultipartReader::add(std::string_view bytes) {
  while (state_ == State::head && !bytes.empty()) {
    const auto used = add_line(bytes);
    if (!used) return used.error();
    bytes.remove_prefix(*used);
  }
  if (!chunked_) return body(bytes);
  std::string whole;
  auto pieces = chunked_->add(bytes, whole);
  if (auto read = body(whole); !read) return read;
  return pieces;
}

Result<void> MultipartReader::body(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto used = step(bytes);
    if (!used) return used.error();
    bytes.remove_prefix(*used);
  }
  return {};
}

/// Uses some of the bytes, at least one.
Result<std::size_t> MultipartReader::step(std::string_view bytes) {
  switch (state_) {
    case State::head:
    case State::marker_line:
    case State::part_header:
      return add_line(bytes);
    case State::between: {
      const auto used = find_marker(bytes);
      if (state_ == State::marker_line) return used;
      if ((skipped_ += used) > kMostPartBytes) return too_large("something between its pictures");
      if (part_.size() >= marker_.size()) part_.erase(0, part_.size() - marker_.size() + 1);
      searched_ = 0;
      return used;
    }
    case State::counted: {
      const auto used = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size()));
      part_.append(bytes.substr(0, used));
      left_ -= used;
      if (left_ == 0) end_part(part_.size()), state_ = State::between;
      return used;
    }
    case State::until_marker: {
      const auto room = std::min(bytes.size(), kMostPartBytes + marker_.size() - part_.size());
      if (room == 0) return too_large("a picture");
      return find_marker(bytes.substr(0, room));
    }
  }
  return bytes.size();
}

/// Appends the bytes to part_ up to the end of a marker, which ends the part.
std::size_t MultipartReader::find_marker(std::string_view bytes) {
  const std::size_t before = part_.size();
  part_.append(bytes);
  const auto at = part_.find(marker_, searched_);
  if (at == std::string::npos) {
    searched_ = part_.size() - std::min(part_.size(), marker_.size() - 1);
    return bytes.size();
  }
  if (state_ == State::until_marker) {
    // The line end before the marker belongs to it, and so do further lines of cameras that state them twice.
    auto size = at;
    while (size > 0 && part_[size - 1] == '-') --size;
    if (size > 0 && part_[size - 1] == '\n') --size;
    if (size > 0 && part_[size - 1] == '\r') --size;
    end_part(size);
  }
  part_.clear();
  searched_ = 0;
  state_ = State::marker_line;
  return at + marker_.size() - before;
}

void MultipartReader::end_part(std::size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(part_.data());
  if (size > 0) {
    newest_.emplace(first, first + size);
    ++parts_;
  }
  part_.clear();
  searched_ = 0;
  skipped_ = 0;
}

/// Adds to a header up to the end of a line.
Result<std::size_t> MultipartReader::add_line(std::string_view bytes) {
  const auto used = std::min(bytes.find('\n'), bytes.size() - 1) + 1;
  if (header_.size() + used > kMostHeaderBytes)
    return invalid_input(fmt::format("sends a header of more than {} KiB", kMostHeaderBytes >> 10U));
  header_.append(bytes.substr(0, used));
  if (!header_.ends_with('\n')) return used;
  if (state_ == State::marker_line) {
    header_.clear();
    state_ = State::part_header;
    return used;
  }
  const bool ends =
      header_ == "\n" || header_ == "\r\n" || header_.ends_with("\n\n") || header_.ends_with("\n\r\n");
  if (!ends) return used;
  auto begun = state_ == State::head ? begin(header_) : begin_part();
  if (!begun) return std::move(begun).error();
  header_.clear();
  return used;
}

/// The answer's header is complete.
Result<void> MultipartReader::begin(std::string_view head) {
  const auto line = head.substr(0, head.find('\n'));
  if (auto good = check_status(line); !good) return good;
  const auto fields = head.substr(line.size() + 1);
  const auto type = field(fields, "content-type");
  if (lower(type).starts_with("image/"))
    return invalid_input("sends a single picture; the address of its video (MJPEG) is needed");
  if (!lower(type).starts_with("multipart/"))
    return invalid_input("sends something else than a stream of pictures (MJPEG)");
  constexpr std::size_t kLongest = 200;
  const auto boundary = boundary_of(type);
  if (boundary.empty() || boundary.size() > kLongest)
    return invalid_input("does not say how its pictures are parted");
  marker_ = "--" + boundary;
  if (lower(field(fields, "transfer-encoding")) == "chunked") chunked_.emplace();
  state_ = State::between;
  return {};
}

/// A part's header is complete.
Result<void> MultipartReader::begin_part() {
  const auto stated = field(header_, "content-length");
  part_.clear();
  searched_ = 0;
  state_ = State::until_marker;
  if (stated.empty()) return {};
  const auto length = number(stated, 10);
  if (!length) return invalid_input("states a length of a picture that is no number");
  if (*length > kMostPartBytes) return too_large("a picture");
  left_ = *length;
  state_ = left_ > 0 ? State::counted : State::between;
  return {};
}

}  // namespace palpable::sources
