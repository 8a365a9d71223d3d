// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/motor_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace palpable::device {

struct MotorFile::Content {
  std::atomic<std::uint64_t> writes;
  std::atomic<std::int64_t> time_ns;
  std::atomic<double> x_N, y_N, z_N;
};

/// Whether there is no file, an empty one, or one that a simulated device has written.
bool MotorFile::may_be_replaced(const std::filesystem::path& path) {
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  if (none || size == 0) return true;
  if (size != sizeof(Content)) return false;
  std::array<char, sizeof(Content)> bytes{};
  if (!std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size())) return false;
  // A device writes at most 4000 times a second; a text's first bytes are a far greater number.
  constexpr std::uint64_t kMostWrites = std::uint64_t{1} << 48U;
  std::uint64_t writes = 0;
  std::memcpy(&writes, bytes.data(), sizeof writes);
  return writes < kMostWrites;
}

Result<std::unique_ptr<MotorFile>> MotorFile::create(const std::filesystem::path& path) {
  static_assert(sizeof(Content) == 40 && std::atomic<double>::is_always_lock_free);
  const auto failed = [&path] {
    return Error{ErrorCode::failed, "cannot be written: " + std::generic_category().message(errno),
                 path.string()};
  };
  if (!may_be_replaced(path))
    return Error{ErrorCode::usage, "exists and was not written by a simulated device; name another file",
                 path.string()};
  constexpr mode_t kReadableByAll = 0644;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
  if (descriptor < 0) return failed();
  void* memory = ::ftruncate(descriptor, sizeof(Content)) == 0
                     ? ::mmap(nullptr, sizeof(Content), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0)
                     : MAP_FAILED;
  if (memory == MAP_FAILED) {
    const Error error = failed();
    ::close(descriptor);
    return error;
  }
  return std::unique_ptr<MotorFile>(new MotorFile(descriptor, *new (memory) Content{}));
}

MotorFile::~MotorFile() {
  ::munmap(&content_, sizeof(Content));
  ::close(descriptor_);
}

void MotorFile::write(Vec3 force_N) noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  content_.x_N = force_N.x;
  content_.y_N = force_N.y;
  content_.z_N = force_N.z;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  content_.time_ns = now.tv_sec * kNanoseconds + now.tv_nsec;
  content_.writes.fetch_add(1);
}

ZeroWrite MotorFile::zero_write() const { return {descriptor_, std::vector<std::byte>(sizeof(Content))}; }

}  // namespace palpable::device
