// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The near view of a simulated wrist camera, swept before tables with things made from seeds, beside the
// truth, and the zoom to it and back under hands at random places, a line for each:
// palpable_near_set [FIRST LAST [FOLDER]]; FOLDER: where depth maps are drawn (near, truth, wide), and a
// touch of the zoom is recorded.
#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/models/relief/relief_dilation.hpp"
#include "palpable/sculpt/relief/relief_in_window.hpp"
#include "palpable/session/robot/view_shift.hpp"
#include "palpable/study/world/sound_random.hpp"
#include "palpable/study/world/test_sweep.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace palpable::bench {
namespace {

constexpr double kRadius_m = 0.002;

/// Errors of the near depth on things 0.3 to 0.6 m away; those of their edges apart.
struct DepthErrors {
  std::vector<double> error_m, relative, bias;
  std::size_t asked = 0;
};

DepthErrors errors_of(const session::NearView& near, const study::RoomView& truth, bool on_things) {
  DepthErrors errors;
  for (std::size_t k = 0; k < truth.depth_m.count(); ++k) {
    const double z = truth.depth_m.values()[k];
    if ((truth.object.values()[k] > 0) != on_things || truth.object.values()[k] < 0 || z < 0.3 || z > 0.6)
      continue;
    ++errors.asked;
    const double found = near.depth.depth_m.values()[k];
    if (!std::isfinite(found)) continue;
    errors.error_m.push_back(std::abs(found - z));
    errors.relative.push_back(std::abs(found / z - 1.0));
    errors.bias.push_back(found / z - 1.0);
  }
  return errors;
}

void print(std::uint64_t seed, const char* what, DepthErrors errors) {
  const double count = static_cast<double>(errors.error_m.size());
  if (count == 0) return fmt::print("{:4} {} none\n", seed, what);
  fmt::print(
      "{:4} {} known {:5.1f} % | error median {:4.2f} % {:5.2f} mm, 90 % {:5.2f} % {:6.2f} mm | bias {:5.2f} "
      "%\n",
      seed, what, 100.0 * count / static_cast<double>(errors.asked),
      100.0 * quantile_of(errors.relative, 0.5), 1000.0 * quantile_of(errors.error_m, 0.5),
      100.0 * quantile_of(errors.relative, 0.9), 1000.0 * quantile_of(errors.error_m, 0.9),
      100.0 * quantile_of(errors.bias, 0.5));
}

models::Relief relief_of_depth(const Raster<float>& depth_m) {
  return *sculpt::relief_in_window(depth_m, *vision::range_of_depths(depth_m), {});
}

double ball_m(const models::Relief& relief, Vec3 at) {
  return models::Relief::from_samples(models::dilate_by_ball(relief, kRadius_m, {}), relief.pixel_m())
      ->sample(at.x, at.y)
      .z_m;
}

/// What the truth has under a hand: the point that a view's pixel sees.
std::optional<Point<WorldFrame>> truth_under(const study::RoomView& truth, const session::TouchedView& view,
                                             const session::ViewShift& shift, Vec3 hand_m) {
  session::TouchedView exact{view.relief, truth.depth_m, view.camera, view.base_from_camera};
  return session::point_under(exact, shift, hand_m);
}

/// Zooms near and back under hands on things; prints how far the point under the hand went.
void zoom(std::uint64_t seed, study::SweptRobot& robot, const session::NearView& near) {
  using namespace session;
  const Pinhole camera = study::camera_of(240, 180, 1.52);
  study::CameraNoise noise{vision::DepthNoise{}, 0.25, 6.0, 2.0, seed};
  const auto wide_depth = vision::clean_depth(robot.world.view(camera, noise).depth_m, {});
  const auto wide_truth = robot.world.view(camera, {});
  const auto near_truth = robot.world.wrist_view(*near.depth.camera, {});
  const auto wide_relief = relief_of_depth(wide_depth), near_relief = relief_of_depth(near.depth.depth_m);
  // The robot stands at the origin of the room.
  const TouchedView wide{wide_relief, wide_depth, camera, robot.world.world_from_camera()};
  const TouchedView close{near_relief, near.depth.depth_m, near.depth.camera, near.base_from_camera};
  study::SoundRandom random(seed);
  std::vector<double> there_mm, back_mm, height_mm, place_mm;
  int missing = 0;
  for (int k = 0; k < 20; ++k) {
    Vec3 hand;
    do hand = {random.between(-0.049, 0.049), random.between(-0.036, 0.036), 0.0};
    while (wide_truth.object(std::clamp(static_cast<int>(hand.x / wide_relief.pixel_m() + 119.5), 0, 239),
                             std::clamp(static_cast<int>(89.5 - hand.y / wide_relief.pixel_m()), 0, 179)) <
           0);
    const auto to = zoomed_shift(wide, {}, close, hand, kRadius_m);
    if (!to.point) {
      ++missing;
      continue;
    }
    const auto before = truth_under(wide_truth, wide, {}, hand),
               after = truth_under(near_truth, close, to.shift, hand);
    if (before && after) there_mm.push_back(1000.0 * norm(*after - *before));
    if (const auto place = before ? place_of(close, *before) : std::nullopt)
      place_mm.push_back(
          1000.0 * std::hypot(place->x + to.shift.by_m.x - hand.x, place->y + to.shift.by_m.y - hand.y));
    height_mm.push_back(1000.0 *
                        std::abs(ball_m(**shifted(near_relief, to.shift), hand) - ball_m(wide_relief, hand)));
    const auto back = zoomed_shift(close, to.shift, wide, hand, kRadius_m);
    const auto again = truth_under(wide_truth, wide, back.shift, hand);
    if (back.point && again && before) back_mm.push_back(1000.0 * norm(*again - *before));
  }
  if (there_mm.empty() || back_mm.empty() || place_mm.empty())
    return fmt::print("{:4} zoom: no hand on what both see\n", seed);
  fmt::print(
      "{:4} zoom {:2} of 20 | in the room {:5.1f} mm, 90 % {:5.1f} | under the hand {:4.2f} mm, 90 % {:4.2f} "
      "| "
      "and back {:5.1f} mm, 90 % {:5.1f} | height {:5.3f} mm at most\n",
      seed, 20 - missing, quantile_of(there_mm, 0.5), quantile_of(there_mm, 0.9), quantile_of(place_mm, 0.5),
      quantile_of(place_mm, 0.9), quantile_of(back_mm, 0.5), quantile_of(back_mm, 0.9),
      quantile_of(height_mm, 1.0));
}

void draw(const std::string& file, const Raster<float>& depth_m, double near_m, double far_m) {
  FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return;
  fmt::print(out, "P5 {} {} 255\n", depth_m.width(), depth_m.height());
  for (const float z : depth_m.values()) {
    const double light =
        std::isfinite(z) ? 255.0 - 215.0 * std::clamp((z - near_m) / (far_m - near_m), 0.0, 1.0) : 0.0;
    std::fputc(static_cast<int>(light), out);
  }
  std::fclose(out);
}

void draw(const std::string& file, const Image& picture) {
  FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return;
  fmt::print(out, "P6 {} {} 255\n", picture.width, picture.height);
  for (const float value : picture.samples) std::fputc(static_cast<int>(255.0F * value), out);
  std::fclose(out);
}

int run(int count, const char* const* words) {
  const auto first = whole_number(count > 1 ? words[1] : "1"),
             last = whole_number(count > 2 ? words[2] : "24");
  if (!first || !last || *first < 0 || *last < *first) {
    fmt::print(stderr, "palpable_near_set [FIRST LAST [FOLDER]]\n");
    return 2;
  }
  DepthErrors things, table;
  const auto add = [](DepthErrors& all, const DepthErrors& one) {
    all.asked += one.asked;
    all.error_m.insert(all.error_m.end(), one.error_m.begin(), one.error_m.end());
    all.relative.insert(all.relative.end(), one.relative.begin(), one.relative.end());
    all.bias.insert(all.bias.end(), one.bias.begin(), one.bias.end());
  };
  for (auto seed = static_cast<std::uint64_t>(*first); seed <= static_cast<std::uint64_t>(*last); ++seed) {
    study::SweptRobot robot(seed, 320);
    const auto pictures = robot.swept();
    if (!pictures) return 1;
    const auto near = session::near_depth(*pictures, robot.camera, {}, {});
    if (!near) return 1;
    const auto truth = robot.world.wrist_view(robot.camera, {});
    for (const bool on_things : {true, false}) {
      const auto errors = errors_of(*near, truth, on_things);
      add(on_things ? things : table, errors);
      print(seed, on_things ? "things" : "table ", errors);
    }
    zoom(seed, robot, *near);
    std::fflush(stdout);
    if (count <= 3) continue;
    const std::string base = fmt::format("{}/{}-", words[3], seed);
    draw(base + "near.ppm", near->colour);
    draw(base + "near.pgm", near->depth.depth_m, 0.25, 0.9);
    draw(base + "truth.pgm", truth.depth_m, 0.25, 0.9);
    draw(base + "wide.pgm", robot.world.view(study::camera_of(240, 180, 1.52), {}).depth_m, 0.25, 3.0);
  }
  print(0, "all things", things);
  print(0, "all tables", table);
  return 0;
}

}  // namespace
}  // namespace palpable::bench

int main(int count, char** words) { return palpable::bench::run(count, words); }
