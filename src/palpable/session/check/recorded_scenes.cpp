// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/check/recorded_scenes.hpp"

#include "palpable/session/touch/live_source.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace palpable::session {

namespace {

/// " (field of mesh, 96 cells; from spot.obj)"; empty if the recording does not say.
std::string words_of(const RecordedTouch& touch) {
  std::string words = touch.method;
  for (const std::string& input : touch.inputs)
    words += (words.empty() ? "from " : "; from ") + std::filesystem::path(input).filename().string();
  return words.empty() ? words : " (" + words + ")";
}

}  // namespace

RecordedScenes::RecordedScenes(const std::vector<std::shared_ptr<const models::Scene>>& at_hand) {
  for (const auto& scene : at_hand) at_hand_.push_back({scene, {scene_hash(*scene), shape_hash(*scene)}});
}

Result<void> RecordedScenes::note(std::uint32_t id, const std::string& json) {
  auto touch = parse_touch(json);
  if (!touch) return std::move(touch).error();
  noted_[id].touch = *std::move(touch);
  return {};
}

const RecordedTouch* RecordedScenes::touch(std::uint32_t id) const {
  const auto found = noted_.find(id);
  return found != noted_.end() ? &found->second.touch : nullptr;
}

const models::Scene* RecordedScenes::find(const RecordedTouch& touch) const {
  for (const AtHand& one : at_hand_)
    if (is_of(touch, one.hash)) return one.scene.get();
  return nullptr;
}

const haptics::HapticScene* RecordedScenes::scene(std::uint32_t id) {
  const auto found = noted_.find(id);
  if (found == noted_.end()) {
    why_ = "the recording does not say what was touched";
    return nullptr;
  }
  Noted& noted = found->second;
  if (std::exchange(noted.tried, true)) return noted.made.get();
  const models::Scene* scene = find(noted.touch);
  if (scene == nullptr) {
    if (noted.touch.method.starts_with(kLiveMethod))
      why_ = "the surfaces of live pictures are not in a recording";
    else
      why_ = at_hand_.empty() ? "the scene is not given"
                              : "another scene was touched than the one given" + words_of(noted.touch);
    return nullptr;
  }
  auto made = remade_scene(noted.touch, *scene, id, kept_);
  if (made)
    noted.made = std::make_unique<const haptics::HapticScene>(*std::move(made));
  else
    why_ = made.error().message;
  return noted.made.get();
}

void RecordedScenes::forget_before(std::uint32_t id) { noted_.erase(noted_.begin(), noted_.lower_bound(id)); }

}  // namespace palpable::session
