// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/system/shared_library.hpp"
#include "palpable/sources/depth_camera/depth_camera.hpp"

#include <chrono>
#include <cstddef>
#include <optional>

namespace palpable::sources {

/// Pixels in a library's memory, whose rows begin `stride` bytes after each other, in a block of `bytes`.
struct LibraryPixels {
  const void* data = nullptr;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;
  std::size_t bytes = 0;
};

/// Whole numbers of 16 bits as metres; 0 is unknown. Errors (invalid_input, without a place): no pixels, more
/// than kMostFramePixels, or a block that is too small for them; a unit that is not positive and finite.
Result<Raster<float>> depth_of_pixels(const LibraryPixels& pixels, double metres_per_unit);

/// Bytes R, G, B. nullopt for what depth_of_pixels() refuses.
std::optional<Image> picture_of_pixels(const LibraryPixels& pixels);

/// The error of a library that has no camera of this number.
Error no_such_camera(const DepthCamera& camera, int present);

/// How long nothing came.
class Silence {
 public:
  explicit Silence(std::chrono::milliseconds longest) : longest_(longest) {}
  void end() { last_ = std::chrono::steady_clock::now(); }
  /// Errors (invalid_input): it lasts longer than it may.
  Result<void> check() const;

 private:
  std::chrono::milliseconds longest_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Binds the functions of a library one by one; keeps the first error.
class Binder {
 public:
  explicit Binder(const SharedLibrary& library) : library_(library) {}
  template <class Function>
  void operator()(Function*& function, const char* name) {
    if (bound_) bound_ = library_.bind(function, name);
  }
  Result<void> bound() && { return std::move(bound_); }

 private:
  const SharedLibrary& library_;
  Result<void> bound_;
};

}  // namespace palpable::sources
