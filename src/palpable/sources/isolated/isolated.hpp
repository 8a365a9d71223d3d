// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace palpable::sources::isolated {

/// What the decoder process can be asked for: a kind of file that a library of others parses.
enum class Job : std::uint8_t {
  obj,
  stl,
  glb,
  tiff,
  webp,
  exr,
  exr_depth,
  heif,
  heif_depth,
  heif_announces_depth,
  opencv_calibration,
  video
};

std::string_view name_of(Job job);
std::optional<Job> job_from(std::string_view name);

/// What the decoder process may use. Beyond that it is ended, and the file counts as damaged.
struct Limits {
  std::uint64_t memory_bytes = 0;
  std::uint64_t result_bytes = 0;
  std::chrono::seconds processor_time{};
  /// From its start to its end, on a machine that may be busy.
  std::chrono::seconds time{};
};

/// For a file of so many bytes; generous for every file that is what it claims to be.
Limits limits_of(Job job, std::size_t file_bytes);

/// What the decoder process gave back, mapped into memory. Not to be trusted: see flat.hpp.
class Reply {
 public:
  Reply(const void* begin, std::size_t size) : begin_(begin), size_(size) {}
  Reply(Reply&& other) noexcept;
  Reply& operator=(Reply&& other) noexcept;
  ~Reply();
  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(begin_), size_}; }

 private:
  const void* begin_ = nullptr;
  std::size_t size_ = 0;
};

/// Decodes `file` in a process of its own (`palpable-decoder`), which can open nothing, reach no network and
/// ends with this one. Blocks until it has ended. Errors, without a place: invalid_input for what the decoder
/// refused, crashed on, or did not finish within `limits`; failed where the program is missing or cannot be
/// started. Any thread, also while a servo runs: the address space is not copied.
Result<Reply> decode(Job job, std::span<const std::byte> file, const Limits& limits);
/// The same within limits_of() the file.
Result<Reply> decode(Job job, std::span<const std::byte> file);

}  // namespace palpable::sources::isolated
