// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/start_touch.hpp"

#include <algorithm>

namespace palpable::haptics {

Transform<SceneFrame, DeviceFrame> fit_workspace(const models::Scene& scene, const device::Traits& device) {
  const Vec3 size = models::size_m(scene);
  const Vec3 work = device.workspace_m;
  double scale = std::max({1.0, size.x / work.x, size.y / work.y});
  // The hand must be able to approach the scene from above: a quarter of the device's depth stays free above
  // it.
  if (device.degrees_of_freedom > 2) scale = std::max(scale, size.z / (0.75 * work.z));
  Transform<SceneFrame, DeviceFrame> fit;
  fit.scale = scale;
  fit.translation_m = models::centre_m(scene);
  return fit;
}

}  // namespace palpable::haptics
