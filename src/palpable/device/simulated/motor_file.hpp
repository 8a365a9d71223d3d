// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/device/zero_write.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace palpable::device {

/// The motor force of a simulated device in a memory-mapped file. It can be read while the program runs and
/// after it was killed, just as the force of real motors can be observed. The file contains, in the machine's
/// byte order, the number of writes (u64), the monotonic time of the last one (i64, ns) and its force (3 x
/// f64, N).
class MotorFile {
 public:
  /// Replaces the file. Errors: failed; usage if it exists and is no such file.
  static Result<std::unique_ptr<MotorFile>> create(const std::filesystem::path& path);
  ~MotorFile();
  MotorFile(const MotorFile&) = delete;
  MotorFile& operator=(const MotorFile&) = delete;

  /// Any thread, also on the tick path, since it only stores to memory.
  void write(Vec3 force_N) noexcept;
  ZeroWrite zero_write() const;

 private:
  struct Content;
  static bool may_be_replaced(const std::filesystem::path& path);
  MotorFile(int descriptor, Content& content) : descriptor_(descriptor), content_(content) {}

  int descriptor_;
  Content& content_;
};

}  // namespace palpable::device
