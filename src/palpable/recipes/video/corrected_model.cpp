// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/corrected_model.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/recipes/solid/surface_distances.hpp"
#include "palpable/recipes/video/segment_shapes.hpp"
#include "palpable/sculpt/correction/shapes_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using vision::FrameDepth;
using Shapes = std::vector<models::Superquadric>;

// What the steps of one model share.
class Growth {
 public:
  Growth(const VideoModel& model, std::span<const FrameDepth> maps, const ModelShapesOptions& shapes,
         const CorrectedModelOptions& options, const ModelStepObserver& observer, const Work& work)
      : model_(model),
        maps_(maps),
        shape_options_(shapes),
        options_(options),
        observer_(observer),
        work_(work),
        extent_(std::max(model.most.x - model.least.x, model.most.y - model.least.y)) {
    const std::size_t step = 1 + model.raised.size() / static_cast<std::size_t>(options.error_points);
    for (std::size_t i = 0; i < model.raised.size(); i += step) evidence_.push_back(model.raised[i]);
    spacing_ = std::max(options_.sample_spacings * corner_spacing(), extent_ / options_.most_samples);
  }

  Result<void> predict_from_segments(const Raster<Rgb8>& picture) {
    auto shapes = shapes_of_segments(picture, maps_.front(), model_, options_.segments);
    if (!shapes) return shapes.error();
    if (shapes->empty()) return {};
    return try_shapes({*std::move(shapes), 0}, ModelStep::Kind::segments, 0);
  }

  // Fits to the points of the first maps: more each time, at last of all.
  Result<void> fit_to_structure() {
    VideoModel known = model_;
    known.raised.clear();
    std::size_t next = 1;
    for (std::size_t k = 0; k < maps_.size(); ++k) {
      const std::vector<Vec3> points = raised_points(maps_[k], model_, options_.measured.step_px);
      known.raised.insert(known.raised.end(), points.begin(), points.end());
      if (k + 1 < next && k + 1 < maps_.size()) continue;
      next *= static_cast<std::size_t>(options_.map_factor);
      work_.report(0.5 * static_cast<double>(k) / static_cast<double>(maps_.size()), "fitting superquadrics");
      auto shapes = shapes_of_model(known, shape_options_, work_);
      if (!shapes) return shapes.error();
      if (auto tried = try_shapes(*std::move(shapes), ModelStep::Kind::superquadrics, k); !tried)
        return tried;
    }
    return {};
  }

  // Fits further shapes to the points that no shape so far comes near.
  Result<void> fit_to_rest() {
    std::vector<Vec3> points;
    const std::size_t step =
        1 + model_.raised.size() / static_cast<std::size_t>(shape_options_.shapes.used_points);
    for (std::size_t i = 0; i < model_.raised.size(); i += step) points.push_back(model_.raised[i]);
    auto distances = distances_from(points, out_.shapes.shapes, work_);
    if (!distances) return distances.error();
    VideoModel rest = model_;
    rest.raised.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((*distances)[i] > options_.rest_share * extent_) rest.raised.push_back(points[i]);
    if (static_cast<double>(rest.raised.size()) < options_.least_rest * static_cast<double>(points.size()))
      return {};
    auto shapes = shapes_of_model(rest, shape_options_, work_);
    // Scattered points may fit nothing.
    if (!shapes) return shapes.error().code == ErrorCode::interrupted ? shapes.error() : Result<void>();
    ModelShapes all = out_.shapes;
    all.shapes.insert(all.shapes.end(), shapes->shapes.begin() + 1, shapes->shapes.end());
    return try_shapes(std::move(all), ModelStep::Kind::superquadrics, maps_.size() - 1);
  }

  Result<void> correct() {
    auto predicted = closed_surface_of(out_.shapes.shapes);
    if (!predicted) return predicted.error();
    // Samples have errors of their own, by rounded edges and thickened slabs.
    error_ = error_of(*predicted);
    out_.steps.push_back({ModelStep::Kind::sampling, maps_.size() - 1, error_, true});
    if (observer_) observer_(out_.steps.back(), *predicted);
    for (int pass = 0; pass < options_.passes; ++pass) {
      const double before = error_;
      auto corrected = corrected_by_all(*std::move(predicted));
      if (!corrected) return corrected.error();
      predicted = std::move(corrected);
      if (error_ > (1 - options_.least_gain) * before) break;
    }
    out_.corrected_error = std::min(error_, out_.predicted_error);
    if (error_ <= out_.predicted_error) out_.surface = *std::move(predicted);
    return {};
  }

  CorrectedModel take() { return std::move(out_); }

 private:
  // One pass: the surface corrected by each map in turn. The next pass starts from its result, whose normals
  // are better, so it reaches what the first did not.
  Result<Mesh> corrected_by_all(Mesh predicted) {
    auto surface = sculpt::predicted_surface(std::move(predicted));
    if (!surface) return surface.error();
    sculpt::CorrectionOptions correction = options_.correction;
    choose_reach(surface->predicted, correction);
    for (std::size_t k = 0; k < maps_.size(); ++k) {
      work_.report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(maps_.size()),
                   "correcting the surface");
      const Mesh measured = measured_surface(maps_[k], model_, options_.measured);
      if (measured.triangles.empty()) continue;
      auto tried = sculpt::correct_surface(*surface, measured, correction, work_);
      if (!tried) return tried.error();
      Mesh mesh = tried->adapted();
      const ModelStep step = taken({ModelStep::Kind::correction, k, error_of(mesh), true});
      if (observer_) observer_(step, step.taken ? mesh : surface->adapted());
      if (step.taken) surface = std::move(tried);
    }
    return surface->adapted();
  }

  // The distance between neighbouring corners of a measured surface, at the distance of the model.
  double corner_spacing() const {
    std::vector<double> spacings;
    for (const FrameDepth& map : maps_)
      for (int y = 0; y < map.map.depth.depth_m.height(); y += 8)
        for (int x = 0; x < map.map.depth.depth_m.width(); x += 8)
          if (const double z = static_cast<double>(map.map.depth.depth_m(x, y)); z > 0)
            spacings.push_back(z / map.map.depth.camera->fx);
    return spacings.empty() ? extent_ : options_.measured.step_px * quantile_of(spacings, 0.5);
  }

  double most_error() const { return options_.most_error_share * extent_; }
  double error_of(const Mesh& surface) const {
    return mean_distance(distances_from(evidence_, surface, work_), most_error());
  }

  // Another surface's samples, closed, may be coarser: the next ones are as well.
  Result<Mesh> closed_surface_of(const Shapes& shapes) {
    auto surface =
        sculpt::closed_surface_of_shapes(shapes, spacing_, options_.least_thickness_spacings, work_);
    if (!surface) return surface.error();
    spacing_ = surface->spacing_m;
    return std::move(surface->mesh);
  }

  // Records a step, and whether it lowers the error.
  ModelStep taken(ModelStep step) {
    step.taken = step.error <= error_;
    if (step.taken) error_ = step.error;
    out_.steps.push_back(step);
    return step;
  }

  Result<void> try_shapes(ModelShapes shapes, ModelStep::Kind kind, std::size_t map) {
    auto distances = distances_from(evidence_, shapes.shapes, work_);
    if (!distances) return distances.error();
    const ModelStep step = taken({kind, map, mean_distance(*distances, most_error()), true});
    if (step.taken) {
      out_.shapes = std::move(shapes);
      out_.predicted_error = error_;
    }
    if (observer_) {
      const auto mesh =
          sculpt::surface_of_shapes(out_.shapes.shapes, spacing_, options_.least_thickness_spacings, work_);
      if (!mesh) return mesh.error();
      observer_(step, *mesh);
    }
    return {};
  }

  void choose_reach(const Mesh& surface, sculpt::CorrectionOptions& correction) {
    set_reach(options_.reach, distances_from(evidence_, surface, work_), spacing_, extent_, correction);
    out_.reach = correction.reach_m, out_.transition = correction.transition_m;
  }

  const VideoModel& model_;
  std::span<const FrameDepth> maps_;
  const ModelShapesOptions& shape_options_;
  const CorrectedModelOptions& options_;
  const ModelStepObserver& observer_;
  const Work& work_;
  double extent_, spacing_ = 0.0;
  std::vector<Vec3> evidence_;
  double error_ = std::numeric_limits<double>::infinity();
  CorrectedModel out_;
};

}  // namespace

std::vector<Parameter> parameters_of(CorrectedModelOptions& o) {
  std::vector<Parameter> out{
      {"map_factor",
       &o.map_factor,
       {2, 100},
       "",
       "Factor between the numbers of maps that shapes are fitted to"},
      {"rest_share",
       &o.rest_share,
       {0.001, 0.5},
       "",
       "Distance of points to which further shapes are fitted, share of the extent"},
      {"least_rest", &o.least_rest, {0, 1}, "", "Least share of such points"},
      {"passes", &o.passes, {1, 20}, "", "Most passes of the correction over all maps"},
      {"least_gain", &o.least_gain, {0, 1}, "", "Gain of a pass below which it is the last"},
      {"least_thickness_spacings",
       &o.least_thickness_spacings,
       {1, 10},
       "",
       "Least thickness of shapes whose surface is sampled, spacings of samples"},
      {"sample_spacings",
       &o.sample_spacings,
       {0.5, 10},
       "",
       "Spacing of the predicted samples, in spacings of measured corners"},
      {"most_samples", &o.most_samples, {32, 1024}, "", "Most samples along the model's extent"},
      {"error_points", &o.error_points, {100, 100000}, "", "Points that a step's error is measured at"},
      {"most_error_share",
       &o.most_error_share,
       {0.001, 1},
       "",
       "Greatest distance of a point that counts, share of the extent"}};
  const auto reach = parameters_of(o.reach);
  out.insert(out.end(), reach.begin(), reach.end());
  append_parameters(out, "segments", vision::parameters_of(o.segments));
  append_parameters(out, "measured", parameters_of(o.measured));
  append_parameters(out, "correction", without_reach(sculpt::parameters_of(o.correction)));
  return out;
}

Result<CorrectedModel> corrected_model(const VideoModel& model, std::span<const FrameDepth> maps,
                                       const Raster<Rgb8>& first, const ModelShapesOptions& shapes,
                                       const CorrectedModelOptions& options,
                                       const ModelStepObserver& observer, const Work& work) {
  CorrectedModelOptions checked = options;
  if (auto valid = check_ranges(checked); !valid) return valid.error();
  if (maps.empty()) return Error{ErrorCode::usage, "no depth map is given", {}};
  Growth growth(model, maps, shapes, options, observer, work);
  if (auto done = growth.predict_from_segments(first); !done) return done.error();
  if (auto done = growth.fit_to_structure(); !done) return done.error();
  if (auto done = growth.fit_to_rest(); !done) return done.error();
  if (auto done = growth.correct(); !done) return done.error();
  return growth.take();
}

}  // namespace palpable::recipes
