// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/simulated/groove_study.hpp"

#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace palpable::study {
namespace {

constexpr int kSide = 121;
constexpr double kGroovePixel_m = 0.00015;
constexpr double kDuration_s = 3.0;
constexpr double kObserved_s = 1.0;
constexpr int kKept = 200;

/// A groove along y with its bottom at z = 0.
Result<models::Scene> groove_scene(double slope) {
  Raster<float> height_m(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      height_m(x, y) = static_cast<float>(slope * kGroovePixel_m * std::abs(x - kSide / 2));
  auto relief = models::Relief::from_samples(std::move(height_m), kGroovePixel_m);
  if (!relief) return relief.error();
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(std::move(*relief));
  return scene;
}

struct Span {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void see(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  double width() const { return most - least; }
};

GrooveResult rest_in(const haptics::HapticScene& scene, const GrooveStudyOptions& options) {
  device::HandOptions described = options.hand;
  described.rate_hz = options.rate_hz;
  described.script.kind = device::HandScriptOptions::Kind::hold;
  device::SimulatedHand hand(described);
  haptics::TickOptions free;
  free.passivity = haptics::Passivity::observe;
  free.max_force_rate_N_per_s = 1e9;
  Ring<haptics::TouchEvent> events(64);
  haptics::TickPipeline tick(hand, scene, free, events);
  hand.place({options.beside_m, 0.0, options.slope * options.beside_m + 0.001});
  hand.set_goal({options.beside_m, 0.0, -options.deep_m});

  const int ticks = static_cast<int>(kDuration_s * options.rate_hz);
  const int observed = static_cast<int>(kObserved_s * options.rate_hz);
  GrooveResult result;
  Span across;
  Span height;
  Vec3 before;
  // The last lateral force: it is zero exactly in the middle.
  double side = 0.0;
  int turns = 0;
  for (int n = 0; n < ticks; ++n) {
    const Vec3 force = tick.step(n / options.rate_hz, 1.0 / options.rate_hz).written_force_N.v;
    while (events.take()) {
    }
    const Vec3 place = hand.true_position_m();
    if (n >= ticks - kKept) result.end_m.push_back(place.x);
    if (n >= ticks - observed) {
      across.see(place.x);
      height.see(place.z);
      if (force.x != 0.0) {
        turns += force.x * side < 0.0 ? 1 : 0;
        side = force.x;
      }
      result.force_step_N = std::max(result.force_step_N, norm(force - before));
    }
    before = force;
  }
  result.across_m = across.width();
  result.height_m = height.width();
  result.turns_per_s = turns / kObserved_s;
  return result;
}

}  // namespace

std::vector<StudiedLaw> laws_in_a_groove() {
  haptics::LawParameters naive;
  naive.law = haptics::Law::averaged;
  naive.neighbour_weight = 0.0;
  haptics::LawParameters averaged;
  averaged.law = haptics::Law::averaged;
  haptics::LawParameters penalty;
  penalty.law = haptics::Law::penalty;
  haptics::LawParameters proxy;
  return {{"naive", naive}, {"averaged", averaged}, {"penalty", penalty}, {"proxy", proxy}};
}

Result<std::vector<GrooveResult>> study_groove(const GrooveStudyOptions& options) {
  const auto scene = groove_scene(options.slope);
  if (!scene) return scene.error();
  std::vector<GrooveResult> results;
  for (const StudiedLaw& law : options.laws)
    for (const double stiffness : options.stiffnesses_N_per_m) {
      haptics::LawParameters parameters = law.parameters;
      parameters.stiffness_N_per_m = stiffness;
      parameters.damping_Ns_per_m = options.damping_Ns_per_m;
      parameters.static_friction = options.friction;
      const auto touchable = haptics::make_touchable(*scene, parameters);
      if (!touchable) return touchable.error();
      results.push_back(rest_in({*touchable, {}, 1}, options));
      results.back().law = law.name;
      results.back().stiffness_N_per_m = stiffness;
    }
  return results;
}

}  // namespace palpable::study
