// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/read_file.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace palpable {

/// A sealed memory file: bytes that no process can change any more, mapped here, and passable to a child
/// process (start_child()) without a copy.
class SharedBytes {
 public:
  /// Collects bytes part by part; `sealed()` ends that.
  class Writer {
   public:
    /// Errors here and below: failed, without a place, with the system's reason.
    static Result<Writer> begin();
    Result<void> put(std::span<const std::byte> part);
    Result<SharedBytes> sealed() &&;

   private:
    explicit Writer(Descriptor file) : file_(std::move(file)) {}
    Descriptor file_;
    std::size_t size_ = 0;
  };

  SharedBytes(SharedBytes&& other) noexcept;
  SharedBytes& operator=(SharedBytes&& other) noexcept;
  ~SharedBytes();
  std::span<const std::byte> bytes() const { return bytes_; }
  int descriptor() const { return file_.number(); }

 private:
  SharedBytes(Descriptor file, std::span<const std::byte> bytes) : file_(std::move(file)), bytes_(bytes) {}
  Descriptor file_;
  std::span<const std::byte> bytes_;
};

/// A file's bytes, which must outlive it; with the descriptor of the memory file that they are in, or -1.
class FileView {
 public:
  // Implicit: whatever holds the bytes of a file is one.
  FileView(std::span<const std::byte> bytes) : bytes_(bytes) {}
  FileView(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  FileView(const SharedBytes& shared) : bytes_(shared.bytes()), descriptor_(shared.descriptor()) {}
  operator std::span<const std::byte>() const { return bytes_; }
  std::span<const std::byte> bytes() const { return bytes_; }
  int descriptor() const { return descriptor_; }

 private:
  std::span<const std::byte> bytes_;
  int descriptor_ = -1;
};

/// The bytes of a file that was read.
class FileBytes {
 public:
  explicit FileBytes(std::vector<std::byte> own) : own_(std::move(own)) {}
  explicit FileBytes(SharedBytes shared) : shared_(std::move(shared)) {}
  FileView view() const { return shared_ ? FileView(*shared_) : FileView(own_); }

 private:
  std::vector<std::byte> own_;
  std::optional<SharedBytes> shared_;
};

/// Reads a file as read_file(); into a memory file if `for_a_child` says so of its first bytes (at most
/// 4 KiB). Errors as read_file(); failed, with the file's name, if there can be no memory file.
Result<FileBytes> read_file_bytes(const std::filesystem::path& path,
                                  bool (*for_a_child)(std::span<const std::byte> start),
                                  std::uintmax_t max_bytes = kMaxFileBytes);

}  // namespace palpable
