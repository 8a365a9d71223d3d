// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpable::sources {

/// The most bytes of a picture of a stream, and of what may stand between two pictures.
inline constexpr std::size_t kMostPartBytes = std::size_t{48} << 20U;
/// The most bytes of the answer's header, and of each part's.
inline constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 10U;

/// Takes the lengths of the pieces out of a body that is sent in pieces (chunked, RFC 9112).
class ChunkedBody {
 public:
  /// Appends what `bytes` hold of the body to `body`. Errors: invalid_input for what is no such body, or at
  /// its end.
  Result<void> add(std::string_view bytes, std::string& body);

 private:
  Result<void> begin_piece();

  /// The line that states a length, so far; or the line end after a piece.
  std::string line_;
  std::uint64_t left_ = 0;
  bool after_piece_ = false;
};

/// Reads the answer of an HTTP server that sends a picture after the other (multipart/x-mixed-replace, as
/// network cameras do): the header, then parts between lines with the boundary, with or without
/// Content-Length, whole or in pieces. It keeps the newest whole part; memory is bounded by kMostPartBytes.
/// The result does not depend on where the bytes are cut.
class MultipartReader {
 public:
  /// The next bytes of the answer. Errors (invalid_input, without a place): an answer that is no such stream
  /// or exceeds the limits; nothing can be read after that.
  Result<void> add(std::string_view bytes);
  /// The newest whole part, if it was not taken before. Empty parts are no parts.
  std::optional<std::vector<std::byte>> take() { return std::exchange(newest_, std::nullopt); }
  /// The whole parts so far.
  std::uint64_t parts() const { return parts_; }

 private:
  enum class State : std::uint8_t { head, between, marker_line, part_header, counted, until_marker };

  Result<void> body(std::string_view bytes);
  Result<std::size_t> step(std::string_view bytes);
  Result<std::size_t> add_line(std::string_view bytes);
  Result<void> begin(std::string_view head);
  Result<void> begin_part();
  std::size_t find_marker(std::string_view bytes);
  void end_part(std::size_t size);

  State state_ = State::head;
  /// The header that is read, or the rest of a line with the boundary.
  std::string header_;
  /// "--" and the boundary.
  std::string marker_;
  std::optional<ChunkedBody> chunked_;
  /// What follows the last line with the boundary, as far as it is of use.
  std::string part_;
  /// How much of part_ is known to have no marker.
  std::size_t searched_ = 0;
  /// The bytes of this part that are missing, and the bytes since the last part.
  std::uint64_t left_ = 0;
  std::uint64_t skipped_ = 0;
  std::optional<std::vector<std::byte>> newest_;
  std::uint64_t parts_ = 0;
};

}  // namespace palpable::sources
