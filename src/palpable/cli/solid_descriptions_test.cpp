// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0

// What D says of solids that were made from seeds: plates with pins of 1 to 8 mm, pits and holes, whose
// answers are known. `--gtest_random_seed=N` makes other solids.

#include "palpable/describe/place_words.hpp"
#include "palpable/describe/scene_words.hpp"
#include "palpable/models/field/field.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/solid/nearest_in_balls.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <random>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::cli {
namespace {

/// A rectangle of a plate with a height of its own, millimetres from the middle of the plate.
struct Feature {
  double x, y, width, height, top;
};

/// A plate with features that do not touch.
struct MadeSolid {
  double width = 0.0, height = 0.0, thickness = 0.0;
  std::vector<Feature> pins, pits, holes;
  std::vector<Feature> all() const {
    std::vector<Feature> features = pins;
    features.insert(features.end(), pits.begin(), pits.end());
    features.insert(features.end(), holes.begin(), holes.end());
    return features;
  }
  double highest() const {
    double most = thickness;
    for (const Feature& pin : pins) most = std::max(most, pin.top);
    return most;
  }
  /// The height of its front at a place on the plate.
  double top_at(double x, double y) const {
    for (const auto* features : {&pins, &pits, &holes})
      for (const Feature& f : *features)
        if (std::abs(x - f.x) < 0.5 * f.width && std::abs(y - f.y) < 0.5 * f.height) return f.top;
    return thickness;
  }
};

MadeSolid made_solid(std::uint32_t seed) {
  std::mt19937_64 random(seed);
  const auto whole = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  MadeSolid solid;
  solid.width = whole(80, 110);
  solid.height = whole(70, 100);
  solid.thickness = whole(8, 20);
  // One feature at most in each ninth, so that none touches another or a border between regions.
  std::vector<int> ninths{0, 1, 2, 3, 4, 5, 6, 7, 8};
  std::shuffle(ninths.begin(), ninths.end(), random);
  const auto feature = [&](int side, double top) {
    const int ninth = ninths.back();
    ninths.pop_back();
    const auto shift = [&](double extent) { return (extent / 6.0 - 6.0) * (whole(-4, 4) / 5.0); };
    return Feature{(ninth % 3 - 1) * solid.width / 3.0 + shift(solid.width),
                   (1 - ninth / 3) * solid.height / 3.0 + shift(solid.height), static_cast<double>(side),
                   static_cast<double>(side), top};
  };
  const int pins = whole(0, 4), pits = whole(0, 2), holes = whole(0, 2);
  for (int k = 0; k < pins; ++k) solid.pins.push_back(feature(whole(1, 8), solid.thickness + whole(8, 35)));
  for (int k = 0; k < pits; ++k) solid.pits.push_back(feature(whole(3, 9), solid.thickness - whole(4, 6)));
  for (int k = 0; k < holes; ++k) solid.holes.push_back(feature(whole(2, 9), 0.0));
  return solid;
}

/// The surface of a solid whose height is constant in each cell of an irregular grid.
class GridMesh {
 public:
  explicit GridMesh(const MadeSolid& solid) {
    xs_ = {-0.5 * solid.width, 0.5 * solid.width};
    ys_ = {-0.5 * solid.height, 0.5 * solid.height};
    zs_ = {0.0, solid.thickness};
    for (const Feature& f : solid.all()) {
      xs_.insert(xs_.end(), {f.x - 0.5 * f.width, f.x + 0.5 * f.width});
      ys_.insert(ys_.end(), {f.y - 0.5 * f.height, f.y + 0.5 * f.height});
      zs_.push_back(f.top);
    }
    for (auto* lines : {&xs_, &ys_, &zs_}) {
      std::sort(lines->begin(), lines->end());
      lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
    }
    for (std::size_t i = 0; i < xs_.size(); ++i)
      for (std::size_t j = 0; j < ys_.size(); ++j) add_cell(solid, i, j);
  }
  Mesh mesh;

 private:
  double top_at(const MadeSolid& solid, std::size_t i, std::size_t j) const {
    if (i + 1 >= xs_.size() || j + 1 >= ys_.size()) return 0.0;
    return solid.top_at(0.5 * (xs_[i] + xs_[i + 1]), 0.5 * (ys_[j] + ys_[j + 1]));
  }
  /// Top, bottom, and the walls to the cells before it along both axes.
  void add_cell(const MadeSolid& solid, std::size_t i, std::size_t j) {
    const double top = top_at(solid, i, j);
    if (i + 1 < xs_.size() && j + 1 < ys_.size() && top > 0.0) {
      const double x0 = xs_[i], x1 = xs_[i + 1], y0 = ys_[j], y1 = ys_[j + 1];
      add_quad({x0, y0, top}, {x1, y0, top}, {x1, y1, top}, {x0, y1, top});
      add_quad({x0, y0, 0}, {x0, y1, 0}, {x1, y1, 0}, {x1, y0, 0});
    }
    for (std::size_t k = 0; k + 1 < zs_.size(); ++k) {
      const double z0 = zs_[k], z1 = zs_[k + 1];
      if (j + 1 < ys_.size()) {
        const bool here = top >= z1, before = i > 0 && top_at(solid, i - 1, j) >= z1;
        const double x = xs_[i], y0 = ys_[j], y1 = ys_[j + 1];
        if (here && !before) add_quad({x, y0, z0}, {x, y0, z1}, {x, y1, z1}, {x, y1, z0});
        if (before && !here) add_quad({x, y0, z0}, {x, y1, z0}, {x, y1, z1}, {x, y0, z1});
      }
      if (i + 1 < xs_.size()) {
        const bool here = top >= z1, before = j > 0 && top_at(solid, i, j - 1) >= z1;
        const double y = ys_[j], x0 = xs_[i], x1 = xs_[i + 1];
        if (here && !before) add_quad({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1});
        if (before && !here) add_quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
      }
    }
  }
  void add_quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const Vec3 corner : {a, b, c, d}) mesh.vertices_m.push_back(1e-3 * corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  std::vector<double> xs_, ys_, zs_;
};

/// The distance to the mesh, with the sign that follows from the heights.
class PlateSource final : public sculpt::DistanceSource {
 public:
  explicit PlateSource(const MadeSolid& solid) : solid_(solid), mesh_(GridMesh(solid).mesh), tree_(mesh_) {}

  models::DistanceSample at(Vec3 p, Hint& hint) const override {
    const sculpt::NearestTriangle near = sculpt::nearest_in_ball(tree_, p, hint);
    hint.triangle = near.triangle;
    const Vec3 way = p - near.point_m;
    // The nearest point is exact only in its distance, so the direction is that of the face.
    const auto& t = mesh_.triangles[near.triangle];
    const Vec3 a = mesh_.vertices_m[t[0]];
    const Vec3 normal = unit(cross(mesh_.vertices_m[t[1]] - a, mesh_.vertices_m[t[2]] - a));
    const double sign = is_inside(1e3 * p) ? -1.0 : 1.0, distance_m = norm(way);
    constexpr double kTouching_m = 1e-9;
    if (near.part == sculpt::TrianglePart::face || distance_m < kTouching_m)
      return {dot(way, normal), normal};
    return {sign * distance_m, (sign / distance_m) * way};
  }
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    sculpt::enter_ball(tree_, centre_m, radius_m, hint);
  }
  void leave(Hint& hint) const override { sculpt::leave_ball(hint); }
  sculpt::Box bounds() const override { return tree_.bounds(); }

 private:
  bool is_inside(Vec3 p) const {
    return std::abs(p.x) < 0.5 * solid_.width && std::abs(p.y) < 0.5 * solid_.height && p.z > 0.0 &&
           p.z < solid_.top_at(p.x, p.y);
  }
  const MadeSolid& solid_;
  Mesh mesh_;
  sculpt::TriangleTree tree_;
};

models::Scene scene_of(const MadeSolid& made, int cells) {
  const PlateSource solid(made);
  sculpt::FieldOptions options;
  options.resolution = cells;
  // A tenth of what the sentences round to; the default would take most of the time of this test.
  options.max_error_m = 1e-4;
  auto distance = sculpt::field_from_source(solid, options, {});
  EXPECT_TRUE(distance);
  const sculpt::Box box = solid.bounds();
  models::Scene scene;
  scene.model =
      std::make_shared<const models::Field>(*models::field_of(*std::move(distance), box.least_m, box.most_m));
  scene.pose = models::SolidPose::upright;
  scene.title = "Made";
  return scene;
}

std::string counted_openings(const MadeSolid& made) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) parts.push_back(std::to_string(count) + (count == 1 ? one : many));
  };
  add(made.holes.size(), " hole through it", " holes through it");
  add(made.pits.size(), " hollow", " hollows");
  if (parts.empty()) return "no openings";
  return parts.size() == 1 ? parts[0] : parts[0] + " and " + parts[1];
}

std::string region(const Feature& f, const MadeSolid& made) {
  return describe::region_words({f.x, f.y}, made.width, made.height);
}

/// The numbers of each match of a pattern, the groups in their order.
std::vector<std::vector<double>> numbers_in(const std::string& words, const std::string& pattern) {
  std::vector<std::vector<double>> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator at(words.begin(), words.end(), expression), end; at != end; ++at) {
    std::vector<double> numbers;
    for (std::size_t k = 1; k < at->size(); ++k) numbers.push_back(std::stod((*at)[k].str()));
    found.push_back(numbers);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The greatest difference of two lists of numbers; infinite if they have different lengths.
void expect_near(const std::vector<std::vector<double>>& said, std::vector<std::vector<double>> truth,
                 double within, const std::string& of) {
  std::sort(truth.begin(), truth.end());
  ASSERT_EQ(said.size(), truth.size()) << of;
  for (std::size_t k = 0; k < said.size(); ++k)
    for (std::size_t n = 0; n < said[k].size(); ++n) EXPECT_NEAR(said[k][n], truth[k][n], within) << of;
}

void check_sentences(const MadeSolid& made, const models::Scene& scene, double cell) {
  const auto parts = describe::scene_parts(scene, 1.0, {});
  const std::string& first = parts[0];
  const std::string second = parts.size() > 2 ? parts[1] : "";
  const std::string all = first + " / " + second;
  EXPECT_NE(first.find("outline rectangular; " + counted_openings(made) + "."), std::string::npos) << all;
  EXPECT_EQ(first.find("piece"), std::string::npos) << all;
  const bool is_flat = made.pins.empty() && made.pits.empty();
  EXPECT_EQ(first.find("Flat in front") != std::string::npos, is_flat) << all;
  if (made.pins.size() > 1) {
    const std::string stand = std::to_string(made.pins.size()) + " parts stand out: ";
    ASSERT_NE(first.find(stand), std::string::npos) << all;
    for (const Feature& pin : made.pins)
      EXPECT_NE(first.find(region(pin, made), first.find(stand)), std::string::npos) << all;
  } else {
    EXPECT_EQ(first.find("stand out"), std::string::npos) << all;
  }
  if (!is_flat)
    expect_near(numbers_in(first, "Nearest place: [a-z ]*, ([0-9.]+) millimetres from its back"),
                {{made.highest()}}, 0.5 * cell + 0.5, all);
  std::vector<std::vector<double>> fronts, hollows, sides;
  for (const Feature& pin : made.pins) fronts.push_back({pin.top});
  if (fronts.empty() && !is_flat) fronts.push_back({made.thickness});
  for (const Feature& pit : made.pits) hollows.push_back({made.thickness - pit.top, pit.width, pit.height});
  for (const Feature& hole : made.holes) sides.push_back({hole.width, hole.height});
  const double within = 1.5 * cell + 0.5;
  expect_near(numbers_in(second, "front ([0-9.]+) millimetres from its back"), fronts, within, all);
  expect_near(numbers_in(second, "ollow ([0-9.]+) millimetres? deep, [a-z ]*, ([0-9.]+) by ([0-9.]+) mill"),
              hollows, within, all);
  expect_near(numbers_in(second, "ole through it, [a-z ]*, ([0-9.]+) by ([0-9.]+) mill"), sides, within, all);
}

/// 16 solids; PALPABLE_SOLIDS=50 for a measurement.
TEST(SolidDescriptions, SayOfMadeSolidsWhatIsThere) {
  const char* wanted = std::getenv("PALPABLE_SOLIDS");
  const auto solids = static_cast<std::uint32_t>(wanted != nullptr ? std::max(1, std::atoi(wanted)) : 16);
  const auto seed = 4100U + 1000U * static_cast<unsigned>(GTEST_FLAG_GET(random_seed));
  for (std::uint32_t k = 0; k < solids; ++k) {
    const MadeSolid made = made_solid(seed + k);
    const int cells = k % 25 == 0 ? 256 : 112;
    SCOPED_TRACE("seed " + std::to_string(seed + k));
    check_sentences(made, scene_of(made, cells), std::max(made.width, made.height) / cells);
  }
}

}  // namespace
}  // namespace palpable::cli
