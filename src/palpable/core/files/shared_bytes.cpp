// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/system/system_failure.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace palpable {

Result<SharedBytes::Writer> SharedBytes::Writer::begin() {
  Descriptor file = passable(Descriptor(::memfd_create("palpable-file", MFD_CLOEXEC | MFD_ALLOW_SEALING)));
  if (file.number() < 0) return system_failure(errno);
  return Writer(std::move(file));
}

Result<void> SharedBytes::Writer::put(std::span<const std::byte> part) {
  size_ += part.size();
  while (!part.empty()) {
    const ssize_t n = ::write(file_.number(), part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return system_failure(errno);
    part = part.subspan(static_cast<std::size_t>(n));
  }
  return {};
}

Result<SharedBytes> SharedBytes::Writer::sealed() && {
  if (::fcntl(file_.number(), F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return system_failure(errno);
  if (size_ == 0) return SharedBytes(std::move(file_), {});
  const void* begin = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file_.number(), 0);
  if (begin == MAP_FAILED) return system_failure(errno);
  return SharedBytes(std::move(file_), {static_cast<const std::byte*>(begin), size_});
}

SharedBytes::SharedBytes(SharedBytes&& other) noexcept
    : file_(std::move(other.file_)), bytes_(std::exchange(other.bytes_, {})) {}

SharedBytes& SharedBytes::operator=(SharedBytes&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

SharedBytes::~SharedBytes() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace palpable
