// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/json_camera.hpp"

#include "palpable/core/picture/image.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace palpable::sources {

std::optional<double> number_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

Result<void> check_lens(double fx_px, double fy_px, double cx_px, double cy_px) {
  constexpr double kLeast_px = 0.1, kMost_px = 1e6;
  const double least_px = std::min(fx_px, fy_px), most_px = std::max(fx_px, fy_px);
  if (!(fx_px > 0.0 && fy_px > 0.0)) return invalid_input("states a camera without a positive focal length");
  if (!(least_px >= kLeast_px && most_px <= kMost_px))
    return invalid_input(fmt::format("states a focal length of {:g} pixels; it must be {:g} to {:.0f}",
                                     most_px > kMost_px ? most_px : least_px, kLeast_px, kMost_px));
  if (!(std::abs(cx_px) <= kMost_px && std::abs(cy_px) <= kMost_px))
    return invalid_input(fmt::format("states a principal point more than {:.0f} pixels away", kMost_px));
  return {};
}

Result<Pinhole> pinhole_from(const nlohmann::json& object) {
  for (const char* key : {"fx", "fy", "cx", "cy", "width", "height"})
    if (!number_in(object, key)) return invalid_input(std::string("lacks the number ") + key);
  const double width = *number_in(object, "width");
  const double height = *number_in(object, "height");
  // Checked as doubles first, so that the conversion to int is defined.
  constexpr double kMaxSide_px = 1e9;
  if (!(width >= 1.0 && width < kMaxSide_px && height >= 1.0 && height < kMaxSide_px))
    return invalid_input("states an impossible picture size");
  if (width != std::floor(width) || height != std::floor(height))
    return invalid_input("states a picture size that is not in whole pixels");
  const Pinhole camera{*number_in(object, "fx"), *number_in(object, "fy"), *number_in(object, "cx"),
                       *number_in(object, "cy"), static_cast<int>(width),  static_cast<int>(height)};
  if (auto size = check_picture_size(camera.width, camera.height); !size) return std::move(size).error();
  if (auto valid = check_lens(camera.fx, camera.fy, camera.cx, camera.cy); !valid)
    return std::move(valid).error();
  return camera;
}

}  // namespace palpable::sources
