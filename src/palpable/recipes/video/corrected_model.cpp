// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/corrected_model.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/recipes/video/segment_shapes.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/dual_contour.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

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
    auto distances = distances_to(points, out_.shapes.shapes);
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
  double mean_of(const std::vector<double>& distances) const {
    double sum = 0.0;
    for (const double d : distances) sum += std::min(d, most_error());
    return distances.empty() ? 0.0 : sum / static_cast<double>(distances.size());
  }
  double error_of(const Mesh& surface) const { return mean_of(distances_to(surface)); }
  std::vector<double> distances_to(const Mesh& surface) const {
    const sculpt::TriangleTree tree(surface);
    std::vector<double> distances(evidence_.size());
    parallel_for(work_, static_cast<int>(evidence_.size()), 64, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        distances[i] = std::sqrt(tree.nearest(evidence_[i], 0).squared_distance_m2);
    });
    return distances;
  }
  Result<std::vector<double>> distances_to(const std::vector<Vec3>& points, const Shapes& shapes) const {
    const auto source = sculpt::distance_of(shapes);
    if (!source) return source.error();
    std::vector<double> out(points.size());
    parallel_for(work_, static_cast<int>(points.size()), 64, [&](int begin, int end) {
      sculpt::DistanceSource::Hint hint;
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
        out[i] = std::abs((*source)->at(points[i], hint).distance_m);
    });
    return out;
  }

  // Slabs thinner than a few samples would be lost between them.
  Shapes thickened(Shapes shapes) const {
    const double least = 0.5 * options_.least_thickness_spacings * spacing_;
    for (models::Superquadric& shape : shapes)
      for (double* half : {&shape.size_m.x, &shape.size_m.y, &shape.size_m.z}) *half = std::max(*half, least);
    return shapes;
  }
  Result<Mesh> surface_of(const Shapes& given) const {
    const Shapes shapes = thickened(given);
    const auto source = sculpt::distance_of(shapes);
    if (!source) return source.error();
    sculpt::Box box = (*source)->bounds();
    const Vec3 margin{3 * spacing_, 3 * spacing_, 3 * spacing_};
    box = {box.least_m - margin, box.most_m + margin};
    std::vector<Vec3> seeds;
    for (const models::Superquadric& shape : shapes)
      for (const Vec3& v : models::mesh_of(shape, 4 * spacing_).vertices_m) seeds.push_back(v);
    const auto solid = [&](Vec3 p) {
      sculpt::DistanceSource::Hint hint;
      return (*source)->at(p, hint);
    };
    return sculpt::dual_contour(solid, box, seeds, {spacing_}, work_);
  }

  // Three sheets in one cube may leave the contour open: other cubes then close it.
  Result<Mesh> closed_surface_of(const Shapes& shapes) {
    constexpr int kTries = 4;
    constexpr double kCoarser = 1.07;
    for (int i = 0;; ++i) {
      auto mesh = surface_of(shapes);
      if (!mesh) return mesh;
      auto surface = sculpt::predicted_surface(*std::move(mesh));
      if (surface) return std::move(surface->predicted);
      if (i == kTries) return surface.error();
      spacing_ *= kCoarser;
    }
  }

  // Records a step, and whether it lowers the error.
  ModelStep taken(ModelStep step) {
    step.taken = step.error <= error_;
    if (step.taken) error_ = step.error;
    out_.steps.push_back(step);
    return step;
  }

  Result<void> try_shapes(ModelShapes shapes, ModelStep::Kind kind, std::size_t map) {
    auto distances = distances_to(evidence_, shapes.shapes);
    if (!distances) return distances.error();
    const ModelStep step = taken({kind, map, mean_of(*distances), true});
    if (step.taken) {
      out_.shapes = std::move(shapes);
      out_.predicted_error = error_;
    }
    if (observer_) {
      const auto mesh = surface_of(out_.shapes.shapes);
      if (!mesh) return mesh.error();
      observer_(step, *mesh);
    }
    return {};
  }

  void choose_reach(const Mesh& surface, sculpt::CorrectionOptions& correction) {
    std::vector<double> residuals = distances_to(surface);
    const double residual = residuals.empty() ? 0.0 : quantile_of(residuals, options_.reach_quantile);
    out_.reach = std::max(std::min(residual, options_.most_reach_share * extent_),
                          options_.least_reach_spacings * spacing_);
    out_.transition = options_.transition_reaches * out_.reach;
    correction.reach_m = out_.reach;
    correction.transition_m = out_.transition;
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
      {"reach_quantile",
       &o.reach_quantile,
       {0.5, 1},
       "",
       "Quantile of the points' distances from the superquadrics that is the reach"},
      {"least_reach_spacings", &o.least_reach_spacings, {0.5, 20}, "", "Least reach, spacings of samples"},
      {"most_reach_share", &o.most_reach_share, {0.001, 0.5}, "", "Greatest reach, share of the extent"},
      {"transition_reaches", &o.transition_reaches, {1, 10}, "", "Width of the transition, reaches"},
      {"error_points", &o.error_points, {100, 100000}, "", "Points that a step's error is measured at"},
      {"most_error_share",
       &o.most_error_share,
       {0.001, 1},
       "",
       "Greatest distance of a point that counts, share of the extent"}};
  append_parameters(out, "segments", vision::parameters_of(o.segments));
  append_parameters(out, "measured", parameters_of(o.measured));
  append_parameters(out, "correction", sculpt::parameters_of(o.correction));
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
