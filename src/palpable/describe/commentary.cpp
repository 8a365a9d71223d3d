// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/commentary.hpp"

#include "palpable/describe/contour_lines.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_guide.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

/// The name of a place for a sweeping probe; empty if it has none.
std::string sweep_name(const models::Scene& scene, Place place) {
  const std::string name = name_at(scene, place);
  // Between the streets of a map nothing is said.
  if (scene.map != nullptr && name != tr(kRouteEnd) &&
      models::label_at(scene, {{place.x_m, place.y_m, 0.0}}) == 0 && written_at(scene, place) == nullptr)
    return {};
  const auto* contours = std::get_if<std::shared_ptr<const models::Contours>>(&scene.model);
  if (contours == nullptr || !name.empty()) return name;
  return nearest_line((*contours)->boundaries, place, kOnLine_m) ? std::string(tr("on the line"))
                                                                 : std::string();
}

double distance_m(Place a, Place b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace

CommentaryOptions commentary_options(const models::Scene& scene) {
  CommentaryOptions options;
  if (scene.map == nullptr) return options;
  options.dwell_s = 0.05;
  options.gap_s = 0.5;
  options.holds_before_unnamed_only = true;
  return options;
}

std::optional<std::string> Commentary::at(const models::Scene& scene, double height_factor, Place place,
                                          double now_s) {
  const std::string edge = edge_at(scene, height_factor, place);
  const std::string name = held_name(scene, place, now_s);
  if (name != candidate_) candidate_ = name, candidate_since_s_ = now_s;
  const bool is_calm = now_s - said_s_ >= options_.gap_s;
  if (name != current_ && now_s - candidate_since_s_ >= options_.dwell_s) {
    std::erase_if(said_, [&](const Said& said) { return now_s - said.at_s >= options_.repeat_s; });
    const bool again =
        std::any_of(said_.begin(), said_.end(), [&name](const Said& said) { return said.name == name; });
    if (name.empty() || again) {
      current_ = name;
    } else if (is_calm) {
      current_ = name;
      said_.push_back({name, now_s});
      said_s_ = now_s;
      return said_name(scene, place, name);
    }
    // Within the gap nothing is said; the name is said later if the probe is still there.
    return std::nullopt;
  }
  // A new name is more informative than the edge before it.
  if (edge.empty() || !is_calm || name != current_) return std::nullopt;
  said_s_ = now_s;
  return edge;
}

std::string Commentary::held_name(const models::Scene& scene, Place place, double now_s) {
  std::string name = sweep_name(scene, place);
  if (name == current_ || current_.empty()) {
    inside_s_ = now_s;
    return name;
  }
  if ((options_.holds_before_unnamed_only && !name.empty()) || now_s - inside_s_ >= options_.settle_s)
    return name;
  constexpr int kDirections = 8;
  const double hold_m = options_.hold * longer_side_m(scene);
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kDirections;
    const Place beside{place.x_m + hold_m * std::cos(angle), place.y_m + hold_m * std::sin(angle)};
    if (sweep_name(scene, beside) == current_) return current_;
  }
  return name;
}

std::string Commentary::said_name(const models::Scene& scene, Place place, const std::string& name) {
  const models::PlaceName* const written = written_at(scene, place);
  if (written == nullptr || written->name != name) return capitalised(name);
  const std::string sentence = untold_sentence(scene, place);
  return capitalised(name) + (sentence.empty() ? "" : "." + sentence);
}

std::string Commentary::untold_sentence(const models::Scene& scene, Place place) {
  const models::PlaceName* const written = written_at(scene, place);
  if (written == nullptr || written->sentence.empty() || !told_.insert(written->name).second) return {};
  return " " + written->sentence;
}

void Commentary::heard(const models::Scene& scene, Place place, double now_s) {
  candidate_ = current_ = sweep_name(scene, place);
  said_ = {{candidate_, now_s}};
  candidate_since_s_ = said_s_ = inside_s_ = now_s;
  way_.clear();
  on_edge_ = false;
}

std::string Commentary::edge_at(const models::Scene& scene, double height_factor, Place place) {
  // The lines of contours are its edges, and the grooves of a map have names.
  if (scene.map != nullptr || std::holds_alternative<std::shared_ptr<const models::Contours>>(scene.model))
    return {};
  const models::Relief& surface = *models::relief_of(scene);
  const double height_m = height_factor * surface.sample(place.x_m, place.y_m).z_m;
  way_.push_back({place, height_m});
  constexpr std::size_t kMostSteps = 256;
  // The last step before edge_reach_m is kept, since a fast probe makes longer steps.
  while (way_.size() > 2 &&
         (distance_m(way_[1].place, place) > options_.edge_reach_m || way_.size() > kMostSteps))
    way_.pop_front();
  const double least_m =
      std::max(options_.edge_share * std::abs(height_factor) * (surface.highest_m() - surface.lowest_m()),
               options_.edge_least_m);
  const double step_m = height_m - way_.front().height_m;
  const bool was_on_edge = on_edge_;
  // Hysteresis: a probe that rests on an edge reports it once.
  on_edge_ = std::abs(step_m) >= (was_on_edge ? 0.5 : 1.0) * least_m;
  if (!on_edge_ || was_on_edge) return {};
  return step_m > 0.0 ? tr("Edge up") : tr("Edge down");
}

}  // namespace palpable::describe
