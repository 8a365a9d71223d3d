// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/files/read_file.hpp"
#include "palpable/core/text/number_table.hpp"
#include "palpable/session/make/make_scene.hpp"
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/vision/segmentation/ground_plane.hpp"
#include "palpable/vision/segmentation/ground_scene.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

namespace palpable {
namespace {

using vision::Seen;

/// A video of a map model on a board on a table: the table is the ground, since it is lowest.
struct Video {
  const char* name;
  double fx;
  /// Height of the table in the world; the board's top is at 0.
  double table_m;
};

void PrintTo(const Video& video, std::ostream* out) { *out << video.name; }

/// One frame of the video with exact depth and pose.
struct Frame {
  std::string depth;
  Raster<Seen> seen;
  /// The table's normal in the camera's frame.
  Vec3 up;
};

constexpr double kMetresPerUnit = 0.00005;

Pinhole camera_of(const Video& video) { return {video.fx, video.fx, 319.5, 239.5, 640, 480}; }

Frame frame_of(const std::string& folder, const Video& video, int number) {
  const std::array<std::string_view, 8> names{"frame", "qw", "qx", "qy", "qz", "tx", "ty", "tz"};
  const auto csv = read_file(folder + "poses.csv");
  const auto poses = parse_number_table(as_text(csv.value()), names).value();
  const auto row = poses.row(static_cast<std::size_t>(number));
  const double w = row[1], x = row[2], y = row[3], z = row[4];
  // The third row of the rotation: the vertical components of the camera's axes in the world.
  const Vec3 up{2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)};
  const std::string name = std::string(number < 10    ? "000"
                                       : number < 100 ? "00"
                                                      : "0") +
                           std::to_string(number);
  Frame frame{folder + "depth/" + name + ".png", {}, up};
  const auto depth = sources::read_raster(frame.depth).value();
  frame.seen = Raster<Seen>(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v)
    for (int u = 0; u < depth.width(); ++u) {
      const double z_m = kMetresPerUnit * static_cast<double>(depth(u, v));
      const Vec3 there{(u - 319.5) / video.fx * z_m, (v - 239.5) / video.fx * z_m, z_m};
      const double above_m = dot(up, there) + row[7] - video.table_m;
      if (z_m > 0.0 && above_m > 0.001) frame.seen(u, v) = Seen::object;
      if (z_m > 0.0 && std::abs(above_m) < 0.0005) frame.seen(u, v) = Seen::ground;
    }
  return frame;
}

class RenderedModels : public testing::TestWithParam<Video> {};

TEST_P(RenderedModels, StandOnATableThatIsFoundInOneDepthMap) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  constexpr int kNumber = 60;
  const Frame frame = frame_of(std::string(data) + "/video/" + GetParam().name + "/", GetParam(), kNumber);
  session::MakeOptions options;
  options.input.files = {frame.depth};
  options.input.kind = sources::InputKind::depth;
  options.input.depth.metres_per_unit = kMetresPerUnit;
  options.input.depth.camera = camera_of(GetParam());
  options.recipes.relief.ground = vision::GroundTreatment::flatten;
  const auto made = session::make_scene(options, Work{});
  ASSERT_TRUE(made) << made.error().sentence();
  const auto& scene = made->scene;
  ASSERT_EQ(scene.labels.width(), frame.seen.width()) << made->notes.back().sentence;
  Raster<std::uint8_t> mask(scene.labels.width(), scene.labels.height());
  for (std::size_t i = 0; i < mask.count(); ++i)
    mask.values()[i] = scene.materials[scene.labels.values()[i]].name == "ground" ? 255 : 0;
  const auto shares = vision::shares_of(mask, frame.seen);
  std::printf("%s %d: %.2f %% of the ground found, %.2f %% of the objects lost\n", GetParam().name, kNumber,
              100.0 * shares.ground_found, 100.0 * shares.object_lost);
  EXPECT_GT(shares.ground_found, 0.98);
  EXPECT_LT(shares.object_lost, 0.02);
  const StereoRig rig{camera_of(GetParam()), 0.2, 0.0};
  Raster<float> disparity_px = sources::read_depth(frame.depth, kMetresPerUnit).value().depth.depth_m;
  for (float& d : disparity_px.values()) d = static_cast<float>(rig.baseline_m * rig.left.fx / double{d});
  const auto plane = vision::find_ground_plane(disparity_px, Work{});
  ASSERT_TRUE(plane);
  const double angle = vision::degrees_between(vision::normal_of(plane->plane, rig).v, frame.up);
  std::printf("  its normal is off by %.3f degrees\n", angle);
  EXPECT_LT(angle, 1.0);
}

INSTANTIATE_TEST_SUITE_P(DepthGround, RenderedModels,
                         testing::Values(Video{"rendered_A_two_buildings", 560.0, -0.012},
                                         Video{"rendered_B_city_block", 575.0, -0.015}));

}  // namespace
}  // namespace palpable
