// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <string>

namespace palpable::session {

/// A number for everything that a hand can feel of a scene (shape, materials, labels; not its picture or
/// origin): 64 bits of FNV-1a, as 16 hexadecimal digits. Equal scenes have equal hashes on every machine.
std::string scene_hash(const models::Scene& scene);

/// The same of shape and labels alone: scenes that differ in their materials only have the same.
std::string shape_hash(const models::Scene& scene);

struct SceneHash {
  std::string scene;
  std::string shape;
};

/// The hashes of the scene that was asked for last, so that a scene whose settings change is hashed once. One
/// thread at a time.
class SceneHashes {
 public:
  SceneHash of(const std::shared_ptr<const models::Scene>& scene);

 private:
  std::shared_ptr<const models::Scene> scene_;
  SceneHash hash_;
};

}  // namespace palpable::session
