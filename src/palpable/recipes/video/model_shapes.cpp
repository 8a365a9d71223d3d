// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/model_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace palpable::recipes {
namespace {

// The cells of the ground, and the object that stands on each; 0 = none.
class GroundCells {
 public:
  GroundCells(const VideoModel& model, double cell_m)
      : least_(model.least),
        cell_m_(cell_m),
        width_(1 + static_cast<int>((model.most.x - model.least.x) / cell_m)),
        height_(1 + static_cast<int>((model.most.y - model.least.y) / cell_m)),
        count_(static_cast<std::size_t>(width_ * height_), 0),
        object_(count_.size(), 0) {}

  void add(const Vec3& p) { ++count_[cell_of(p)]; }
  // Connects cells with at least so many points, by sides and corners. Returns the points of each object.
  std::vector<std::size_t> find_objects(std::size_t least_points) {
    std::vector<std::size_t> points{0};
    for (std::size_t start = 0; start < count_.size(); ++start)
      if (count_[start] >= least_points && object_[start] == 0)
        points.push_back(fill(start, points.size(), least_points));
    return points;
  }
  std::size_t object_at(const Vec3& p) const { return object_[cell_of(p)]; }

 private:
  std::size_t cell_of(const Vec3& p) const {
    const int x = std::clamp(static_cast<int>((p.x - least_.x) / cell_m_), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>((p.y - least_.y) / cell_m_), 0, height_ - 1);
    return static_cast<std::size_t>(y * width_ + x);
  }
  std::size_t fill(std::size_t start, std::size_t object, std::size_t least_points) {
    std::vector<std::size_t> open{start};
    object_[start] = object;
    std::size_t points = 0;
    while (!open.empty()) {
      const std::size_t cell = open.back();
      open.pop_back();
      points += count_[cell];
      const int x = static_cast<int>(cell) % width_, y = static_cast<int>(cell) / width_;
      for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
          const auto next = static_cast<std::size_t>(v * width_ + u);
          if (count_[next] < least_points || object_[next] != 0) continue;
          object_[next] = object;
          open.push_back(next);
        }
    }
    return points;
  }

  Vec3 least_;
  double cell_m_;
  int width_, height_;
  std::vector<std::size_t> count_, object_;
};

struct LabelledPoints {
  std::vector<Vec3> points;
  std::vector<std::uint8_t> labels;
  std::size_t objects = 0;
};

// Points of the objects with their feet on the ground; the largest objects first, at most 255.
LabelledPoints objects_of(const VideoModel& model, double extent, const ModelShapesOptions& options) {
  const double area = (model.most.x - model.least.x) * (model.most.y - model.least.y);
  const double spacing = std::sqrt(area / std::max(1.0, static_cast<double>(model.raised.size())));
  GroundCells ground(model, std::max(options.cell_share * extent, options.cell_spacings * spacing));
  for (const Vec3& p : model.raised) ground.add(p);
  const std::vector<std::size_t> counts =
      ground.find_objects(static_cast<std::size_t>(options.least_in_cell));
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < counts.size(); ++i)
    if (static_cast<double>(counts[i]) >=
        options.least_object_share * static_cast<double>(model.raised.size()))
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
  constexpr std::size_t kMostLabels = 255;
  order.resize(std::min(order.size(), kMostLabels));
  std::vector<std::uint8_t> label(counts.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) label[order[i]] = static_cast<std::uint8_t>(i + 1);
  LabelledPoints out;
  out.objects = order.size();
  for (const Vec3& p : model.raised) {
    const std::uint8_t of = label[ground.object_at(p)];
    if (of == 0) continue;
    for (const Vec3& place : {p, Vec3{p.x, p.y, model.ground_height}})
      out.points.push_back(place), out.labels.push_back(of);
  }
  return out;
}

models::Superquadric plate_of(const VideoModel& model, double thickness) {
  models::Superquadric plate;
  plate.e1 = plate.e2 = models::kLeastExponent;
  plate.size_m = {(model.most.x - model.least.x) / 2, (model.most.y - model.least.y) / 2, thickness / 2};
  plate.scene_from_shape.translation_m = {(model.most.x + model.least.x) / 2,
                                          (model.most.y + model.least.y) / 2,
                                          model.ground_height - thickness / 2};
  return plate;
}

}  // namespace

std::vector<Parameter> parameters_of(ModelShapesOptions& o) {
  std::vector<Parameter> out{
      {"cell_share",
       &o.cell_share,
       {0.001, 0.1},
       "",
       "Cells that connect an object's points, share of the extent"},
      {"least_object_share", &o.least_object_share, {0, 0.5}, "", "Share of the points that an object needs"},
      {"cell_spacings", &o.cell_spacings, {0, 20}, "", "Least width of these cells, mean spacings of points"},
      {"least_in_cell", &o.least_in_cell, {1, 100}, "", "Points that a cell of an object needs"},
      {"base_share", &o.base_share, {0.005, 0.5}, "", "Thickness of the base plate, share of the extent"}};
  append_parameters(out, "fit", sculpt::parameters_of(o.shapes));
  return out;
}

Result<ModelShapes> shapes_of_model(const VideoModel& model, const ModelShapesOptions& options,
                                    const Work& work) {
  ModelShapesOptions checked_options = options;
  if (auto checked = check_ranges(checked_options); !checked) return checked.error();
  const double extent = std::max(model.most.x - model.least.x, model.most.y - model.least.y);
  ModelShapes out;
  out.shapes.push_back(plate_of(model, options.base_share * extent));
  const LabelledPoints objects = objects_of(model, extent, options);
  out.objects = objects.objects;
  if (objects.points.empty()) return out;
  const auto fitted =
      sculpt::fit_superquadrics(objects.points, objects.labels, std::nullopt, options.shapes, work);
  if (!fitted) return fitted.error();
  for (const auto& one : fitted->shapes) out.shapes.push_back(one.shape);
  return out;
}

}  // namespace palpable::recipes
