// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/laws.hpp"

#include "palpable/core/check.hpp"
#include "palpable/haptics/law/averaged.hpp"
#include "palpable/haptics/law/grid_law.hpp"
#include "palpable/haptics/law/groove.hpp"
#include "palpable/haptics/law/guided.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/penalty.hpp"
#include "palpable/haptics/law/proxy.hpp"
#include "palpable/haptics/law/rolling.hpp"
#include "palpable/haptics/law/sobel.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/law/tracing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace palpable::haptics {
namespace {

/// A new law is added here. The first law that renders a kind of model is that kind's default.
constexpr std::array kLaws{&kProxyLaw,   &kTracingLaw,  &kGrooveLaw, &kGridLaw, &kRollingLaw,
                           &kPenaltyLaw, &kAveragedLaw, &kSobelLaw,  &kToolLaw};

bool renders(const LawDescription& law, const models::Scene& scene) {
  if (std::holds_alternative<std::shared_ptr<const models::Relief>>(scene.model)) return law.models.relief;
  if (models::is_field(scene.model)) return law.models.field;
  if (std::holds_alternative<std::shared_ptr<const models::Grid>>(scene.model)) return law.models.grid;
  return law.models.contours;
}

Result<void> check(const LawParameters& parameters) {
  for (const LawParameter& p : description_of(parameters.law).parameters) {
    const auto& value = parameters.*p.value;
    if (!value || (*value >= p.min && *value <= p.max)) continue;
    std::ostringstream message;
    message << "the " << p.name << " of the law " << name_of(parameters.law) << " must be " << p.min << " to "
            << p.max;
    return usage_error(message.str());
  }
  return {};
}

/// What a ball has on a field: the space between solid and border, and how much of it it cannot use.
struct RoomForABall {
  double margin_m;
  double lost_m;
};

template <typename Field>
RoomForABall room_of(const Field& field) {
  return {field.margin_m(), 0.5 * field.distance.cell_m()};
}

/// nullopt where nothing limits a ball. The laws of the plane touch a solid's view from above; the places of
/// a tool touch the solid from within its field whatever the tool's size.
std::optional<RoomForABall> room_for_a_ball(const models::Scene& scene, Law law) {
  const LawDescription& description = description_of(law);
  if (description.degrees_of_freedom <= 2 || find_parameter(description, &LawParameters::radius_m) == nullptr)
    return std::nullopt;
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return room_of(**field);
  if (const auto* field = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return room_of(**field);
  return std::nullopt;
}

}  // namespace

std::span<const LawDescription* const> all_laws() { return kLaws; }

const LawDescription& description_of(Law law) {
  const auto* const found =
      std::find_if(kLaws.begin(), kLaws.end(), [law](const auto* l) { return l->law == law; });
  PALPABLE_CHECK(found != kLaws.end());
  return **found;
}

std::string_view name_of(Law law) { return description_of(law).name; }

std::optional<Law> law_from(std::string_view name) {
  for (const LawDescription* law : kLaws)
    if (law->name == name) return law->law;
  return std::nullopt;
}

std::vector<Law> laws_for(const models::Scene& scene) {
  std::vector<Law> laws;
  for (const LawDescription* law : kLaws)
    if (renders(*law, scene)) laws.push_back(law->law);
  return laws;
}

double largest_radius_m(const models::Scene& scene, Law law) {
  const auto room = room_for_a_ball(scene, law);
  return room ? std::max(0.0, room->margin_m - room->lost_m) : std::numeric_limits<double>::infinity();
}

std::string too_large_ball_words(double radius_m, const models::Scene& scene, Law law) {
  constexpr double kSteps_per_m = 1e5;
  const auto room = room_for_a_ball(scene, law);
  const double needed_m = radius_m + (room ? room->lost_m : 0.0);
  std::ostringstream words;
  words << "a ball of " << 1e3 * radius_m << " mm touches this solid from beyond the border of its field: "
        << "the largest radius is "
        << 1e3 * std::floor(kSteps_per_m * largest_radius_m(scene, law)) / kSteps_per_m
        << " mm, or make the field with a margin (field.margin_m) of "
        << std::ceil(kSteps_per_m * needed_m) / kSteps_per_m << " m";
  return words.str();
}

Result<std::shared_ptr<const Touchable>> make_touchable(const models::Scene& scene,
                                                        const LawParameters& parameters, DilatedRelief* kept,
                                                        const Work& work) {
  if (const auto valid = check(parameters); !valid) return valid.error();
  if (!models::has_model(scene)) return usage_error("the scene has no model");
  const LawDescription& law = description_of(parameters.law);
  if (!renders(law, scene))
    return usage_error("the law " + std::string(law.name) + " does not exist for a " +
                       models::kind_of(scene.model));
  if (const double largest_m = largest_radius_m(scene, law.law); parameters.radius_m > largest_m)
    return usage_error(too_large_ball_words(*parameters.radius_m, scene, law.law));
  auto touchable = law.make({scene, parameters, kept, work}).touchable;
  if (!touchable || scene.guide == nullptr) return touchable;
  if (!models::is_valid(*scene.guide)) return usage_error("the scene's guide is out of range");
  if (scene.guide->force_N == 0.0) return touchable;
  return std::shared_ptr<const Touchable>(
      std::make_shared<GuidedTouchable>(*std::move(touchable), *scene.guide, 0.5 * models::size_m(scene)));
}

}  // namespace palpable::haptics
