// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace palpable::sources::isolated {

/// The jobs of the decoder programs: kinds of files that external libraries parse.
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
  map_extract,
  video
};

std::string_view name_of(Job job);
std::optional<Job> job_from(std::string_view name);

/// Resource limits of the decoder process. If it exceeds them, it is ended, and the file counts as damaged.
struct Limits {
  std::uint64_t memory_bytes = 0;
  std::uint64_t result_bytes = 0;
  std::chrono::seconds processor_time{};
  /// Wall time from start to end, generous for a busy machine.
  std::chrono::seconds time{};
};

/// Limits for a file of this size; generous for every valid file.
Limits limits_of(Job job, std::size_t file_bytes);

/// The reply of the decoder process, mapped into memory. Untrusted: see flat.hpp.
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

/// Decodes `file` in a separate process (`palpable-mesh-decoder` and others), which can open no files or
/// network connections and ends with this process. Blocks until it has ended. Errors, without a place:
/// invalid_input if the decoder rejected the file, crashed, or exceeded `limits`; failed if the program is
/// missing or cannot be started. Any thread, also while a servo runs: the address space is not copied.
Result<Reply> decode(Job job, FileView file, const Limits& limits);
/// The same with limits_of() this file.
Result<Reply> decode(Job job, FileView file);

}  // namespace palpable::sources::isolated
