// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/start_touch.hpp"

#include <utility>

namespace palpable::haptics {

Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene,
                                               std::shared_ptr<const Touchable> touchable,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options) {
  PALPABLE_CHECK(device != nullptr);
  if (!models::has_model(scene)) return Error{ErrorCode::usage, "the scene has no model", {}};
  const auto place = fit_workspace(scene, device->traits());
  return ServoLoop::start(std::move(device), {std::move(touchable), place, 1}, options);
}

Result<std::unique_ptr<ServoLoop>> start_touch(const models::Scene& scene, const LawParameters& law,
                                               std::unique_ptr<device::Device> device,
                                               const ServoOptions& options) {
  auto touchable = make_touchable(scene, law);
  if (!touchable) return touchable.error();
  return start_touch(scene, std::move(*touchable), std::move(device), options);
}

}  // namespace palpable::haptics
