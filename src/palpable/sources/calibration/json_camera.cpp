// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/calibration/json_camera.hpp"

#include "palpable/core/image.hpp"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

namespace palpable::sources {

std::optional<double> number_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

Result<Pinhole> pinhole_from(const nlohmann::json& object) {
  for (const char* key : {"fx", "fy", "cx", "cy", "width", "height"})
    if (!number_in(object, key)) return invalid_input(std::string("lacks the number ") + key);
  const double width = *number_in(object, "width");
  const double height = *number_in(object, "height");
  // Asked as doubles first: a number beyond every picture must not reach the conversion to int.
  constexpr double kMaxSide = 1e9;
  if (!(width >= 1.0 && width < kMaxSide && height >= 1.0 && height < kMaxSide))
    return invalid_input("states an impossible picture size");
  const Pinhole camera{*number_in(object, "fx"), *number_in(object, "fy"), *number_in(object, "cx"),
                       *number_in(object, "cy"), static_cast<int>(width),  static_cast<int>(height)};
  if (auto size = check_picture_size(camera.width, camera.height); !size) return std::move(size).error();
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0))
    return invalid_input("states a camera without a positive focal length");
  return camera;
}

}  // namespace palpable::sources
