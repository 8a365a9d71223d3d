// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/shelf/kept_scene.hpp"

#include "palpable/page/shelf/scene_card.hpp"

#include <utility>

namespace palpable::page::shelf {

KeptScene::KeptScene(RecentScenes& recent, std::string id, std::filesystem::path temporary,
                     formats::ZipMembers others)
    : recent_(recent), temporary_(std::move(temporary)), others_(std::move(others)), id_(std::move(id)) {}

Result<void> KeptScene::keep(const models::Scene& scene) {
  const std::lock_guard lock(mutex_);
  if (!id_.empty() && !recent_.scene(id_))
    return Error{ErrorCode::failed, "the scene was removed from the list of scenes opened lately", {}};
  if (auto written = formats::write_scene(temporary_, scene, others_); !written) return written;
  if (!id_.empty()) return recent_.replace(id_, temporary_);
  // The sample stays on the shelf, under its own title.
  SceneCard card = scene_card(scene);
  card.title += ", with names";
  auto added = recent_.add(temporary_, card, scene_picture(scene, kCardPictureSide));
  if (!added) return added.error();
  id_ = *std::move(added);
  return {};
}

bool KeptScene::replace(const std::filesystem::path& finer) {
  const std::lock_guard lock(mutex_);
  return !id_.empty() && recent_.scene(id_) && recent_.replace(id_, finer);
}

}  // namespace palpable::page::shelf
