// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The first byte is the size of the pieces in which the rest, a server's answer, arrives. Whether it arrives
// in pieces or at once makes no difference.
#include "palpable/core/check.hpp"
#include "palpable/sources/live/multipart_reader.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

struct Read {
  std::uint64_t parts = 0;
  std::optional<std::vector<std::byte>> last;
  std::string error;
  bool operator==(const Read&) const = default;
};

Read read_in_pieces(std::string_view bytes, std::size_t piece) {
  palpable::sources::MultipartReader reader;
  Read read;
  while (!bytes.empty() && read.error.empty()) {
    const auto part = bytes.substr(0, piece);
    bytes.remove_prefix(part.size());
    const auto added = reader.add(part);
    if (!added) read.error = added.error().message;
    if (auto newest = reader.take()) read.last = std::move(newest);
  }
  read.parts = reader.parts();
  return read;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Read whole = read_in_pieces(bytes, std::max<std::size_t>(1, bytes.size()));
  PALPABLE_CHECK(whole == read_in_pieces(bytes, std::max<std::size_t>(1, data[0])));
  PALPABLE_CHECK((whole.parts > 0) == whole.last.has_value());
  if (whole.last) PALPABLE_CHECK(!whole.last->empty() && whole.last->size() < bytes.size());
  return 0;
}
