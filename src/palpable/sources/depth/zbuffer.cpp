// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/zbuffer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::sources {
namespace {

double depth_at(double z, const ZBuffer& b) {
  if (b.projection == ZBuffer::Projection::orthographic) return b.near_m + z * (b.far_m - b.near_m);
  if (std::isinf(b.far_m)) return b.near_m / (1.0 - z);
  return b.near_m * b.far_m / (b.far_m - z * (b.far_m - b.near_m));
}

}  // namespace

Result<Raster<float>> linearise_zbuffer(const Raster<float>& values, const ZBuffer& buffer) {
  const bool endless = std::isinf(buffer.far_m) && buffer.projection == ZBuffer::Projection::perspective;
  if (!(buffer.near_m > 0.0) || !(buffer.far_m > buffer.near_m) || (!std::isfinite(buffer.far_m) && !endless))
    return Error{
        ErrorCode::usage, "the near plane must lie in front of the camera and before the far plane", {}};
  Raster<float> out(values.width(), values.height());
  std::transform(values.values().begin(), values.values().end(), out.values().begin(), [&](float value) {
    double z = static_cast<double>(value);
    if (buffer.range == ZBuffer::Range::minus_one_to_one) z = 0.5 * (z + 1.0);
    if (buffer.order == ZBuffer::Order::near_is_large) z = 1.0 - z;
    const bool inside =
        z >= 0.0 && z <= 1.0 && !(z == 1.0 && (endless || buffer.far_plane == ZBuffer::FarPlane::is_empty));
    return inside ? static_cast<float>(depth_at(z, buffer)) : std::numeric_limits<float>::quiet_NaN();
  });
  return out;
}

}  // namespace palpable::sources
