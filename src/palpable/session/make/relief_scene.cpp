// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/relief_scene.hpp"

#include <memory>
#include <utility>

namespace palpable::session {

models::Scene relief_scene(models::Relief relief, const MakeOptions& options, int width, int height,
                           std::string method) {
  models::Scene scene;
  scene.scene_from_input = sculpt::scene_from_picture(relief, width, height);
  scene.model = std::make_shared<const models::Relief>(std::move(relief));
  for (const auto& input : options.inputs) scene.source.inputs.push_back(input.string());
  scene.source.method = std::move(method);
  scene.source.made_by = options.made_by;
  return scene;
}

}  // namespace palpable::session
