// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/matching_memory.hpp"

#include "palpable/core/picture/image.hpp"
#include "palpable/vision/stereo/methods/match.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace palpable::vision {
namespace {

/// Bytes per pixel, and per pixel and disparity.
struct MemoryUse {
  double pixel = 0.0;
  double disparity = 0.0;
};

MemoryUse memory_use(StereoMethod method) {
  switch (method) {
    case StereoMethod::fast:
      return {62.0, 2.1};
    case StereoMethod::scanline:
      return {53.0, 0.2};
    case StereoMethod::pyramid:
      return {66.0, 0.0};
    case StereoMethod::graph_cut:
      return {66.0, 1.0};
    case StereoMethod::segments:
      return {685.0, 4.1};
    case StereoMethod::best:
      return {703.0, 4.1};
  }
  return {};
}

/// Two pictures of three float channels, where those that were measured had one.
constexpr double kColours_bytes = 2.0 * 2.0 * sizeof(float);

constexpr double kTenthOfGigabyte = 1e8;

std::string gigabytes(double rounded_tenths) {
  const auto tenths = static_cast<long>(rounded_tenths);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GB";
}

}  // namespace

double matching_memory_bytes(StereoMethod method, int width, int height, int disparities) {
  const MemoryUse use = memory_use(method);
  return static_cast<double>(width) * height * (use.pixel + kColours_bytes + use.disparity * disparities);
}

Result<void> check_matching_memory(StereoMethod method, int width, int height, int disparities,
                                   std::size_t available_bytes) {
  const double needed = matching_memory_bytes(method, width, height, disparities);
  const auto available = static_cast<double>(available_bytes);
  if (needed <= available) return {};
  // Smaller pictures have fewer disparities, so at least this fits.
  const double scale = std::sqrt(available / needed);
  const auto scaled = [scale](int side) { return std::max(1, static_cast<int>(scale * side)); };
  return Error{ErrorCode::failed,
               "matching pictures of " + size_text(width, height) + " pixels by " +
                   std::string(name_of(method)) + " needs about " +
                   gigabytes(std::ceil(needed / kTenthOfGigabyte)) + " of memory, and " +
                   gigabytes(std::floor(available / kTenthOfGigabyte)) + " are available: scale them to " +
                   size_text(scaled(width), scaled(height)) + " or less",
               {}};
}

}  // namespace palpable::vision
