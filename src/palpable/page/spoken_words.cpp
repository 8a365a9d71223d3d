// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/page/spoken_words.hpp"

#include "palpable/describe/found_places.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/scene_words.hpp"

#include <chrono>

#include <fmt/format.h>

namespace palpable::page {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

describe::Place place_of(const protocol::ProbeState& probe) { return {probe.x_m, probe.y_m}; }

/// Whether the probe is near the surface; a lifted probe is not announced.
bool is_near_surface(const protocol::ProbeState& probe) {
  constexpr double kNear_m = 0.002;
  return probe.contact || probe.z_m - probe.surface_m < kNear_m;
}

std::string sentence(std::string words) { return describe::capitalised(std::move(words)) + "."; }

}  // namespace

protocol::Words SpokenWords::answer(const protocol::Ask& ask, const models::Scene& scene,
                                    double height_factor, double force_N) {
  const describe::Place place{ask.x_m, ask.y_m};
  if (ask.what == "way") {
    commentaries_.at(static_cast<std::size_t>(ask.probe)).heard(scene, place, now_s());
    return names_.way(scene, ask);
  }
  if (ask.what != "surface") return {ask.serial, text_of(ask, scene, height_factor, force_N), {}, {}};
  const auto surface = describe::nearest_surface(scene, place);
  if (!surface) return {ask.serial, describe::tr("There is nothing to touch."), {}, {}};
  commentaries_.at(static_cast<std::size_t>(ask.probe)).heard(scene, *surface, now_s());
  return {
      ask.serial,
      sentence(describe::phrase("at the surface, {}", describe::step_words(scene, height_factor, *surface))),
      surface->x_m, surface->y_m};
}

std::string SpokenWords::text_of(const protocol::Ask& ask, const models::Scene& scene, double height_factor,
                                 double force_N) {
  const describe::Place place{ask.x_m, ask.y_m};
  const auto probe = static_cast<std::size_t>(ask.probe);
  if (ask.what == "opening") return describe::opening_words(scene);
  if (ask.what == "scene")
    return describe::scene_part(scene, height_factor, place, static_cast<std::size_t>(ask.part));
  if (ask.what == "press") return sentence(describe::press_words(scene, place, ask.press_m));
  if (ask.what == "position" || ask.what == "step") {
    describe::Commentary& commentary = commentaries_.at(probe);
    commentary.heard(scene, place, now_s());
    // Told by either: a step says it the first time only.
    const std::string untold = commentary.untold_sentence(scene, place);
    return ask.what == "position" ? describe::position_words(scene, height_factor, place, names_.guide(scene))
                                  : sentence(describe::step_words(scene, height_factor, place)) + untold;
  }
  if (ask.what == "probe") return describe::felt_words(scene, height_factor, place, force_N) + ".";
  return {};
}

std::vector<protocol::Notice> SpokenWords::remarks(const protocol::State& state, const models::Scene& scene,
                                                   double height_factor) {
  const double now = now_s();
  if (scene.model != model_) {
    model_ = scene.model;
    commentaries_.fill(describe::Commentary(describe::commentary_options(scene)));
    // The first places of the probes are not announced.
    for (const auto& probe : state.probes)
      commentaries_.at(static_cast<std::size_t>(probe.probe)).heard(scene, place_of(probe), now);
  }
  std::vector<protocol::Notice> remarks;
  for (const auto& probe : state.probes) {
    if (!is_near_surface(probe)) continue;
    auto words = commentaries_.at(static_cast<std::size_t>(probe.probe))
                     .at(scene, height_factor, place_of(probe), now);
    if (!words) continue;
    remarks.push_back(
        {"motion",
         state.probes.size() > 1 ? describe::phrase("Probe {}: {}", probe.probe + 1, *words) : *words,
         probe.probe});
  }
  return remarks;
}

}  // namespace palpable::page
