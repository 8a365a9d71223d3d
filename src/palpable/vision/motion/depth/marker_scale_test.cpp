// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/marker_scale.hpp"

#include "palpable/vision/image/opencv_image.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr Pinhole kMarkerCamera{560, 560, 319.5, 239.5, 640, 480};

// A camera on an arc around the origin that looks at it from `distance`, the table being z = 0.
CameraPose on_arc(double angle, double distance) {
  const double elevation = 0.9;
  const Vec3 from = distance * Vec3{std::sin(angle) * std::cos(elevation),
                                    -std::cos(angle) * std::cos(elevation), std::sin(elevation)};
  const Vec3 z = unit(-from), x = unit(cross(z, Vec3{0, 0, 1})), y = cross(z, x);
  CameraPose out;
  out.rotation = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  out.translation_m = from;
  return out;
}

// A picture of the table: a marker of `side` units, turned by 20 degrees, on a white sheet.
Raster<std::uint8_t> picture_of_marker(int side_mm, double side, const CameraPose& pose) {
  const Raster<std::uint8_t> cells = marker_cells(side_mm);
  constexpr int kCell = 16, kMargin = 2 * kCell, kSheet = kMarkerCells * kCell + 2 * kMargin;
  cv::Mat sheet(kSheet, kSheet, CV_8U, cv::Scalar(235));
  for (int y = 0; y < kMarkerCells; ++y)
    for (int x = 0; x < kMarkerCells; ++x)
      sheet(cv::Rect(kMargin + x * kCell, kMargin + y * kCell, kCell, kCell))
          .setTo(cells(x, y) != 0 ? 235 : 25);
  const auto to_camera = pose.inverse();
  std::vector<cv::Point2f> from, to;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    const double u = (x - 0.5) * side, v = (0.5 - y) * side, c = std::cos(0.35), s = std::sin(0.35);
    const Vec3 p = (to_camera * Point<WorldFrame>{{c * u - s * v, s * u + c * v, 0.0}}).v;
    to.emplace_back(static_cast<float>(kMarkerCamera.fx * p.x / p.z + kMarkerCamera.cx),
                    static_cast<float>(kMarkerCamera.fy * p.y / p.z + kMarkerCamera.cy));
    from.emplace_back(static_cast<float>(kMargin + x * kMarkerCells * kCell) - 0.5F,
                      static_cast<float>(kMargin + y * kMarkerCells * kCell) - 0.5F);
  }
  Raster<std::uint8_t> out(640, 480, 120);
  cv::Mat picture(480, 640, CV_8U, out.data());
  cv::warpPerspective(sheet, picture, cv::getPerspectiveTransform(from, to), picture.size(), cv::INTER_AREA,
                      cv::BORDER_TRANSPARENT);
  cv::GaussianBlur(picture, picture, {3, 3}, 0.6);
  return out;
}

struct MarkerVideo {
  CameraMotion motion;
  std::vector<Raster<std::uint8_t>> greys;
};
MarkerVideo video_of_marker(int side_mm, double side) {
  MarkerVideo out;
  out.motion.camera = kMarkerCamera;
  for (int i = 0; i < 8; ++i) {
    const CameraPose pose = on_arc(0.08 * i - 0.3, 1.0);
    out.motion.poses.emplace_back(pose);
    out.greys.push_back(picture_of_marker(side_mm, side, pose));
  }
  return out;
}

TEST(FindMarkers, ReadsEverySideAndWhereItsCornersAre) {
  for (const int side_mm : kMarkerSides_mm) {
    const CameraPose pose = on_arc(0.4, 1.0);
    const auto found = find_markers(picture_of_marker(side_mm, 0.12, pose), {});
    ASSERT_EQ(found.size(), 1U) << side_mm;
    EXPECT_EQ(found[0].side_mm, side_mm);
    const auto to_camera = pose.inverse();
    for (std::size_t k = 0; k < 4; ++k) {
      const double u = (k == 1 || k == 2 ? 0.06 : -0.06), v = (k < 2 ? 0.06 : -0.06);
      const Vec3 p = (to_camera * Point<WorldFrame>{{std::cos(0.35) * u - std::sin(0.35) * v,
                                                     std::sin(0.35) * u + std::cos(0.35) * v, 0.0}})
                         .v;
      EXPECT_NEAR(found[0].corners[k].x, kMarkerCamera.fx * p.x / p.z + kMarkerCamera.cx, 0.5);
      EXPECT_NEAR(found[0].corners[k].y, kMarkerCamera.fy * p.y / p.z + kMarkerCamera.cy, 0.5);
    }
  }
}

TEST(FindMarkers, FindsNoneInAMirroredOrDamagedOne) {
  Raster<std::uint8_t> picture = picture_of_marker(60, 0.2, on_arc(0, 1.0));
  cv::Mat view(480, 640, CV_8U, picture.data()), mirrored;
  cv::flip(view, mirrored, 1);
  mirrored.copyTo(view);
  EXPECT_TRUE(find_markers(picture, {}).empty());
  EXPECT_TRUE(find_markers(Raster<std::uint8_t>(640, 480, 128), {}).empty());
}

TEST(ScaleFromMarkers, IsThatOfThePrintedSide) {
  // 0.15 units are 60 mm.
  const MarkerVideo video = video_of_marker(60, 0.15);
  const auto scale = scale_from_markers(video.greys, video.motion, {}, {});
  ASSERT_TRUE(scale);
  EXPECT_EQ(scale->side_mm, 60);
  EXPECT_EQ(scale->frames, 8);
  EXPECT_NEAR(scale->metres_per_unit, 0.4, 0.4 * 0.005);
}

TEST(ScaleFromMarkers, IsUnknownWithoutAMarkerOrWithOnePoseOnly) {
  MarkerVideo video = video_of_marker(60, 0.15);
  for (std::size_t i = 1; i < video.motion.poses.size(); ++i) video.motion.poses[i].reset();
  EXPECT_FALSE(scale_from_markers(video.greys, video.motion, {}, {}));
  video = video_of_marker(60, 0.15);
  for (auto& grey : video.greys) grey = Raster<std::uint8_t>(640, 480, 128);
  EXPECT_FALSE(scale_from_markers(video.greys, video.motion, {}, {}));
}

TEST(ScaleFromMarkers, IsRefusedIfTheCornersFormNoSquare) {
  MarkerVideo video = video_of_marker(60, 0.15);
  // The pictures are stretched, the camera is the same: no square.
  for (auto& grey : video.greys) {
    const cv::Mat from = grey_view_of(grey).clone();
    cv::Mat to(480, 640, CV_8U, grey.data());
    const cv::Matx23d wide(1.3, 0, -0.3 * 319.5, 0, 1, 0);
    cv::warpAffine(from, to, wide, to.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  EXPECT_FALSE(scale_from_markers(video.greys, video.motion, {}, {}));
}

TEST(ScaleMotion, MultipliesEveryLength) {
  CameraMotion motion;
  motion.poses.emplace_back(on_arc(0, 2.0));
  motion.points.push_back({{{1, 2, 3}}, 0});
  scale_motion(motion, 0.5);
  EXPECT_NEAR(norm(motion.poses[0]->translation_m), 1.0, 1e-12);
  EXPECT_EQ(motion.points[0].position.v.z, 1.5);
}

}  // namespace
}  // namespace palpable::vision
