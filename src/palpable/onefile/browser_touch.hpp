// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/hand_off.hpp"
#include "palpable/device/pointer/pointer.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/page/host.hpp"
#include "palpable/page/page_materials.hpp"
#include "palpable/page/spoken_words.hpp"
#include "palpable/session/touch/haptic_scene.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::onefile {

/// A touch without threads, for a page that is its own program: the probes of the page's pointers, each with
/// the tick of docs/real-time.md, which advance() runs. Changes are carried out at once. One thread.
class BrowserTouch final : public page::PageHost {
 public:
  /// Prepares the scene's default law. May take a second for a large relief. Errors: as
  /// session::prepare_scene().
  static Result<std::unique_ptr<BrowserTouch>> open(std::shared_ptr<const models::Scene> scene);

  /// Runs the ticks of this time, at most those of kMostAtOnce_s: after a stall it skips.
  void advance(double seconds);
  static constexpr double kMostAtOnce_s = 0.1;
  static constexpr double kRate_hz = 1000.0;

  page::protocol::Hello hello() const override;
  page::protocol::Laws laws() const override;
  std::shared_ptr<const page::PageScene> scene() override { return page_scene_; }
  page::protocol::Settings settings() override;
  page::protocol::Materials materials() override;
  page::protocol::State state() override;
  void update() override {}
  void move(const page::protocol::Pointer& pointer) override;
  void lift(const page::protocol::Lift& probe) override;
  void change(const page::protocol::Change& change) override;
  void edit(const page::protocol::Edit& edit) override;
  /// There is no file to write to.
  void save() override;
  void pause(bool paused) override;
  /// The page's pointer moves to the middle by itself.
  void recentre() override {}
  /// There is no egocentric view.
  void move_explorer(const page::protocol::MoveExplorer& /*pose*/) override {}
  page::protocol::Words answer(const page::protocol::Ask& ask) override;
  page::protocol::Around around(const page::protocol::LookAround& question) override;
  void name(const page::protocol::Name& name) override { edit_names(name); }
  void unname(const page::protocol::Unname& name) override { edit_names(name); }
  void undo_name(const page::protocol::UndoName& undo) override { edit_names(undo); }
  void find(const page::protocol::Find& find) override;
  std::optional<page::protocol::Notice> next_notice() override;

 private:
  /// A probe with its pointer, which must not move in memory.
  struct Probe {
    Probe(const haptics::HapticScene& scene, Ring<haptics::TouchEvent>& events, std::uint8_t number);
    std::shared_ptr<device::PointerFeed> feed;
    device::PointerDevice device;
    haptics::TickPipeline tick;
    haptics::TouchSample latest;
    /// As the page set it; nullopt while the probe does not exist.
    std::optional<page::protocol::Pointer> pointer;
  };

  explicit BrowserTouch(std::shared_ptr<const models::Scene> scene) : scene_(std::move(scene)) {}
  /// Touches this scene with these settings from now on.
  Result<void> prepare(std::shared_ptr<const models::Scene> scene, const session::TouchSettings& settings);
  Result<void> attempt(const page::protocol::Change& change);
  Result<void> attempt(const page::protocol::Edit& edit);
  void report(const Result<void>& done, std::int64_t serial);
  void swap_scenes();
  bool fading() const;
  void place(Probe& probe) const;
  template <class Edit>
  void edit_names(const Edit& edit);
  void say(std::string level, std::string text);

  std::shared_ptr<const models::Scene> scene_;
  std::shared_ptr<const page::PageScene> page_scene_;
  session::TouchSettings settings_;
  session::KeptSurfaces kept_;
  haptics::LawParameters law_in_use_;
  Transform<SceneFrame, DeviceFrame> scene_from_device_;
  /// The scenes that ticks may still use, the newest last; and one that waits until no fade runs.
  std::vector<std::unique_ptr<const haptics::HapticScene>> rendered_;
  std::unique_ptr<const haptics::HapticScene> waiting_;
  std::uint32_t last_scene_id_ = 0;

  Ring<haptics::TouchEvent> events_{256};
  std::array<std::unique_ptr<Probe>, page::protocol::kMostProbes> probes_;
  std::uint64_t ticks_ = 0;
  /// Time that no tick has covered yet.
  double rest_s_ = 0.0;
  bool paused_ = false;

  page::SpokenWords words_;
  std::deque<page::protocol::Notice> notices_;
  std::int64_t answered_ = 0;
};

}  // namespace palpable::onefile
