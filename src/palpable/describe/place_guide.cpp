// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/place_guide.hpp"

#include "palpable/describe/contour_lines.hpp"
#include "palpable/describe/found_places.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/map_places.hpp"
#include "palpable/describe/name_search.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

using Extent = models::PlaceName::Extent;

/// Large label images are subsampled.
constexpr int kReducedLabelSide = 400;

double reach_m(const models::PlaceName& name, double side_m) {
  // Of areas and labels: what words cannot tell, up to half a millimetre along both axes (offset_words()).
  constexpr double kUntold_m = 0.00071;
  if (name.extent == Extent::point) return kPointReach * side_m;
  return name.extent == Extent::line ? kLineReach * side_m : kUntold_m;
}

models::OnLine nearest_of_shape(const models::PlaceName& name, Place from) {
  if (name.extent == Extent::line) return models::nearest_on_line(name.line, from);
  if (name.extent == Extent::area) return models::nearest_in_area(name.line, from);
  return {std::hypot(name.at.x_m - from.x_m, name.at.y_m - from.y_m), name.at};
}

std::size_t label_of(const models::Scene& scene, Place place) {
  return models::label_at(scene, {{place.x_m, place.y_m, 0.0}});
}

/// Points before lines before areas before labels, and the smaller first.
std::pair<int, double> precedence(const models::PlaceName& name, double distance_m) {
  if (name.extent == Extent::area) return {static_cast<int>(name.extent), models::area_m2(name.line)};
  return {static_cast<int>(name.extent), distance_m};
}

}  // namespace

double longer_side_m(const models::Scene& scene) {
  const Vec3 size = models::size_m(scene);
  return std::max(size.x, size.y);
}

models::OnLine nearest_of(const models::Scene& scene, const models::PlaceName& name, Place from) {
  if (name.extent != Extent::label) return nearest_of_shape(name, from);
  const bool is_here = !scene.labels.empty() && label_of(scene, name.at) == label_of(scene, from);
  return {is_here ? 0.0 : std::numeric_limits<double>::infinity(), is_here ? from : name.at};
}

const models::PlaceName* written_at(const models::Scene& scene, Place place) {
  const double side_m = longer_side_m(scene);
  const models::PlaceName* best = nullptr;
  std::pair<int, double> first{};
  for (const models::PlaceName& name : scene.names) {
    const double distance_m = nearest_of(scene, name, place).distance_m;
    if (distance_m > reach_m(name, side_m)) continue;
    const auto order = precedence(name, distance_m);
    if (best != nullptr && !(order < first)) continue;
    best = &name;
    first = order;
  }
  return best;
}

PlaceGuide::PlaceGuide(const models::Scene& scene)
    : model_(scene.model),
      written_(scene.names),
      labels_(reduced_labels(scene.labels, kReducedLabelSide)),
      size_m_(models::size_m(scene)),
      reach_m_(longer_side_m(scene)) {
  for (std::size_t i = 0; i < scene.names.size(); ++i) {
    NamedPlace written{scene.names[i], scene.names[i].name, {}, true, i};
    label_of_.push_back(written.name.extent == Extent::label && !labels_.empty()
                            ? std::optional(label_of(scene, written.name.at))
                            : std::nullopt);
    places_.push_back(std::move(written));
  }
  auto found = found_places(scene, labels_);
  for (NamedPlace& place : found) add_found(scene, std::move(place));
}

void PlaceGuide::add_found(const models::Scene& scene, NamedPlace place) {
  const bool is_label = place.name.extent == Extent::label;
  const std::size_t label = label_of(scene, place.name.at);
  for (std::size_t i = 0; i < written_.size(); ++i) {
    const models::PlaceName& name = written_[i];
    if (name.extent != place.name.extent) continue;
    if (is_label ? label_of_[i] == label : name.at == place.name.at) return;
  }
  label_of_.push_back(is_label ? std::optional(label) : std::nullopt);
  places_.push_back(std::move(place));
}

bool PlaceGuide::is_of(const models::Scene& scene) const {
  return scene.model == model_ && scene.names == written_;
}

std::vector<models::OnLine> PlaceGuide::nearest_labels(Place from) const {
  std::vector<models::OnLine> nearest(256, {std::numeric_limits<double>::infinity(), from});
  const double width_m = size_m_.x / std::max(1, labels_.width()),
               height_m = size_m_.y / std::max(1, labels_.height());
  for (int j = 0; j < labels_.height(); ++j)
    for (int i = 0; i < labels_.width(); ++i) {
      // The nearest point of the sample's rectangle.
      const Place middle{(i + 0.5) * width_m - 0.5 * size_m_.x, 0.5 * size_m_.y - (j + 0.5) * height_m};
      const Place p{std::clamp(from.x_m, middle.x_m - 0.5 * width_m, middle.x_m + 0.5 * width_m),
                    std::clamp(from.y_m, middle.y_m - 0.5 * height_m, middle.y_m + 0.5 * height_m)};
      models::OnLine& best = nearest[labels_(i, j)];
      if (const double d = std::hypot(p.x_m - from.x_m, p.y_m - from.y_m); d < best.distance_m) best = {d, p};
    }
  return nearest;
}

PlaceGuide::Seen PlaceGuide::seen(std::size_t place, Place from,
                                  const std::vector<models::OnLine>& labels) const {
  const models::PlaceName& name = places_[place].name;
  const auto nearest = label_of_[place] ? labels[*label_of_[place]] : nearest_of_shape(name, from);
  return {place, nearest.at, nearest.distance_m <= reach_m(name, reach_m_) ? 0.0 : nearest.distance_m};
}

PlaceGuide::Seen PlaceGuide::seen(std::size_t place, Place from) const {
  return seen(place, from, label_of_[place] ? nearest_labels(from) : std::vector<models::OnLine>());
}

std::vector<PlaceGuide::Seen> PlaceGuide::around(Place from) const {
  const auto labels = nearest_labels(from);
  std::vector<Seen> all;
  for (std::size_t place = 0; place < places_.size(); ++place) all.push_back(seen(place, from, labels));
  std::stable_sort(all.begin(), all.end(),
                   [](const Seen& a, const Seen& b) { return a.distance_m < b.distance_m; });
  return all;
}

std::vector<std::size_t> PlaceGuide::here(Place place) const {
  std::vector<std::size_t> covering;
  for (const Seen& seen : around(place))
    if (seen.distance_m == 0.0) covering.push_back(seen.place);
  std::stable_sort(covering.begin(), covering.end(), [this](std::size_t a, std::size_t b) {
    return places_[a].name.extent < places_[b].name.extent;
  });
  return covering;
}

Result<std::size_t> PlaceGuide::find(std::string_view name, Place from) const {
  // In the order of their distance, so that of equal names the nearest one is first.
  std::vector<std::string> names;
  const auto near = around(from);
  for (const Seen& seen : near) names.push_back(places_[seen.place].name.name);
  const MeantNames meant = meant_names(std::string(name), names);
  if (meant.names.size() == 1) {
    const std::string& wanted = names[meant.names.front()];
    // Of equal names one that is elsewhere: who stands at one of them looks for another.
    for (std::size_t i = meant.names.front(); i < near.size(); ++i)
      if (names[i] == wanted && near[i].distance_m > 0.0) return near[i].place;
    return near[meant.names.front()].place;
  }
  if (!meant.names.empty())
    return Error{ErrorCode::usage, phrase("'{}' could be {}", name, some_of(meant.names, names)), {}};
  const auto similar = similar_names(std::string(name), names);
  if (names.empty()) return Error{ErrorCode::usage, tr("nothing here has a name"), {}};
  std::vector<std::size_t> nearest(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) nearest[i] = i;
  return Error{ErrorCode::usage,
               phrase("nothing here is called '{}'; {} {}", name,
                      tr(similar.empty() ? "the nearest names are" : "similar names are"),
                      some_of(similar.empty() ? nearest : similar, names)),
               {}};
}

std::string way_words(const PlaceGuide::Seen& seen, Place from) {
  if (seen.distance_m == 0.0) return tr("here");
  return offset_words(seen.at.x_m - from.x_m, seen.at.y_m - from.y_m);
}

std::string around_words(const PlaceGuide& guide, Place from, std::size_t most) {
  std::vector<std::string> here, around;
  for (const PlaceGuide::Seen& seen : guide.around(from)) {
    const std::string& words = guide.places()[seen.place].words;
    if (here.size() + around.size() == most) break;
    if (seen.distance_m == 0.0)
      here.push_back(words);
    else
      around.push_back(fmt::format("{}, {}", words, way_words(seen, from)));
  }
  if (here.empty() && around.empty()) return tr("Nothing here has a name.");
  return fmt::format("{}{}{}", here.empty() ? "" : phrase("Here: {}.", listed(here)),
                     here.empty() || around.empty() ? "" : " ",
                     around.empty() ? "" : phrase("Around: {}.", fmt::join(around, "; ")));
}

}  // namespace palpable::describe
