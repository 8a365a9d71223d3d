// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/scene/scene.hpp"

#include <memory>
#include <string>

namespace palpable::session {

/// A hash of everything that a hand can feel of a scene (shape, materials and labels; not its picture or
/// source): 64-bit FNV-1a as 16 hexadecimal digits. Equal scenes have equal hashes on every machine.
std::string scene_hash(const models::Scene& scene);

/// The hash of shape and labels alone: scenes that differ only in their materials have the same one.
std::string shape_hash(const models::Scene& scene);

struct SceneHash {
  std::string scene;
  std::string shape;
};

/// Caches the hashes of the last scene, so that a scene whose settings change is hashed once. One thread at a
/// time.
class SceneHashes {
 public:
  SceneHash of(const std::shared_ptr<const models::Scene>& scene);

 private:
  std::shared_ptr<const models::Scene> scene_;
  SceneHash hash_;
};

}  // namespace palpable::session
